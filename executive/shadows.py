"""Our packages have common names: what other people call so may come before them on the path."""

import os
import sys

BESIDE = os.path.dirname(os.path.dirname(__file__))
"""The folder that this package is in, and so are the others."""
OTHERS = ("kb", "logs", "sim", "trees")


def shadow() -> str:
    """What Python would import in place of a package of ours, as a sentence; empty if nothing."""
    for package in OTHERS:
        found = _found(package)
        if found not in ("", os.path.join(BESIDE, package)):
            return (
                f"{found} shadows the package {package} of robot-executive; "
                "run robot-executive or robot-executive-logs, or start in another folder"
            )
    return ""


def _found(package: str) -> str:
    """The folder or file that would be imported; this takes less than 0.1 ms."""
    for finder in sys.meta_path:
        if spec := finder.find_spec(package, None):
            where = spec.origin or next(iter(spec.submodule_search_locations or ()), "")
            return where.removesuffix(f"{os.sep}__init__.py")
    return ""
