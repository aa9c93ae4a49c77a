"""A folder of real YCB models, to be seen instead of ours: `NNN_name/google_16k/textured.obj`.

A scan is brought to where our shape of the object is, at the published size: see `meshes`.
"""

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from executive.errors import InputError
from sim.objects.meshes import aligned
from sim.objects.objects import ObjectModel

MESH = Path("google_16k", "textured.obj")
_NUMBER = re.compile(r"\d{3}(-[a-z])?_")
"""`013_apple`, `070-a_colored_wood_blocks`: without it, YCB's names are the ontology's."""


def with_scans(models: Mapping[str, ObjectModel], folder: Path) -> dict[str, ObjectModel]:
    """The models, looking like their scan where the folder has one.

    Raises:
        InputError: if the folder has none of them, or one of its files is broken.
    """
    found = {_NUMBER.sub("", path.parts[-3]): path for path in _meshes(folder)}
    known = {name: path for name, path in found.items() if name in models}
    if not known:
        right = f"it should have folders such as 013_apple with {MESH} in them"
        raise InputError(f"--ycb {folder}", "has no model of an object that we know", right)
    scans = {name: aligned(models[name], path) for name, path in known.items()}
    return {
        name: replace(model, look=scans.get(name, model.look)) for name, model in models.items()
    }


def _meshes(folder: Path) -> list[Path]:
    """The last of several models of one object first."""
    return sorted(folder.glob(f"[0-9][0-9][0-9]*_*/{MESH}"), reverse=True)
