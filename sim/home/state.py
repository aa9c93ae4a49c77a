"""Saves where the objects of a simulated home were left, for the next run of the program.

The file is TOML with the name of the home, the time there, and `objects` as in a home file.
"""

import math
import os
from pathlib import Path
from typing import Annotated

import tomli_w
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError

from executive.errors import InputError
from executive.files import write_whole
from executive.text import printable
from executive.toml_file import in_words, read_toml, refuse_misread_bools
from executive.types.geometry import Vector3
from sim.home.arrangement import NoRoomError, Spot
from sim.home.furniture import Furniture
from sim.home.home import Home

RIGHT = "name a file that --home-state made, or one that does not exist yet in a folder of yours"
STANDS_M = 0.02
"""An object stands on a board if its base is within this distance above or below it."""
_SHOWN = 80


def _as_spot(value: object) -> object:
    return {"furniture": value} if isinstance(value, str) else value


class HomeState(BaseModel):
    """The spots of a home's objects at a moment."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    home: str
    """The home's name."""
    time_s: Annotated[float, Field(strict=True, ge=0, le=1e11)]
    """The time of the home's own clock (UTC, seconds since 1970)."""
    objects: Annotated[
        dict[str, Annotated[Spot, BeforeValidator(_as_spot)]], Field(max_length=200)
    ] = Field(default_factory=dict)

    def to_toml(self) -> str:
        """The content of the file."""
        spots = {name: _written(spot) for name, spot in self.objects.items()}
        return tomli_w.dumps({"home": self.home, "time_s": self.time_s, "objects": spots})


def read_state(file: Path, home: Home) -> HomeState | None:
    """Read the saved state of a home; None if there is no such file yet.

    Raises:
        InputError: if the file cannot be read, is not a saved state, or does not fit the home.
    """
    if not os.path.lexists(file):
        return None
    where, tables = printable(file), read_toml(file, RIGHT)
    try:
        state = HomeState.model_validate(tables)
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        key = printable(".".join(map(str, fault["loc"])))[:_SHOWN]
        what = f"is no state of a home: {key}: {in_words(fault['msg'])}"
        raise InputError(where, what, RIGHT) from None
    refuse_misread_bools(tables, state, where)
    if state.home != home.name:
        what = f"is the state of the home {printable(state.home)[:_SHOWN]}, not of {home.name}"
        raise InputError(where, what, "give each home a file of its own")
    _check_fits(home, state, where)
    return state


def _check_fits(home: Home, state: HomeState, where: str) -> None:
    """Check that the home has all objects and furniture of a state.

    Raises:
        InputError: if an object, a piece of furniture or a surface is unknown.
    """
    models = home.models()
    pieces = {piece.name: piece for piece in (*home.furniture, home.delivery)}
    right = "take the line out, or name another file"
    for name, spot in state.objects.items():
        if name not in models:
            raise InputError(where, f"there is no object {printable(name)[:_SHOWN]}", right)
        piece = pieces.get(spot.furniture)
        if piece is None:
            what = f"{name}: there is no furniture {printable(spot.furniture)[:_SHOWN]}"
            raise InputError(where, what, right)
        if spot.surface is not None and spot.surface >= len(piece.surfaces()):
            what = f"{name}: {piece.name} has no surface {spot.surface}"
            raise InputError(where, what, f"it has {len(piece.surfaces())}, counted from 0")


def write_state(file: Path, state: HomeState) -> None:
    """Write the file atomically.

    Raises:
        OSError: if that fails; the file then keeps its old content.
    """
    write_whole(file, state.to_toml().encode())


def spot_on(piece: Furniture, position: Vector3, yaw: float) -> Spot:
    """The spot of an object on a piece of furniture; without coordinates if it is on no surface.

    Args:
        piece: the furniture.
        position: of the object's frame in `map` (metres).
        yaw: of the object in `map` (radians).
    """
    ahead, left, height = piece.from_map(position)
    for index, surface in enumerate(piece.surfaces()):
        at = ahead - surface.center[0], left - surface.center[1]
        inside = abs(at[0]) <= surface.length_x / 2 and abs(at[1]) <= surface.length_y / 2
        if inside and abs(height - surface.center[2]) < STANDS_M:
            turn = math.remainder(yaw - piece.pose[2], math.tau)
            return Spot(furniture=piece.name, surface=index, at=at, yaw=math.degrees(turn))
    return Spot(furniture=piece.name)


def with_room(home: Home) -> Home:
    """The home with every object where there is room for it.

    An object without room at its spot is moved elsewhere on the same furniture, or else to the
    first piece that has room.

    Raises:
        InputError: if there is no room for an object anywhere.
    """
    tried: dict[str, int] = {}
    while True:
        try:
            home.arrangement()
            return home
        except NoRoomError as error:
            name = error.name
        here = home.objects[name]
        choices = [here.furniture, *(piece.name for piece in home.furniture)]
        number = tried.get(name, 0)
        if number == len(choices):
            right = "take something out of its objects"
            raise InputError(f"home {home.name}", f"there is no room for the {name}", right)
        tried[name] = number + 1
        home = home.as_left({name: here.moved(choices[number])})


def _written(spot: Spot) -> str | dict[str, object]:
    if spot.at is None:
        return spot.furniture
    at = [round(length, 4) for length in spot.at]
    yaw = round(math.degrees(spot.yaw), 2)
    return {"furniture": spot.furniture, "surface": spot.surface or 0, "at": at, "yaw": yaw}
