"""Placements of TextWorld Commonsense: 501 household objects, 39 places, three folds.

Data of Murugesan et al., "Text-based RL Agents with Commonsense Knowledge" (AAAI 2021),
Apache-2.0, from the PyPI package textworld-express. Only its file is read; the package is not
imported, because its engine needs Java.
"""

import importlib.util
from itertools import chain
from pathlib import Path

from pydantic import BaseModel, Field, ValidationError

from executive.errors import InputError
from kb.advice.ranking import Known
from kb.ontology.names import unique

FILE = "twc_objects.folds.json"
HOW = "pip install --no-deps textworld-express, or name the file with --placements"
ON = frozenset(
    (
        *("armchair", "bed", "clothesline", "coat hanger", "coffee table", "counter", "desk"),
        *("dressing table", "end table", "hat rack", "key holder", "nightstand", "shelf"),
        *("side table", "sofa", "suspended shelf", "toilet roll holder", "towel rail"),
        *("TV stand", "wall hook"),
    )
)
"""Places that things are on; things are in all others. The file does not say which."""


class _Placement(BaseModel):
    category: str
    locations: tuple[str, ...] = Field(min_length=1)


_Fold = dict[str, _Placement]


class _Folds(BaseModel):
    train: _Fold
    valid: _Fold
    test: _Fold


class Placements:
    """Objects with their categories and right places, in three disjoint folds."""

    def __init__(self, file: Path | None = None) -> None:
        """Read the given file, or the installed one.

        Raises:
            InputError: if there is no file, or it has another format.
        """
        folds = _read(file or _installed())
        self.folds = {
            fold: tuple(
                Known(name, placement.category, placement.locations)
                for name, placement in placements.items()
            )
            for fold, placements in folds
        }
        """`train`, `valid` and `test`."""

    def places(self) -> tuple[str, ...]:
        """All places of all folds, by name."""
        everything = chain.from_iterable(self.folds.values())
        return tuple(sorted(unique(place for known in everything for place in known.places)))


def preposition(place: str) -> str:
    """The preposition of this place: "in" or "on"."""
    return "on" if place in ON else "in"


def _installed() -> Path:
    spec = importlib.util.find_spec("textworld_express")
    for folder in (spec and spec.submodule_search_locations) or ():
        return Path(folder) / FILE
    raise InputError("placements", "the package textworld-express is not installed", HOW)


def _read(file: Path) -> _Folds:
    path = file / FILE if file.is_dir() else file
    try:
        return _Folds.model_validate_json(path.read_bytes())
    except OSError as error:
        raise InputError(str(path), f"cannot be read: {error.strerror}", HOW) from None
    except ValidationError as error:
        fault = error.errors()[0]
        where = ".".join(map(str, fault["loc"]))
        right = 'should be {"train": {"mug": {"category": "dishes", "locations": ["shelf"]}}, ...}'
        raise InputError(f"{path}: {where}" if where else str(path), fault["msg"], right) from None
