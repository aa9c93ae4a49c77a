"""`python -m sim`: what it says about a home that someone wrote."""

import json
import tomllib
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from ontologies import KETTLE, rdf
from written_homes import FLAT

from executive.__main__ import main as executive
from executive.types.home import Place
from kb.ontology.ontology import Ontology
from sim.__main__ import main
from sim.home.furniture import FORM_OF_KIND
from sim.home.home import Home
from sim.home.home_file import load_home
from sim.home.validation import home_flaws
from sim.objects.objects import load_objects
from sim.tools.checking import check_home, way_faults
from sim.tools.generation import FURNITURE_OF_ROOM, generate_home


@pytest.fixture
def faults(tmp_path: Path):
    def faults(*changes: tuple[str, str]) -> str:
        text = FLAT
        for right, wrong in changes:
            assert right in text
            text = text.replace(right, wrong, 1)
        file = tmp_path / "flat.toml"
        file.write_text(text)
        return "\n".join(str(fault) for fault in check_home(str(file)))

    return faults


@pytest.mark.physics
def test_the_packaged_home_has_no_faults():
    assert check_home("four_rooms") == ()


def test_a_minimal_home_has_no_faults(faults):
    assert faults() == ""


def test_all_faults_of_a_files_form_are_named_at_once(faults):
    found = faults(('"Desk"', "3"), ("width = 1", "width = -1"), ("[1, 1, 0]", "[nan, 1, 0]"))
    assert len(found.splitlines()) == 3
    assert "furniture.desk.kind is 3" in found
    assert "doors.0.width is -1" in found
    assert "robot_start.0 is nan" in found


def test_all_faults_of_a_plan_are_named_at_once(faults):
    found = faults(
        ("[0.5, 3, 0]", "[2.5, 4, 0]"),
        ('room = "den"', 'room = "loo"'),
        ("[4, 1, 90]", "[6, 1, 90]"),
        ("mug =", "muk ="),
    )
    assert "furniture desk: no room 'loo'; rooms: den" in found
    assert "desk and rack overlap" in found
    assert "furniture delivery: it sticks out of room den" in found
    assert "there is no object 'muk'" in found


def test_every_thing_without_a_spot_is_named(faults):
    crowd = "\n".join(f'{name} = "delivery"' for name in ("hammer", "mug", "banana", "apple"))
    found = faults(('mug = "desk"', crowd))
    assert found.count("no spot is left for it on delivery") >= 2


CLOSET = """rooms = [
  { name = "den", kind = "LivingRoom", rectangle = [0, 0, 5, 5] },
  { name = "closet", kind = "StorageRoom", rectangle = [5, 0, 9, 5] },
]
doors = [{ position = [5, 2.5], width = 0.7 }]

[[furniture]]
name = "box_shelf"
kind = "Shelf"
room = "closet"
pose = [8.5, 2.5, 180]
size = [0.4, 1, 1]
"""
ROOMS = FLAT[FLAT.index("rooms =") : FLAT.index("\n[[furniture]]")]


def test_a_door_too_narrow_and_what_is_behind_it_are_named(faults):
    narrow, behind = faults((ROOMS, CLOSET)).splitlines()
    assert "the door at (5.0, 2.5) is too narrow for the robot; make its width 0.81 m" in narrow
    assert "furniture box_shelf: it cannot be reached from robot_start; make a way to" in behind


def test_the_width_that_is_asked_for_is_enough(faults):
    assert faults((ROOMS, CLOSET.replace("width = 0.7", "width = 0.81"))) == ""


@pytest.mark.parametrize(
    ("right", "wrong", "sentence"),
    [
        ("[3, 4, -90]", "[3, 4.5, 90]", "furniture desk: there is no room for the robot to stand"),
        ("[4, 1, 90]", "[4, 0.4, -90]", "delivery: there is no room for the robot to stand"),
        ("[2, 2, 180]", "[0.6, 1.5, 180]", "person: there is no room for the robot to stand"),
        ("[2, 2, 180]", "[7, 2, 180]", "person: (7, 2) is outside of all rooms"),
        ("[1, 1, 0]", "[3, 4, 0]", r"robot_start: the robot does not fit at (3.0, 4.0)"),
    ],
)
def test_what_the_robot_cannot_use_is_named(faults, right: str, wrong: str, sentence: str):
    assert sentence in faults((right, wrong))


def test_a_thing_at_the_back_of_a_deep_table_is_out_of_reach(faults):
    deep, back = ("[0.6, 1.2, 0.7]", "[1.6, 1.2, 0.7]"), 'mug = { furniture = "desk", at = '
    assert faults(deep, ('mug = "desk"', back + "[0.5, 0.3] }")) == ""
    found = faults(deep, ('mug = "desk"', back + "[-0.6, 0.3] }"))
    assert "mug: it is out of the arm's reach on desk; put it nearer to the front" in found


def test_the_exit_status_says_fine_faulty_or_unreadable(tmp_path: Path, capsys):
    file = tmp_path / "flat.toml"
    file.write_text(FLAT)
    assert main(["check", str(file)]) == 0
    file.write_text(FLAT.replace('"desk"', '"person"', 1))
    assert main(["check", str(file)]) == 1
    assert "furniture 'person': this name has a meaning of its own" in capsys.readouterr().out
    file.write_text("robot_start = [")
    assert main(["check", str(file)]) == 2
    assert "not TOML" in capsys.readouterr().err
    assert main(["check", "villa"]) == 2


def test_the_arm_is_not_tried_where_the_robot_cannot_stand(tmp_path: Path):
    deep = FLAT.replace("[0.6, 1.2, 0.7]", "[1.6, 1.2, 0.7]")
    file = tmp_path / "flat.toml"
    file.write_text(
        deep.replace('mug = "desk"', 'mug = { furniture = "desk", at = [-0.6, 0.3] }').replace(
            "[4, 1, 90]", "[4, 0.4, -90]"
        )
    )
    [fault] = check_home(str(file))
    assert "delivery: there is no room for the robot to stand" in str(fault)


TEAPOT = """
[objects.teapot]
kind = "Kettle"
furniture = "desk"
sphere = 0.07
mass = 0.4
"""


def test_every_class_that_the_ontology_does_not_know_is_named(tmp_path: Path, capsys):
    desk = 'kind = "Fruit"\nform = "table"'
    flat = FLAT.replace('"LivingRoom"', '"Dungeon"').replace('kind = "Desk"', desk)
    file = tmp_path / "flat.toml"
    file.write_text(flat + TEAPOT)
    assert main(["check", str(file)]) == 1
    told = capsys.readouterr().out
    assert "den: is a 'Dungeon', which the ontology lacks; known are Room, Kitchen" in told
    assert "desk: is a 'Fruit', which is no kind of furniture; known are Furniture" in told
    assert "teapot: is a 'Kettle', which the ontology lacks; known are Object" in told
    assert len(told.splitlines()) == 3


def test_a_class_of_ones_own_file_is_known(tmp_path: Path, capsys):
    file = tmp_path / "flat.toml"
    file.write_text(FLAT + TEAPOT)
    assert main(["check", str(file), "--kb", str(rdf(tmp_path, KETTLE))]) == 0
    assert "no faults" in capsys.readouterr().out


def test_json_lists_the_sentences(tmp_path: Path, capsys):
    file = tmp_path / "flat.toml"
    file.write_text(FLAT.replace('"desk"', '"person"', 1).replace('"rack"', '"person"'))
    assert main(["check", str(file), "--json"]) == 1
    sentences = json.loads(capsys.readouterr().out)
    assert (
        f"{file}: furniture 'person': this name has a meaning of its own; give another name"
        in sentences
    )


def test_what_is_allowed_is_a_note_and_no_fault(capsys):
    example = Path(__file__).parents[2] / "docs" / "examples" / "own_object.toml"
    assert main(["check", str(example)]) == 0
    note, verdict = capsys.readouterr().out.splitlines()
    assert note.startswith(f"note: {example}: crate: it can be found, not brought")
    assert verdict == f"{example}: no faults"


SIZES = [(1, 8, 1), (3, 12, 2), (4, 40, 1), (30, 150, 1)]


@pytest.mark.parametrize(("rooms", "furniture", "seed"), SIZES)
def test_a_generated_home_has_what_was_asked_for_and_no_faults(
    tmp_path: Path, rooms: int, furniture: int, seed: int
):
    file = tmp_path / "home.toml"
    file.write_text(generate_home(rooms, furniture, seed))
    home = load_home(str(file))
    assert (len(home.rooms), len(home.furniture)) == (rooms, furniture)
    assert home.placement.keys() == load_objects().keys()
    assert not any(way_faults(home))


@given(seed=st.integers(0, 2**32))
@settings(max_examples=8)
def test_every_seed_gives_a_sound_home(seed: int):
    home = Home.model_validate({"name": "home", **tomllib.loads(generate_home(5, 20, seed))})
    assert not any(home_flaws(home))
    assert not any(way_faults(home))


@pytest.mark.physics
def test_the_arm_reaches_everything_in_a_generated_home(tmp_path: Path):
    file = tmp_path / "home.toml"
    assert main(["generate", "--rooms=6", "--furniture=24", "--seed=5", f"--out={file}"]) == 0
    assert check_home(str(file)) == ()


def test_the_same_seed_gives_the_same_home_and_another_one_another():
    assert generate_home(4, 12, 7) == generate_home(4, 12, 7)
    assert generate_home(4, 12, 7).splitlines()[1:] != generate_home(4, 12, 8).splitlines()[1:]


def test_the_ontology_knows_every_kind_of_room_and_furniture_that_is_generated():
    pieces = [(kind, room) for room, kinds in FURNITURE_OF_ROOM.items() for kind in kinds]
    places = [Place(f"{kind}_{room}", kind, room.lower(), room) for kind, room in pieces]
    assert len(Ontology(places).places()) == len(pieces)


def test_the_whole_system_runs_in_a_generated_home(tmp_path: Path, monkeypatch):
    monkeypatch.setattr("executive.__main__.stop_on_signals", lambda inbox: None)
    file = tmp_path / "home.toml"
    file.write_text(generate_home(12, 60, 3))
    options = ["--world=fake", "--user=oracle", "--llm=none"]
    here = [f"--home={file}", f"--runs={tmp_path}", "Find an apple"]
    assert executive([*options, *here]) == 0


@pytest.mark.parametrize(("rooms", "furniture"), [(0, 10), (1000, 2000), (2, 3), (20, 10), (1, 41)])
def test_a_home_that_cannot_be_is_refused_with_what_can(rooms: int, furniture: int, capsys):
    assert main(["generate", f"--rooms={rooms}", f"--furniture={furniture}"]) == 2
    assert "; give " in capsys.readouterr().err


def test_a_file_that_cannot_be_written_is_named(tmp_path: Path, capsys):
    assert main(["generate", f"--out={tmp_path}/no/home.toml"]) == 2
    assert "no/home.toml: cannot write: No such file or directory" in capsys.readouterr().err


def test_the_home_in_the_documentation_has_no_faults(tmp_path: Path):
    page = Path(__file__).parents[2].joinpath("docs", "own-home.md").read_text()
    example = page.split("```toml\n")[1].split("```")[0]
    file = tmp_path / "studio.toml"
    file.write_text(example)
    assert check_home(str(file)) == ()
    assert load_home(str(file)).placement == {"mug": "desk", "sugar_box": "pantry_rack"}


def test_the_documentation_names_every_kind_that_can_be_built_as_it_is():
    page = Path(__file__).parents[2].joinpath("docs", "own-home.md").read_text()
    assert all(f"`{kind}`" in page for kind in FORM_OF_KIND)
