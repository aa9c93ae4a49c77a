"""Where things stand on furniture at the start: as the home file says, or side by side."""

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Annotated

from pydantic import AfterValidator, BaseModel, ConfigDict, NonNegativeInt

from sim.furniture import Surface
from sim.objects import ObjectModel

GAP_M = 0.12
"""Between the outlines of neighbours, for the fingers of a hand."""
FRONT_M = 0.13
"""From the front edge to the middle of a thing, for the reach of an arm."""
MARGIN_M = 0.02
"""From the outline of a thing to the edge of its surface."""
SIDE_M = 0.5
"""Farthest middle of a thing to the left or right of who stands before the furniture."""
STEP_M = 0.01
HEADROOM_M = 0.05


class Spot(BaseModel):
    """Where an object is: on which furniture and, if it matters, where on it."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    furniture: str
    surface: NonNegativeInt = 0
    """Counts the furniture's surfaces, the handiest first; used with `at`."""
    at: tuple[float, float] | None = None
    """From the middle of the surface to the front and to the left (metres)."""
    yaw: Annotated[float, AfterValidator(math.radians)] = 0.0
    """Turn of the object (degrees in the file, radians here)."""


@dataclass(frozen=True, slots=True)
class Standing:
    """An object's frame in the frame of its furniture (metres, radians)."""

    surface: int
    x: float
    y: float
    z: float
    yaw: float


class NoRoomError(Exception):
    """There is no spot for an object on its furniture."""

    def __init__(self, name: str, reason: str) -> None:
        """Say for which object and why."""
        super().__init__(reason)
        self.name = name


def arrange(
    spots: Mapping[str, Spot],
    surfaces: Mapping[str, tuple[Surface, ...]],
    models: Mapping[str, ObjectModel],
) -> dict[str, Standing]:
    """Give every object its place.

    Objects with `at` stand there. The others follow in their order: each takes the free spot that
    is nearest to the middle of the front of the first surface that has one, so that moving one
    object leaves those before it where they are.

    Raises:
        NoRoomError: if an object does not fit.
    """
    standing: dict[str, Standing] = {}
    taken: dict[tuple[str, int], list[tuple[float, float]]] = defaultdict(list)
    for name, spot in sorted(spots.items(), key=lambda item: item[1].at is None):
        boards, model = surfaces[spot.furniture], models[name]
        for place in _candidates(name, spot, boards, model):
            row = taken[spot.furniture, place.surface]
            span = (place.y + model.lower[1], place.y + model.upper[1])
            if all(span[1] + GAP_M <= low or high + GAP_M <= span[0] for low, high in row):
                row.append(span)
                standing[name] = place
                break
        else:
            raise NoRoomError(name, f"no spot is left for it on {spot.furniture}")
    return standing


def _candidates(
    name: str, spot: Spot, surfaces: tuple[Surface, ...], model: ObjectModel
) -> Iterator[Standing]:
    if spot.at is not None:
        yield _given(name, spot, surfaces, model)
        return
    for index, surface in enumerate(surfaces):
        if model.size[2] + HEADROOM_M > surface.clearance:
            continue
        inset = max(FRONT_M, model.upper[0] + MARGIN_M)
        x, y, z = surface.center
        for step in range(int(SIDE_M / STEP_M) + 1):
            for offset in (step * STEP_M, -step * STEP_M):
                place = Standing(index, x + surface.length_x / 2 - inset, y + offset, z, spot.yaw)
                if _is_on(surface, place, model):
                    yield place


def _given(name: str, spot: Spot, surfaces: tuple[Surface, ...], model: ObjectModel) -> Standing:
    if spot.at is None or spot.surface >= len(surfaces):
        raise NoRoomError(name, f"{spot.furniture} has {len(surfaces)} surfaces, counted from 0")
    surface = surfaces[spot.surface]
    x, y, z = surface.center
    place = Standing(spot.surface, x + spot.at[0], y + spot.at[1], z, spot.yaw)
    if not _is_on(surface, place, model):
        raise NoRoomError(name, f"it would stick out of surface {spot.surface} of {spot.furniture}")
    return place


def _is_on(surface: Surface, place: Standing, model: ObjectModel) -> bool:
    x, y = place.x - surface.center[0], place.y - surface.center[1]
    return (
        -surface.length_x / 2 <= x + model.lower[0]
        and x + model.upper[0] <= surface.length_x / 2
        and -surface.length_y / 2 + MARGIN_M <= y + model.lower[1]
        and y + model.upper[1] <= surface.length_y / 2 - MARGIN_M
    )
