"""Finds the faults of a home whose file has valid keys and values: names, plan and placement."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import combinations

from executive.errors import InputError
from executive.language.naming import says_how_many
from executive.types.home import DELIVERY
from sim.home.arrangement import NoRoomError, Spot
from sim.home.floorplan import wall_axis, wall_lines
from sim.home.furniture import FORM_OF_KIND
from sim.home.home import Home
from sim.home.naming import LONGEST, RULE, alike, folded, name_fault, taken_fault
from sim.home.overlaps import overlapping
from sim.objects.objects import load_objects

Flaw = tuple[str, str]
"""What is wrong, and what would be right."""

LARGEST_M = 200.0
"""A larger home is probably not in metres."""
_SHOWN = 30
"""The most names in a list."""


def with_placement(home: Home, placement: Mapping[str, str]) -> Home:
    """A home with some objects on other furniture.

    Raises:
        InputError: if an object or a piece of furniture is unknown, or there is no room for it.
    """
    if not placement:
        return home
    nowhere = Spot(furniture="")
    spots = {n: home.objects.get(n, nowhere).moved(place) for n, place in placement.items()}
    placed = home.model_copy(update={"objects": {**home.objects, **spots}})
    for flaw in (*object_flaws(placed), *spot_flaws(placed)):
        raise InputError("--place", *flaw)
    return placed


def home_flaws(home: Home) -> Iterator[Flaw]:
    """All faults, without those that only follow from others."""
    misnamed = list(_name_flaws(home))
    yield from misnamed
    if misnamed:
        return
    unbuildable = [*_room_flaws(home), *_furniture_flaws(home)]
    yield from unbuildable
    yield from _layout_flaws(home)
    yield from _own_flaws(home)
    yield from object_flaws(home)
    if not unbuildable:
        yield from spot_flaws(home)


def _name_flaws(home: Home) -> Iterator[Flaw]:
    """Invalid names and kinds; messages about other faults would contain them."""
    pieces = (*home.furniture, home.delivery)
    named = [("home", "name", home.name)]
    named += [("room", "name", room.name) for room in home.rooms]
    named += [("room", "kind", room.kind) for room in home.rooms]
    named += [("furniture", "name", piece.name) for piece in pieces]
    named += [("furniture", "kind", piece.kind) for piece in pieces]
    labelled = [("room", room) for room in home.rooms] + [("furniture", p) for p in pieces]
    named += [(what, "label", one.label) for what, one in labelled if one.label]
    named += [("object", "name", name) for name in home.own]
    named += [("object", "kind", one.kind) for one in home.own.values()]
    for what, key, name in named:
        if fault := name_fault(name):
            yield f"{what} {_cut(name)}: its {key} {fault}", RULE


def _room_flaws(home: Home) -> Iterator[Flaw]:
    yield from _taken("room", [room.name for room in home.rooms])
    yield from _labels_taken("room", [r.label for r in home.rooms], [r.name for r in home.rooms])
    for room in home.rooms:
        left, lower, right, upper = room.rectangle
        if left >= right or lower >= upper:
            yield f"room {room.name} has no area", "give left, lower, right and upper edge"
    left, lower, right, upper = home.extent()
    if max(right - left, upper - lower) > LARGEST_M:
        yield f"the rooms span more than {LARGEST_M:g} m", "give metres"
    lines = wall_lines(home.rooms)
    for door in home.doors:
        if wall_axis(door, lines) is None:
            on_edge = "put its middle on the edge of a room, away from the corners"
            yield f"the door at {door.position} is not in a wall", on_edge
    for who, (x, y, _) in (("robot_start", home.robot_start), ("person", home.person)):
        if not any(room.holds(x, y) for room in home.rooms):
            yield f"{who}: ({x:g}, {y:g}) is outside of all rooms", "give a point in a room"


def _taken(what: str, names: Sequence[str], rooms: Sequence[str] = ()) -> Iterator[Flaw]:
    """Names that already mean something else, or that are used more than once.

    Args:
        what: what has these names, for messages.
        names: the names.
        rooms: the names of the rooms that each is in, if it is in one.
    """
    things = {folded(name) for name in load_objects()}
    for name in names:
        if fault := taken_fault(name):
            yield f"{what} {name!r}: {fault[0]}", fault[1]
        elif folded(name) in things:
            yield f"{what} {name!r}: this is the name of an object", "give another name"
    for same in alike(names, rooms):
        right = "give each its own name"
        if len(set(same)) == 1:
            yield f"{what} {same[0]!r} is there twice", right
        else:
            few = " and ".join(sorted(set(same))[:4])
            yield f"{what} {few} differ too little to be kept apart", right


def _labels_taken(what: str, labels: Sequence[str], names: Sequence[str]) -> Iterator[Flaw]:
    """Labels that already mean something else, or that are used more than once."""
    if any(labels):
        called = [label or name for label, name in zip(labels, names, strict=True)]
        yield from _taken(f"{what} that is called", called)


def _furniture_flaws(home: Home) -> Iterator[Flaw]:
    rooms = {room.name for room in home.rooms}
    spoken = {folded(room.kind): room.name for room in home.rooms}
    spoken |= {folded(room.label): room.name for room in home.rooms if room.label}
    spoken |= {folded(name): name for name in rooms}
    kinds = {room.name: room.kind for room in home.rooms}
    yield from _taken(
        "furniture",
        [piece.name for piece in home.furniture],
        [f"{piece.room} {kinds.get(piece.room, '')}" for piece in home.furniture],
    )
    labels = [piece.label for piece in home.furniture]
    yield from _labels_taken("furniture", labels, [piece.name for piece in home.furniture])
    if home.delivery.name != DELIVERY:
        yield f"the delivery table is named {home.delivery.name}", f"name it {DELIVERY}"
    for piece in (*home.furniture, home.delivery):
        of = f"furniture {piece.name}"
        for called in filter(None, (piece.name, piece.label)):
            if room := spoken.get(folded(called)):
                yield f"{of}: room {room} is called the same", f"name it as in {called}_table"
        if piece.room not in rooms:
            yield f"{of}: no room {_cut(piece.room)}", f"rooms: {_some(r.name for r in home.rooms)}"
        if piece.form is None and piece.kind not in FORM_OF_KIND:
            known = f"known are {', '.join(FORM_OF_KIND)}; or give its form"
            yield f"{of}: cannot build kind {piece.kind!r}", known
        elif max(piece.boards, default=0.0) >= piece.size[2]:
            yield f"{of}: a board is above its top", f"below {piece.size[2]} m"
        elif min(length for shape in piece.shapes() for length in shape.size) <= 0:
            yield f"{of}: too small or too low to be built", "make it larger"
        elif not piece.surfaces():
            yield f"{of}: nothing can stand on it", "give its boards"


def _layout_flaws(home: Home) -> Iterator[Flaw]:
    for room, neighbour in combinations(home.rooms, 2):
        if room.overlaps(neighbour):
            yield f"room {room.name} and {neighbour.name} overlap", "let them share an edge at most"
    rooms = {room.name: room for room in home.rooms}
    pieces = (*home.furniture, home.delivery)
    outlines = [piece.corners() for piece in pieces]
    for piece, corners in zip(pieces, outlines, strict=True):
        here = rooms.get(piece.room)
        if here and not all(here.holds(x, y) for x, y in corners):
            yield f"furniture {piece.name}: it sticks out of room {here.name}", "move it inside"
    for one, other in overlapping(outlines):
        names = f"{pieces[one].name} and {pieces[other].name}"
        yield f"furniture {names} overlap", "move one of them"


def _own_flaws(home: Home) -> Iterator[Flaw]:
    """Declared objects whose name something else has, or that are named like a number."""
    yield from _taken("object", list(home.own))
    called = {folded(room.name): f"room {room.name}" for room in home.rooms}
    called |= {folded(piece.name): f"furniture {piece.name}" for piece in home.furniture}
    for name in home.own:
        if other := called.get(folded(name)):
            yield f"object {name}: {other} is called the same", "give another name"
        elif says_how_many(name):
            yield f"object {name}: its name says how many", "give another name"


def mesh_flaws(home: Home) -> Iterator[Flaw]:
    """Meshes that are missing, outside the home's folder, or not usable."""
    for name in home.own:
        try:
            home.drawn_model(name)
        except InputError as error:
            where, what, right = error.args
            yield f"objects.{name}.mesh: {where} {what}", right


def object_flaws(home: Home) -> Iterator[Flaw]:
    """Unknown objects, and objects on unknown furniture."""
    models = home.models()
    furniture = _surfaces_of(home)
    for name, spot in home.objects.items():
        if name not in models:
            right = f"objects: {', '.join(models)}; or say its kind, its form and its mass"
            yield f"there is no object {_cut(name)}", right
        if spot.furniture not in furniture:
            what = f"{_cut(name)}: there is no furniture {_cut(spot.furniture)}"
            yield what, f"furniture: {_some(furniture)}"


def spot_flaws(home: Home) -> Iterator[Flaw]:
    """Objects without room on their furniture; those of `object_flaws` are skipped."""
    furniture, models = _surfaces_of(home), home.models()
    left = {n: s for n, s in home.objects.items() if n in models and s.furniture in furniture}
    while True:
        try:
            home.model_copy(update={"objects": left}).arrangement()
        except NoRoomError as error:
            yield f"{error.name}: {error}", "choose another place for it"
            del left[error.name]
        else:
            return


def _surfaces_of(home: Home) -> dict[str, None]:
    """Names of all furniture that objects can be on, in the file's order."""
    return dict.fromkeys([*(piece.name for piece in home.furniture), DELIVERY])


def _some(names: Iterable[str]) -> str:
    listed = list(names)
    return ", ".join([*listed[:_SHOWN], *(["..."] if len(listed) > _SHOWN else [])])


def _cut(name: str) -> str:
    return repr(name if len(name) <= LONGEST else f"{name[:LONGEST]}...")
