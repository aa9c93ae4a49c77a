"""Homes that strangers write, by mistake or in bad faith: a home, or a sentence for each fault."""

import math
import time
import tomllib
from pathlib import Path
from typing import Any

import pytest
import tomli_w
from hypothesis import example, given
from hypothesis import strategies as st
from written_homes import FLAT

from executive.errors import InputError
from executive.language.control import control
from executive.language.grammar import EnglishInterpreter
from executive.language.phrases import spoken
from executive.text import printable
from executive.types.home import Place
from kb.ontology.names import PlaceNames
from sim.__main__ import main
from sim.home.home_file import MOST_TOLD, home_text, inspect_home, load_home
from sim.home.naming import name_fault, taken_fault, usable
from sim.home.overlaps import overlapping
from sim.tools.checking import way_faults


@pytest.fixture
def said(tmp_path: Path):
    """All that is wrong with FLAT after some changes, as one text."""

    def said(*changes: tuple[str, str]) -> str:
        text = FLAT
        for right, wrong in changes:
            assert right in text
            text = text.replace(right, wrong)
        file = tmp_path / "flat.toml"
        file.write_text(text, encoding="utf-8")
        _, faults = inspect_home(str(file))
        return "\n".join(str(fault) for fault in faults)

    return said


NO_NAMES = {
    "": "is empty",
    "   ": "is empty",
    "a" * 65: "is longer than 64 characters",
    "\\u001b[2J": r"has the character '\x1b'",
    "desk\\nerror: all is well": r"has the character '\n'",
    "a\\u202eb": r"has the character '\u202e'",
    "a/b": "has the character '/'",
    "..": "has the character '.'",
    'a\\"b': "has the character '\"'",
    " desk": "does not begin and end with",
    "desk ": "does not begin and end with",
    "a  b": "two blanks in a row",
    "\\u00a0desk": r"has the character '\xa0'",
    "\\u3164": r"has the character '\u3164'",
    "desk\\ufe0f": r"has the character '\ufe0f'",
    "\\u0301desk": "does not begin and end with",
}


@pytest.mark.parametrize(("name", "sentence"), NO_NAMES.items())
def test_what_no_furniture_can_be_called_is_refused_with_what_would_be_right(
    said, name: str, sentence: str
) -> None:
    found = said(('"desk"', f'"{name}"'))
    assert "furniture " in found
    assert sentence in found
    assert "use up to 64 letters" in found
    assert all(line.isprintable() for line in found.split("\n"))


def test_of_a_list_with_a_fault_in_it_nobody_is_told_that_it_is_empty(said) -> None:
    [found] = said(("[0, 0, 5, 5]", "[0, 0, 1e12, 5]")).splitlines()
    assert "rooms.den.rectangle.2 is 1000000000000.0; input should be less" in found


@pytest.mark.parametrize("key", ["room", "kind", "home"])
def test_rooms_kinds_and_homes_have_names_too(said, key: str) -> None:
    change = {
        "room": ('"den"', '"a/den"'),
        "kind": ('"LivingRoom"', '"Living\\tRoom"'),
        "home": ("robot_start", 'name = "../flat"\nrobot_start'),
    }[key]
    assert "has the character" in said(change)


@pytest.mark.parametrize(
    "name",
    [
        *("hand", "the floor", "person", "delivery", "map", "Base-Link"),
        *("Wait", "never mind", "bye"),
        *("I do not know", "no idea", "NoIdea", "not_sure", "nothing there"),
        *("yes", "no", "ok", "of course", "nope", "me", "it", "there", "here", "anywhere"),
        *("stop", "where", "How many", "please", "Find it", "put it back", "thanks"),
    ],
)
def test_a_name_that_means_something_else_is_refused(said, name: str) -> None:
    assert f"furniture '{name}': this name has a meaning of its own" in said(
        ('"rack"', f'"{name}"')
    )
    assert f"room '{name}': this name has a meaning of its own" in said(('"den"', f'"{name}"'))


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("mug", "furniture 'mug': this is the name of an object"),
        ("sugar box", "furniture 'sugar box': this is the name of an object"),
        ("Den", "furniture Den: room den is called the same"),
        ("My Desk", "furniture My Desk and desk differ too little"),
        ("desk", "furniture 'desk' is there twice"),
        ("desks", "furniture desk and desks differ too little"),
        ("living room", "furniture living room: room den is called the same"),
        ("delivery table", "an answer with 'delivery' in it names the delivery table"),
        ("no_smoking_table", "leave 'no' out"),
        ("salt and pepper rack", "leave 'and' out"),
        ("the", "it has no word that says which place it is; add one"),
        ("d\u0435sk", "has letters of two alphabets in one word"),
    ],
)
def test_a_name_that_is_mistaken_for_another_is_refused(said, name: str, sentence: str) -> None:
    assert sentence in said(('"rack"', f'"{name}"'))


@pytest.mark.parametrize("label", ["the Den", "living room"])
def test_a_piece_that_is_called_like_a_room_is_refused(said, label: str) -> None:
    sentence = "furniture rack: room den is called the same"
    assert sentence in said(('name = "rack"', f'name = "rack"\nlabel = "{label}"'))


def test_a_room_that_is_called_like_a_piece_is_refused(said) -> None:
    assert "furniture rack: room den is called the same" in said(
        ('name = "den"', 'name = "den", label = "the rack"')
    )


def test_a_name_with_the_room_before_or_behind_is_one_name(said) -> None:
    found = said(('"rack"', '"den_cabinet"'), ('"desk"', '"cabinet_den"'))
    assert "furniture cabinet_den and den_cabinet differ too little" in found


@pytest.mark.parametrize("name", ["right shelf", "table_2", "shelf_hold"])
def test_a_name_that_has_such_a_word_in_it_and_is_found_all_the_same_is_fine(
    said, name: str
) -> None:
    assert said(('"rack"', f'"{name}"')) == ""


WORDS = (
    *("no", "not", "I", "do", "know", "idea", "yes", "sure", "right", "and", "or", "then", "the"),
    *("a", "any", "on", "top", "in", "desk", "shelf", "shelves", "2", "Anna's", "delivery", "none"),
    *("stop", "wait", "hold", "it", "me", "there", "LivingRoom", "can't", "never", "perhaps"),
)


@given(st.lists(st.sampled_from(WORDS), min_size=1, max_size=8), st.sampled_from(" _-"))
def test_what_a_place_may_be_called_names_it_when_it_is_said(words: list[str], by: str) -> None:
    name = by.join(words)
    if taken_fault(name) is None:
        place = Place(name, "Desk", "den", "Lobby")
        assert PlaceNames([place]).find(f"on the {spoken(name)}, please") == (name,)
        assert not EnglishInterpreter().declines(spoken(name))
        assert control(spoken(name)) is None


@pytest.mark.parametrize("name", ["Küchentisch", "Anna's desk", "тумба", "机", "shelf-2_b", "क्षेत्र"])
def test_names_of_any_language_are_fine(said, name: str) -> None:
    assert said(('"rack"', f'"{name}"')) == ""


def test_a_home_is_named_after_its_file_whatever_that_is_called(tmp_path: Path) -> None:
    file = tmp_path / "my (new) home.v2.toml"
    file.write_text(FLAT)
    assert load_home(str(file)).name == "my__new__home_v2"


@given(st.text(max_size=100))
@example("\u0301_\u0301-a")
@example("A\u0370-\u0370A")
def test_what_is_made_of_any_text_is_a_name(text: str) -> None:
    assert name_fault(usable(text)) is None


@pytest.mark.parametrize(
    ("right", "wrong", "sentence"),
    [
        ("[1, 1, 0]", "[1e9, 1, 0]", "robot_start.0 is 1000000000.0; .*1000"),
        ("[1, 1, 0]", "[1, 9, 0]", "robot_start: \\(1, 9\\) is outside of all rooms"),
        ("[2, 2, 180]", "[2, -1e300, 180]", "person.1 is -1e\\+300"),
        ("[2, 2, 180]", "[2, 2, inf]", "person.2 is inf"),
        ("[3, 4, -90]", "[3, nan, -90]", "furniture.desk.pose.1 is nan"),
        ("[3, 4, -90]", "[3, 4, 1e300]", "furniture.desk.pose.2 is"),
        ("[0, 0, 5, 5]", "[0, 0, 5000, 5]", "rectangle.2 is 5000; .* equal to 1000 \\(metres\\)"),
        ("[3, 4, -90]", "[3, true, -90]", "furniture.desk.pose.1 is true; "),
        ("[3, 4, -90]", '[3, "4", -90]', "furniture.desk.pose.1 is '4'"),
        ("[0.6, 1.2, 0.7]", "[0.6, 1.2, 700]", "furniture.desk.size.2 is 700"),
        ("[0.6, 1.2, 0.7]", "[0.6, 0, 0.7]", "furniture.desk.size.1 is 0"),
        ("width = 1", "width = 1e308", "doors.0.width is 1e\\+308"),
        ('mug = "desk"', 'mug = { furniture = "desk", at = [1e9, 0] }', "objects.mug.at.0 is"),
        ('mug = "desk"', 'mug = { furniture = "desk", surface = 9 }', "no spot is left"),
        ('mug = "desk"', "mug = [[[[1]]]]", "objects.mug is .*; input should be a valid table$"),
        (
            'kind = "Desk"',
            'kind = "Desk"\nboards = [0.1,0.1,0.1,0.1,0.1,0.1,0.1,0.1,0.1]',
            "boards",
        ),
    ],
)
def test_numbers_that_cannot_be_are_refused_by_their_key(
    tmp_path: Path, right: str, wrong: str, sentence: str
) -> None:
    assert right in FLAT
    file = tmp_path / "flat.toml"
    file.write_text(FLAT.replace(right, wrong))
    with pytest.raises(InputError, match=sentence):
        load_home(str(file))


def test_a_byte_order_mark_is_neither_home_nor_text(tmp_path: Path) -> None:
    file = tmp_path / "flat.toml"
    file.write_text(FLAT, encoding="utf-8-sig")
    assert load_home(str(file)).name == "flat"
    assert home_text(str(file)) == FLAT


def test_numbers_of_thousands_of_digits_are_a_sentence_at_the_door(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "flat.toml"
    file.write_text(FLAT.replace("[0, 0, 5, 5]", f"[0, 0, {'9' * 5000}, 5]"))
    assert main(["check", str(file)]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_of_thousands_of_faults_the_first_are_told(tmp_path: Path) -> None:
    desk = FLAT[FLAT.index("[[furniture]]") : FLAT.index('[[furniture]]\nname = "rack"')]
    many = "".join(desk.replace('"desk"', f'"desk {n}"') for n in range(1000))
    file = tmp_path / "flat.toml"
    file.write_text(FLAT.replace("[delivery]", f"{many}[delivery]"))
    _, faults = inspect_home(str(file))
    assert len(faults) == MOST_TOLD


Piece = tuple[float, float, float, float, float]
pieces = st.tuples(*[st.floats(-2, 2)] * 2, st.floats(-4, 4), *[st.floats(0.1, 2)] * 2)


def outline(piece: Piece) -> list[tuple[float, float]]:
    x, y, yaw, length, width = piece
    cos, sin = math.cos(yaw), math.sin(yaw)
    around = ((1, 1), (-1, 1), (-1, -1), (1, -1))
    half = [(a * length / 2, b * width / 2) for a, b in around]
    return [(x + cos * a - sin * b, y + sin * a + cos * b) for a, b in half]


@given(st.lists(pieces, max_size=6))
def test_a_point_in_two_rectangles_means_that_they_overlap(found: list[Piece]) -> None:
    def holds(piece: Piece, point: tuple[float, float]) -> bool:
        x, y, yaw, length, width = piece
        east, north = point[0] - x, point[1] - y
        ahead = math.cos(yaw) * east + math.sin(yaw) * north
        left = math.cos(yaw) * north - math.sin(yaw) * east
        return abs(ahead) < length / 2 - 1e-9 and abs(left) < width / 2 - 1e-9

    pairs = set(overlapping([outline(piece) for piece in found]))
    for one, other in ((a, b) for b in range(len(found)) for a in range(b)):
        inside = [p for p in (*outline(found[one]), found[one][:2]) if holds(found[other], p)]
        assert not inside or (one, other) in pairs


def test_rectangles_side_by_side_or_across_a_corner_do_not_overlap() -> None:
    square, beside = (0.0, 0.0, 0.0, 1.0, 1.0), (1.0, 0.0, 0.0, 1.0, 1.0)
    turned = (1.05, 1.05, math.pi / 4, 1.4, 0.7)
    assert list(overlapping([outline(square), outline(beside)])) == []
    assert list(overlapping([outline(square), outline(turned)])) == []
    across = (0.0, 0.0, 0.0, 3.0, 0.1), (0.0, 0.0, math.pi / 2, 3.0, 0.1)
    assert list(overlapping([outline(piece) for piece in across])) == [(0, 1)]


scalars = (
    st.none().map(lambda _: "")
    | st.booleans()
    | st.integers(-(2**63), 2**63 - 1)
    | st.floats()
    | st.text(max_size=8)
    | st.sampled_from(["desk", "hand", "LivingRoom", "Desk", "delivery", "mug", ""])
)
values = st.recursive(
    scalars,
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(
            st.sampled_from(["name", "kind", "room", "pose", "size", "rectangle", "at"])
            | st.sampled_from(["furniture", "box", "cylinder", "sphere", "mass", "color", "mesh"])
            | st.text(max_size=5),
            inner,
            max_size=5,
        )
    ),
    max_leaves=12,
)
KEYS = ("robot_start", "person", "rooms", "doors", "furniture", "delivery", "objects", "name")


def inspect_or_refuse(file: str) -> tuple[object, tuple[InputError, ...]]:
    try:
        return inspect_home(file)
    except InputError as error:
        return None, (error,)


def flat() -> dict[str, Any]:
    return tomllib.loads(FLAT)


@given(st.dictionaries(st.sampled_from(KEYS) | st.text(max_size=5), values, max_size=4))
def test_a_home_with_anything_in_it_is_a_home_or_a_sentence(
    tmp_path_factory: pytest.TempPathFactory, changes: dict[str, Any]
) -> None:
    file = tmp_path_factory.getbasetemp() / "any.toml"
    file.write_text(tomli_w.dumps({**flat(), **changes}), encoding="utf-8")
    _, faults = inspect_or_refuse(str(file))
    assert all(str(fault) == printable(fault) for fault in faults)


@pytest.mark.parametrize("key", ["rooms", "doors", "furniture"])
def test_what_no_home_has_so_many_of_is_refused_by_its_key(tmp_path: Path, key: str) -> None:
    file = tmp_path / "flat.toml"
    file.write_text(tomli_w.dumps({**flat(), key: [1] * 100_000}))
    _, faults = inspect_home(str(file))
    assert 0 < len(faults) <= MOST_TOLD
    assert key in str(faults[0])


def test_thousands_of_pieces_are_looked_at_in_seconds(tmp_path: Path) -> None:
    """Comparing each with each, one after the other, took half a minute."""
    piece = {"kind": "Desk", "room": "den", "size": [0.6, 1.2, 0.7]}
    many = [
        {"name": f"desk_{n}", "pose": [2.0 + n % 56 * 3, 2.0 + n // 56 * 3, -90], **piece}
        for n in range(3000)
    ]
    den = {"name": "den", "kind": "LivingRoom", "rectangle": [0, 0, 180, 180]}
    file = tmp_path / "hall.toml"
    home = {**flat(), "rooms": [den], "furniture": many, "objects": {"mug": "desk_7"}}
    file.write_text(tomli_w.dumps({**home, "robot_start": [1, 0.6, 0], "person": [0.6, 5, 0]}))
    began = time.process_time()
    loaded, faults = inspect_home(str(file))
    assert not [fault for fault in faults if "delivery" not in str(fault)]
    assert loaded
    list(way_faults(loaded))
    assert time.process_time() - began < 30
