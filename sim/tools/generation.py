"""Generates random homes of any size: rooms side by side, with furniture along their walls.

The same numbers and seed give the same home. The result has the tables of a home file.
"""

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from itertools import cycle, islice
from math import ceil, sqrt
from random import Random
from typing import Any

import tomli_w

from executive.errors import InputError
from executive.types.home import DELIVERY
from sim.home.arrangement import NoRoomError, Spot, arrange
from sim.home.home import STAND_OFF_M, Home
from sim.home.validation import home_flaws
from sim.navigation.grid import FOOTPRINT_M
from sim.objects.objects import load_objects, rooms_of_objects
from sim.tools.checking import way_faults

MOST_ROOMS, LEAST_FURNITURE, MOST_IN_A_ROOM = 60, 8, 40

SIZES: dict[str, tuple[tuple[float, float, float], list[float]]] = {
    "Table": ((0.60, 1.20, 0.74), []),
    "DiningTable": ((0.80, 1.40, 0.74), []),
    "CoffeeTable": ((0.55, 1.00, 0.42), []),
    "SideTable": ((0.45, 0.50, 0.55), []),
    "Desk": ((0.60, 1.20, 0.74), []),
    "Counter": ((0.60, 1.60, 0.90), []),
    "Wagon": ((0.45, 0.80, 0.80), [0.25]),
    "Cabinet": ((0.45, 1.00, 0.88), [0.12]),
    "Bookshelf": ((0.32, 0.90, 1.10), [0.10, 0.43, 0.76]),
    "Shelf": ((0.40, 1.20, 1.10), [0.15, 0.60]),
    "Sideboard": ((0.45, 1.40, 0.80), [0.12, 0.46]),
    "Dresser": ((0.45, 1.00, 0.85), []),
    "Nightstand": ((0.42, 0.50, 0.55), []),
    "TvStand": ((0.42, 1.40, 0.50), []),
    "Refrigerator": ((0.65, 0.70, 1.60), [0.75]),
    "Sofa": ((0.85, 1.80, 0.85), [0.42]),
    "Bed": ((1.40, 2.05, 0.50), []),
}
"""(depth, width, height) and heights of the boards of furniture, by kind (metres)."""

FURNITURE_OF_ROOM = {
    "LivingRoom": ("Sofa", "CoffeeTable", "TvStand", "Bookshelf", "SideTable", "Sideboard"),
    "Kitchen": ("Counter", "Refrigerator", "Cabinet", "Table", "Wagon", "Shelf"),
    "Bedroom": ("Bed", "Nightstand", "Desk", "Dresser", "Bookshelf"),
    "Lobby": ("Sideboard", "Shelf", "SideTable", "Cabinet"),
    "Bathroom": ("Cabinet", "Shelf", "SideTable", "Wagon"),
    "Office": ("Desk", "Bookshelf", "Cabinet", "Table"),
    "DiningRoom": ("DiningTable", "Sideboard", "Cabinet", "Wagon"),
    "Garage": ("Shelf", "Counter", "Table", "Cabinet"),
    "Playroom": ("Table", "Shelf", "CoffeeTable", "Cabinet"),
    "LaundryRoom": ("Counter", "Shelf", "Cabinet", "Wagon"),
    "StorageRoom": ("Shelf", "Cabinet", "Table", "Wagon"),
}
"""Kinds of furniture by kind of room; small homes have the first rooms and the first pieces."""

LONGEST_ACROSS_M = 0.25
"""Objects wider than this are turned by a quarter, so that they do not lie across the front."""

DOOR_M = 1.1
SMALLEST_ROOM_M = 4.4
"""Wide enough for its centre to stay free with furniture along all walls."""
_WALL_M = 0.06
"""Distance from the edge of a room to the back of furniture."""
_BESIDE_M = 0.05
_STAND_M = STAND_OFF_M + FOOTPRINT_M + 0.1
"""Depth of the free floor in front of furniture."""
_TRIES = 300

Rectangle = tuple[float, float, float, float]
Table = dict[str, Any]
"""A table of the home file."""


def generate_home(rooms: int, furniture: int, seed: int) -> str:
    """The text of a home file in which the robot can reach every place.

    Args:
        rooms: number of rooms, at most MOST_ROOMS.
        furniture: number of pieces, without the delivery table.
        seed: of the random choices.

    Raises:
        InputError: if the numbers are out of range.
    """
    least, most = max(LEAST_FURNITURE, rooms), MOST_IN_A_ROOM * rooms
    if not 1 <= rooms <= MOST_ROOMS:
        raise InputError("--rooms", f"cannot make {rooms} rooms", f"give 1 to {MOST_ROOMS}")
    if not least <= furniture <= most:
        right = f"give {least} to {most} for {rooms} rooms"
        raise InputError("--furniture", f"cannot make {furniture} pieces", right)
    rng = Random(seed)
    side = SMALLEST_ROOM_M + 0.4 * max(0, ceil(furniture / rooms) - 4)
    tables = None
    while tables is None or not _is_sound(tables):
        tables = _draw(rng, rooms, furniture, side)
        side *= 1.02
    command = f"python -m sim generate --rooms {rooms} --furniture {furniture} --seed {seed}"
    return f"# Made by {command}\n\n{_with_short_arrays(tomli_w.dumps(tables))}"


def _is_sound(tables: Table) -> bool:
    home = Home.model_validate({"name": "home", **tables})
    return not (any(home_flaws(home)) or any(way_faults(home)))


def _draw(rng: Random, rooms: int, furniture: int, side: float) -> Table | None:
    """A random home with rooms of at least `side` metres; None if not everything has room."""
    cells = _cells(rng, rooms, side)
    plan = _rooms(rng, cells)
    doors = list(_doors(rng, cells))
    walls = {room["name"]: _Walls(rng, room["rectangle"], doors) for room in plan}
    living = next(room for room in plan if room["kind"] == "LivingRoom")
    size = (0.45, 0.60, 0.60)
    delivery = walls[living["name"]].put(size)
    person = walls[living["name"]].put((0.6, 0.6, 0.0))
    pieces = list(_pieces(walls, plan, furniture))
    if not (delivery and person and len(pieces) == furniture):
        return None
    left, lower, right, upper = living["rectangle"]
    home = {
        "robot_start": [round((left + right) / 2, 2), round((lower + upper) / 2, 2), 0],
        "person": person,
        "rooms": plan,
        "doors": doors,
        "furniture": pieces,
        "delivery": {
            "name": DELIVERY,
            "kind": "Table",
            "room": living["name"],
            "pose": delivery,
            "size": size,
        },
    }
    objects = _objects(rng, Home.model_validate({"name": "home", **home}))
    return {**home, "objects": objects} if objects else None


def _cells(rng: Random, rooms: int, side: float) -> dict[tuple[int, int], Rectangle]:
    """Rectangles of rooms by column and row; the last row may be short."""
    columns = ceil(sqrt(rooms))
    xs, ys = [0.0], [0.0]
    for edges, number in ((xs, columns), (ys, ceil(rooms / columns))):
        for _ in range(number):
            edges.append(round(edges[-1] + side + rng.uniform(0.0, 1.2), 1))
    places = [divmod(index, columns)[::-1] for index in range(rooms)]
    return {(x, y): (xs[x], ys[y], xs[x + 1], ys[y + 1]) for x, y in places}


def _rooms(rng: Random, cells: Mapping[tuple[int, int], Rectangle]) -> list[Table]:
    """The rooms of the file; rooms of the same kind are numbered."""
    kinds = list(islice(cycle(FURNITURE_OF_ROOM), len(cells)))
    total = Counter(kinds)
    rng.shuffle(kinds)
    seen: Counter[str] = Counter()
    rooms = []
    for kind, rectangle in zip(kinds, cells.values(), strict=True):
        seen[kind] += 1
        name = _snake(kind) + (f"_{seen[kind]}" if total[kind] > 1 else "")
        rooms.append({"name": name, "kind": kind, "rectangle": rectangle})
    return rooms


def _doors(rng: Random, cells: Mapping[tuple[int, int], Rectangle]) -> Iterator[Table]:
    """Doors that connect all rooms, and a few more, so that there are loops."""
    pairs = [((x, y), b) for x, y in cells for b in ((x + 1, y), (x, y + 1)) if b in cells]
    rng.shuffle(pairs)
    group = {cell: cell for cell in cells}
    for one, other in pairs:
        if group[one] == group[other] and rng.random() > 0.25:
            continue
        old, new = group[other], group[one]
        group = {cell: new if g == old else g for cell, g in group.items()}
        left, lower, right, upper = cells[other]
        start, end = (lower, upper) if one[1] == other[1] else (left, right)
        along = round(rng.uniform(start + DOOR_M, end - DOOR_M), 2)
        position = (left, along) if one[1] == other[1] else (along, lower)
        yield {"position": position, "width": DOOR_M}


def _pieces(walls: Mapping[str, "_Walls"], rooms: list[Table], number: int) -> Iterator[Table]:
    """Furniture for the rooms in turn, as far as there is room for it."""
    names: Counter[str] = Counter()
    for index in range(number):
        room = rooms[index % len(rooms)]
        kinds = FURNITURE_OF_ROOM[room["kind"]]
        kind = kinds[index // len(rooms) % len(kinds)]
        size, boards = SIZES[kind]
        pose = walls[room["name"]].put(size)
        if pose is None:
            return
        base = f"{_snake(kind)}_{room['name']}"
        names[base] += 1
        if names[base] > 1:
            base = f"{_snake(kind)}_{names[base]}_{room['name']}"
        piece: Table = {"name": base, "kind": kind, "room": room["name"]}
        yield {**piece, "pose": pose, "size": size, **({"boards": boards} if boards else {})}


class _Walls:
    """The free space along the walls of a room."""

    def __init__(self, rng: Random, room: Rectangle, doors: list[Table]) -> None:
        """Begin with no furniture; the floor in front of doors stays free."""
        self._rng = rng
        self._room = room
        self._taken: list[Rectangle] = []
        reach = DOOR_M / 2 + 0.4
        self._kept = [(x - reach, y - reach, x + reach, y + reach) for x, y in _positions(doors)]

    def put(self, size: tuple[float, float, float]) -> list[float] | None:
        """Find room for furniture along a wall; its pose in the file's units, or None."""
        depth, width, _ = size
        aside = min(width / 2, 0.5) + FOOTPRINT_M
        for _ in range(_TRIES):
            yaw = self._rng.choice((0, 90, 180, -90))
            left, lower, right, upper = self._room
            start, end = (lower, upper) if yaw in (0, 180) else (left, right)
            edge = _WALL_M + max(width / 2, aside)
            along = round(self._rng.uniform(start + edge, end - edge), 2)
            piece = self._before(yaw, along, width / 2 + _BESIDE_M, _WALL_M, _WALL_M + depth)
            front = self._before(yaw, along, aside, _WALL_M + depth, _WALL_M + depth + _STAND_M)
            if all(_are_apart(piece, other) for other in (*self._taken, *self._kept)) and all(
                _are_apart(front, other) for other in self._taken
            ):
                self._taken.append(piece)
                self._kept.append(front)
                x, y = (piece[0] + piece[2]) / 2, (piece[1] + piece[3]) / 2
                return [round(x, 3), round(y, 3), yaw]
        return None

    def _before(self, yaw: int, along: float, half: float, near: float, far: float) -> Rectangle:
        """The floor at distances `near` to `far` from the wall that `yaw` points away from."""
        left, lower, right, upper = self._room
        if yaw == 0:
            return left + near, along - half, left + far, along + half
        if yaw == 180:
            return right - far, along - half, right - near, along + half
        if yaw == 90:
            return along - half, lower + near, along + half, lower + far
        return along - half, upper - far, along + half, upper - near


def _objects(rng: Random, home: Home) -> Table | None:
    """Spots for all objects, on top of furniture, in a room where they belong if there is one."""
    models = load_objects()
    surfaces = {piece.name: piece.surfaces()[:1] for piece in home.furniture}
    kinds = {room.name: room.kind for room in home.rooms}
    wanted = rooms_of_objects()
    turned = {name for name, model in models.items() if model.size[1] > LONGEST_ACROSS_M}
    spots: dict[str, Spot] = {}
    for name in sorted(models, key=turned.__contains__):  # TOML has tables after values
        pieces = rng.sample(home.furniture, len(home.furniture))
        pieces.sort(key=lambda p: (p.kind in ("Bed", "Sofa"), kinds[p.room] not in wanted[name]))
        for piece in pieces:
            turn = 90.0 if name in turned else 0.0
            spot = Spot(furniture=piece.name, yaw=turn)
            try:
                arrange({**spots, name: spot}, surfaces, models)
            except NoRoomError:
                continue
            spots[name] = spot
            break
        else:
            return None
    return {
        name: {"furniture": spot.furniture, "yaw": 90} if name in turned else spot.furniture
        for name, spot in spots.items()
    }


def _with_short_arrays(text: str) -> str:
    """The same TOML with each array of numbers on one line."""
    return re.sub(r"\[\n([^\[\]]*),\n\]", lambda found: f"[{' '.join(found[1].split())}]", text)


def _positions(doors: list[Table]) -> list[tuple[float, float]]:
    return [door["position"] for door in doors]


def _are_apart(one: Rectangle, other: Rectangle) -> bool:
    return one[2] <= other[0] or other[2] <= one[0] or one[3] <= other[1] or other[3] <= one[1]


def _snake(kind: str) -> str:
    """`LivingRoom` -> `living_room`."""
    return "".join(f"_{c.lower()}" if c.isupper() else c for c in kind).lstrip("_")
