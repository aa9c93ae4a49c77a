"""Draws objects with real YCB scans, from a folder with `NNN_name/google_16k/textured.obj`.

A scan is aligned with our shapes of the object, which have the published size: see `meshes`.
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
"""The number, as in `013_apple` or `070-a_colored_wood_blocks`; the rest is the ontology's name."""


def with_scans(models: Mapping[str, ObjectModel], folder: Path) -> dict[str, ObjectModel]:
    """The models, with a scan to draw where the folder has one.

    Raises:
        InputError: if the folder has no scan of these objects, or one of its files is broken.
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
    """The mesh files, in reverse order: of several for one object, the first by name is used."""
    return sorted(folder.glob(f"[0-9][0-9][0-9]*_*/{MESH}"), reverse=True)
