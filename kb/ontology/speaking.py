"""How to say the names of furniture and things."""

from collections import Counter
from collections.abc import Mapping, Sequence

from executive.language.phrases import spoken, stem, words_of
from executive.types.home import Called, Place


def places_called(
    places: Sequence[Place], prepositions: Mapping[str, str] | None = None
) -> dict[str, Called]:
    """How to say each piece of furniture.

    A name that ends with its room is said without it, followed by the room: `cabinet_kitchen` is
    "the cabinet in the kitchen". The same holds for names that occur in two rooms.

    Args:
        places: the furniture of a home.
        prepositions: the preposition for each class of furniture.
    """
    less_room = {place.name: _less_room(place) for place in places}
    count = Counter(words for words, _ in less_room.values())
    return {
        place.name: Called(
            words,
            preposition=(prepositions or {}).get(place.kind, "on"),
            room="" if words.startswith(f"{_room(place)} ") else _room(place),
            says_room=said or count[words] > 1,
        )
        for place in places
        for words, said in [less_room[place.name]]
    }


def thing_called(label: str, *, plural: bool = False, is_class: bool = False) -> Called:
    """How to say a thing, by its label: `sugar_box`, "TV remote", "Tennis Ball"."""
    words = label.split() if " " in label else spoken(label).split()
    plain = " ".join(word.lower() if word.istitle() else word for word in words)
    return Called(plain or label, plural=plural, bare=is_class)


def _less_room(place: Place) -> tuple[str, bool]:
    """The words of a name without the room at its end, and whether there was one."""
    if place.label:
        return place.label, False
    room = {*words_of(place.room), *words_of(spoken(place.room_kind))}
    words = spoken(place.name).split()
    if stem(words[0]) in room:
        less_room = spoken(place.name).removesuffix(f" {spoken(place.room)}")
        return less_room, less_room != spoken(place.name)
    kept = [word for word in words if stem(word) not in room]
    return " ".join(kept), len(kept) < len(words)


def _room(place: Place) -> str:
    return place.room_label or spoken(place.room)
