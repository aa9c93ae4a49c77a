"""Detects modules of others that shadow our packages, whose names are common.

Each of our programs checks this at its start. A program that is itself shadowed cannot.
"""

import os
import sys

BESIDE = os.path.dirname(os.path.dirname(__file__))
"""The folder of this package and of our others."""
OTHERS = ("kb", "logs", "sim", "trees")
COMMANDS = "robot-executive, or robot-executive-kb, -logs, -sim, -trees or -campaign"
"""Commands that do not import from the current folder."""


def shadow() -> str:
    """Which module shadows a package of ours, as a sentence; empty if none does."""
    for package in OTHERS:
        found = _found(package)
        if found not in ("", os.path.join(BESIDE, package)):
            return (
                f"{found} shadows the package {package} of robot-executive; "
                f"run {COMMANDS}, or start in another folder"
            )
    return ""


def _found(package: str) -> str:
    """The folder or file that Python would import; takes less than 0.1 ms."""
    for finder in sys.meta_path:
        if spec := finder.find_spec(package, None):
            where = spec.origin or next(iter(spec.submodule_search_locations or ()), "")
            return where.removesuffix(f"{os.sep}__init__.py")
    return ""
