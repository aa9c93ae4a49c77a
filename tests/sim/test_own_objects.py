"""Objects that a home file declares itself: what may be said of one, and what is refused."""

import os
from pathlib import Path

import pytest
from written_homes import FLAT

from executive.errors import InputError
from sim.bullet.bodies import home_entities
from sim.faults.orders import Moved, parse_faults
from sim.home.home import Home
from sim.home.home_file import inspect_home, load_home, recorded_home
from sim.home.validation import with_placement
from sim.manipulation.grasps import WIDEST
from sim.objects.objects import OPENING_M, load_objects, why_not_taken
from sim.tools.checking import check_home, notes_on

TEAPOT = """
[objects.teapot]
kind = "Kitchenware"
furniture = "desk"
cylinder = [0.07, 0.12]
mass = 0.4
color = "#336699"
"""
WEDGE = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n"


@pytest.fixture
def write(tmp_path: Path):
    """Write FLAT with a declaration behind it."""

    def write(declared: str = TEAPOT) -> str:
        file = tmp_path / "flat.toml"
        file.write_text(FLAT + declared, encoding="utf-8")
        return str(file)

    return write


@pytest.fixture
def said(write):
    """All that is wrong with TEAPOT after a change, as one text."""

    def said(right: str, wrong: str) -> str:
        assert right in TEAPOT
        _, faults = inspect_home(write(TEAPOT.replace(right, wrong)))
        return "\n".join(str(fault) for fault in faults)

    return said


@pytest.fixture
def home(write) -> Home:
    return load_home(write())


def test_what_a_file_declares_is_a_thing_among_those_of_the_package(home: Home) -> None:
    teapot = home.models()["teapot"]
    assert home.models().keys() - load_objects().keys() == {"teapot"}
    assert (teapot.size, teapot.mass_kg) == ((0.07, 0.07, 0.12), 0.4)
    assert teapot.shapes[0].color == pytest.approx((0.2, 0.4, 0.6, 1.0))
    assert [(thing.name, thing.kind) for thing in home.things()] == [("teapot", "Kitchenware")]


@pytest.mark.parametrize(
    ("form", "size"),
    [
        ("box = [0.04, 0.1, 0.2]", (0.04, 0.1, 0.2)),
        ("sphere = 0.06", (0.06, 0.06, 0.06)),
    ],
)
def test_it_may_be_a_box_or_a_sphere_and_of_no_colour(write, form: str, size) -> None:
    text = TEAPOT.replace("cylinder = [0.07, 0.12]", form).replace('color = "#336699"', "")
    ball = load_home(write(text)).models()["teapot"]
    assert ball.size == size
    assert ball.lower[2] == 0.0


def test_it_stands_on_its_furniture_and_may_be_placed_elsewhere(home: Home) -> None:
    assert home.object_pose("teapot").position[2] == pytest.approx(0.7)
    moved = with_placement(home, {"teapot": "rack"})
    assert moved.placement["teapot"] == "rack"
    assert moved.models()["teapot"] == home.models()["teapot"]


def test_someone_may_move_it_by_order(home: Home) -> None:
    (fault,) = parse_faults(["moved=teapot:rack@1"], home)
    assert isinstance(fault, Moved)
    assert fault.pose(home) == with_placement(home, {"teapot": "rack"}).object_pose("teapot")


def test_one_line_is_enough_and_says_where_on_the_furniture_too(write) -> None:
    line = 'ball = { kind = "Toy", furniture = "rack", at = [0.1, 0.2], sphere = 0.05, mass = 0.1 }'
    home = load_home(write(line))
    assert home.own["ball"].at == (0.1, 0.2)


def test_the_recording_shows_it_as_it_is(home: Home) -> None:
    (teapot,) = (e for e in home_entities(home, home.drawn_models()) if e.name == "teapot")
    assert [shape.kind for shape in teapot.shapes] == ["cylinder"]


def test_what_is_too_wide_or_too_heavy_is_allowed_and_said(write) -> None:
    assert pytest.approx(WIDEST) == OPENING_M
    crate = write(TEAPOT.replace("[0.07, 0.12]", "[0.2, 0.2]"))
    assert check_home(crate) == ()
    (note,) = notes_on(crate)
    assert "teapot: it can be found, not brought: it is wider than my hand opens" in str(note)
    heavy = load_home(write(TEAPOT.replace("0.4", "4"))).models()["teapot"]
    assert why_not_taken(heavy) == "it is heavier than my arm may lift"


def test_nothing_of_the_package_is_too_much_for_the_hand() -> None:
    assert not any(map(why_not_taken, load_objects().values()))


@pytest.mark.parametrize(
    ("right", "wrong", "sentence"),
    [
        ("0.07", "-0.07", "objects.teapot.cylinder.0 is -0.07; input should be greater than"),
        ("0.07", "nan", "objects.teapot.cylinder.0 is nan"),
        ("0.12", "3", "objects.teapot.cylinder.1 is 3; input should be less than or equal to 0.5"),
        ("0.4", "0", "objects.teapot.mass is 0"),
        ("0.4", '"inf"', "objects.teapot.mass is 'inf'"),
        ("mass = 0.4", "", "objects.teapot.mass is missing; see docs/own-home.md"),
        ('kind = "Kitchenware"', "", "objects.teapot.kind is missing"),
        ('furniture = "desk"', "", "objects.teapot.furniture is missing"),
        ('"desk"', '"attic"', "'teapot': there is no furniture 'attic'; furniture: desk, rack"),
        (
            "mass =",
            "weight = 2\nmass =",
            "there is no key objects.teapot.weight; see docs/own-home",
        ),
        ("cylinder = [0.07, 0.12]", "", "give one of box, cylinder and sphere"),
        ("mass", "sphere = 0.1\nmass", "give one of box, cylinder and sphere"),
        (
            "#336699",
            "blue",
            "objects.teapot.color is 'blue'; write red, green and blue as in #3366",
        ),
        ("Kitchenware", "Kit\\u001b[2J", r"its kind has the character '\x1b'"),
        ("[objects.teapot]", '[objects."tea\\u202epot"]', r"its name has the character '\u202e'"),
        ("[objects.teapot]", '[objects."the mug"]', "this is the name of an object"),
        ("[objects.teapot]", "[objects.hand]", "this name has a meaning of its own"),
        ("[objects.teapot]", "[objects.Desk]", "object Desk: furniture desk is called the same"),
        ("[objects.teapot]", "[objects.den]", "object den: room den is called the same"),
        (
            "[objects.teapot]",
            '[objects."two mugs"]',
            "two mugs: its name says how many; give another",
        ),
    ],
)
def test_what_cannot_be_is_refused_by_its_key_with_what_would_be_right(
    said, right: str, wrong: str, sentence: str
) -> None:
    found = said(right, wrong)
    assert sentence in found
    assert all(line.isprintable() for line in found.split("\n"))


# --- meshes ---


def meshed(name: str) -> str:
    return f'{TEAPOT}mesh = "{name}"\n'


def test_a_mesh_is_scaled_to_the_form_and_seen_instead_of_it(write, tmp_path: Path) -> None:
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes" / "wedge.obj").write_text(WEDGE)
    home = load_home(write(meshed("meshes/wedge.obj")))
    drawn = home.drawn_models()["teapot"]
    assert drawn.look
    assert drawn.look.mesh == str(tmp_path / "meshes" / "wedge.obj")
    assert drawn.shown == (drawn.look,)
    assert (drawn.shapes, drawn.size) == (home.models()["teapot"].shapes, (0.07, 0.07, 0.12))


def test_a_recorded_home_is_read_without_its_meshes(write, tmp_path: Path) -> None:
    mesh = tmp_path / "wedge.obj"
    mesh.write_text(WEDGE)
    file = Path(write(meshed("wedge.obj")))
    mesh.unlink()
    home = recorded_home(file.read_bytes())
    assert home.drawn_models() == home.models()
    with pytest.raises(InputError, match=r"objects.teapot.mesh: .*wedge.obj cannot be read"):
        load_home(str(file))


@pytest.mark.parametrize("corners", ["f -4 -3 -2", "f -4/1/1 -3//1 -2/1"])
def test_a_mesh_may_count_its_points_back_from_each_face(
    write, tmp_path: Path, corners: str
) -> None:
    (tmp_path / "back.obj").write_text(f"{WEDGE}{corners}\n")
    assert load_home(write(meshed("back.obj"))).drawn_models()["teapot"].look


@pytest.mark.parametrize("name", ["../far.obj", "link.obj", "sub/../../far.obj"])
def test_a_mesh_outside_of_the_homes_folder_is_not_opened(
    write, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    inside = tmp_path / "mine"
    inside.mkdir()
    far = tmp_path / "far.obj"
    os.mkfifo(far)  # who opens it waits for ever
    (inside / "link.obj").symlink_to(far)
    file = inside / "flat.toml"
    file.write_text(FLAT + meshed(name))
    with pytest.raises(InputError, match="is outside of the folder of the home file"):
        load_home(str(file))


@pytest.mark.parametrize(
    ("name", "content", "sentence"),
    [
        ("a.glb", WEDGE, "'a.glb' is no OBJ file; name an .obj file"),
        ("a.obj", "hello", "has no faces"),
        ("a.obj", WEDGE.replace("v 1", "v nan"), "has points that enclose no volume"),
        ("a.obj", WEDGE.replace("v 0 0 1", "v 1 1 0"), "has points that enclose no volume"),
        ("a.obj", f"o {'a' * 2000}\n{WEDGE}", "has a line of more than 1000 characters"),
        ("a.obj", f"{WEDGE}f -4 -5 -1\n", "faces of points that it does not have"),
        ("a.obj", f"f -4 -3 -2\n{WEDGE}", "faces of points that it does not have"),
        ("a.obj", f"{WEDGE}f 0 1 2\n", "faces of points that it does not have"),
        ("a.obj", f"mtllib no.mtl\n{WEDGE}", "; put it there, or take the line mtllib out"),
        ("a.obj", f"mtllib /etc/passwd\n{WEDGE}", "names a file that is elsewhere"),
    ],
)
def test_what_is_no_mesh_is_refused(
    write, tmp_path: Path, name: str, content: str, sentence: str
) -> None:
    (tmp_path / name).write_text(content)
    with pytest.raises(InputError, match=r"objects\.teapot\.mesh: ") as refused:
        load_home(write(meshed(name)))
    assert sentence in str(refused.value)
