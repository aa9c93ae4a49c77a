import math
from pathlib import Path

import pytest
from written_homes import FLAT

from executive.errors import InputError
from executive.types.home import DELIVERY, PERSON
from sim.bullet.bodies import home_entities
from sim.home.home import STAND_OFF_M, Home
from sim.home.home_file import load_home
from sim.home.validation import with_placement
from sim.objects.objects import load_objects

PAPER_COMMANDS = {
    "apple": "dining_table",
    "power_drill": "shelf_lobby",
    "colored_wood_blocks": "bookshelf_bedroom",
    "pitcher_base": "counter_wagon",
    "potted_meat_can": "cabinet_kitchen",
    "peach": "high_table",
    "mug": "coffee_table",
    "mustard_bottle": "cabinet_kitchen",
    "sugar_box": "counter_wagon",
}
HAND_OPENING_M = 0.08


@pytest.fixture
def four_rooms() -> Home:
    return load_home("four_rooms")


@pytest.fixture
def load(tmp_path: Path):
    def load(text: str) -> Home:
        file = tmp_path / "flat.toml"
        file.write_text(text)
        return load_home(str(file))

    return load


def test_the_four_rooms_hold_the_objects_of_the_papers_commands_where_its_table_says(four_rooms):
    assert PAPER_COMMANDS.items() <= four_rooms.placement.items()
    assert four_rooms.placement.keys() <= load_objects().keys()


def test_places_are_the_searchable_furniture_with_its_room(four_rooms):
    places = {place.name: place for place in four_rooms.places()}
    assert len(places) == 12
    assert DELIVERY not in places
    assert places["counter_wagon"].kind == "Wagon"
    assert places["counter_wagon"].room_kind == "Kitchen"


def test_a_minimal_home_of_ones_own_loads_and_is_named_after_its_file(load):
    assert load(FLAT).name == "flat"


def test_the_robot_stands_before_the_front_and_faces_it(load):
    x, y, yaw = load(FLAT).stand("desk")
    assert (x, y) == pytest.approx((3, 4 - 0.3 - STAND_OFF_M))
    assert yaw == pytest.approx(math.pi / 2)


def test_the_robot_talks_to_the_person_face_to_face(load):
    x, y, yaw = load(FLAT).stand(PERSON)
    assert (x, y, yaw) == pytest.approx((1.1, 2, 0))


def test_walls_leave_the_doors_open(load):
    south = [wall for wall in load(FLAT).walls() if wall.center[1] == 0]
    gap = sorted(
        (wall.center[0] - wall.size[0] / 2, wall.center[0] + wall.size[0] / 2) for wall in south
    )
    assert gap[0][1] == pytest.approx(1.5)
    assert gap[1][0] == pytest.approx(2.5)


def test_things_stand_on_their_furniture_within_reach_of_its_user(four_rooms):
    for name, place in four_rooms.placement.items():
        x, y, _ = four_rooms.stand(place)
        position = four_rooms.object_pose(name).position
        assert 0.35 < math.dist((x, y), position[:2]) < 0.95, name
        heights = [surface.center[2] for surface in four_rooms.furniture_named(place).surfaces()]
        assert position[2] == pytest.approx(heights[0]), name


def test_things_are_far_enough_apart_for_a_hand(four_rooms):
    standing = four_rooms.arrangement()
    models = load_objects()
    for name, other in ((a, b) for a in standing for b in standing if a < b):
        if four_rooms.placement[name] == four_rooms.placement[other]:
            middle_to_middle = abs(standing[name].y - standing[other].y)
            halves = sum(min(models[n].size[:2]) / 2 for n in (name, other))
            assert middle_to_middle - halves >= 0.12 - 1e-9, (name, other)


def test_every_thing_that_is_taken_from_above_fits_into_the_hand_across_its_middle():
    for model in load_objects().values():
        if model.grasp == "top":
            middle = [s for s in model.shapes if abs(s.pose.position[1]) <= max(s.size[1:]) / 2]
            assert middle, model.name
            assert max(shape.size[0] for shape in middle) < HAND_OPENING_M, model.name


def test_placement_can_be_changed_and_the_first_home_stays_as_it_was(four_rooms):
    moved = with_placement(four_rooms, {"mug": "bed"})
    assert moved.placement["mug"] == "bed"
    assert moved.object_pose("mug").position[2] == pytest.approx(0.5)
    assert four_rooms.placement["mug"] == "coffee_table"


def test_an_exact_spot_is_kept(load):
    spot = '{ furniture = "rack", surface = 1, at = [0.1, 0.2], yaw = 90 }'
    home = load(FLAT.replace('mug = "desk"', f"mug = {spot}"))
    pose = home.object_pose("mug")
    assert pose.position == pytest.approx((0.6, 3.2, 0.4))
    assert pose.orientation == pytest.approx((0, 0, math.sqrt(0.5), math.sqrt(0.5)))


def test_what_does_not_fit_on_the_top_goes_on_a_board(four_rooms):
    names = ("power_drill", "cracker_box", "pitcher_base", "mustard_bottle", "bleach_cleanser")
    crowded = with_placement(four_rooms, dict.fromkeys(names, "sideboard"))
    heights = {crowded.object_pose(name).position[2] for name in names}
    assert heights == {0.80, 0.46}


def test_a_board_too_low_for_a_thing_is_no_place_for_it(load):
    low = FLAT.replace("[0.4]", "[0.87]")
    with pytest.raises(InputError, match="mug: no spot is left for it on rack"):
        load(low.replace('mug = "desk"', 'mug = { furniture = "rack", surface = 1 }'))


def test_no_part_of_furniture_is_in_the_free_space_above_its_surfaces(four_rooms):
    for piece in (*four_rooms.furniture, four_rooms.delivery):
        for surface in piece.surfaces():
            height = min(surface.clearance, 0.5)
            x, y, z = surface.center
            free = ((x, surface.length_x), (y, surface.length_y), (z + height / 2, height))
            for shape in piece.shapes():
                gaps = [
                    abs(middle - other) - (length + size) / 2
                    for (middle, length), other, size in zip(
                        free, shape.pose.position, shape.size, strict=True
                    )
                ]
                assert max(gaps) > -1e-6, (piece.name, shape)


def test_the_viewer_sees_over_the_walls_and_moves_things_by_frames_of_their_names(four_rooms):
    entities = {entity.name: entity for entity in home_entities(four_rooms, load_objects())}
    assert entities["mug"].frame_id == "mug"
    assert entities["desk"].frame_id == "map"
    assert entities["wall_1"].shapes[0].size[2] < 1


FAULTS = {
    "not TOML": ("robot_start = [1, 1, 0]", "robot_start = [", "not TOML"),
    "unknown key": (
        "robot_start",
        "robot_begin",
        "there is no key robot_begin|robot_start is missing",
    ),
    "missing key": ("person = [2, 2, 180]", "", "person is missing"),
    "wrong type": ("[1, 1, 0]", '["here", 1, 0]', "robot_start.0 is 'here'; .*valid number"),
    "wrong type in furniture": ("0.6, 1.2, 0.7", "0.6, -1, 0.7", "furniture.desk.size.1 is -1; "),
    "room without area": ("[0, 0, 5, 5]", "[5, 0, 0, 5]", "room den has no area"),
    "rooms that overlap": (
        "[0, 0, 5, 5] }",
        '[0, 0, 5, 5] }, { name = "loo", kind = "Bathroom", rectangle = [4, 4, 6, 6] }',
        "room den and loo overlap",
    ),
    "millimetres": ("[0, 0, 5, 5]", "[0, 0, 5000, 5000]", "rooms.den.rectangle.2 is 5000; .*1000"),
    "feet": ("[0, 0, 5, 5]", "[0, 0, 500, 500]", "rooms span more than 200 m"),
    "door in no wall": ("[2, 0]", "[2, 1]", "door at .* is not in a wall"),
    "a label of none": (
        'name = "desk"',
        'name = "desk"\nlabel = "Anna;"',
        "its label has the character",
    ),
    "a label that is taken": (
        'name = "desk"',
        'name = "desk"\nlabel = "the mug"',
        "that is called 'the mug': this is the name of an object",
    ),
    "unknown room": (
        'room = "den"',
        'room = "loo"',
        "no room 'loo'; rooms: den",
    ),
    "unknown kind": ('"Desk"', '"Trunk"', "cannot build kind 'Trunk'; known are Table"),
    "board too high": ("[0.4]", "[1.4]", "rack: a board is above its top"),
    "board on the floor": ("[0.4]", "[0.01]", "rack: too small or too low to be built"),
    "closed fridge": (
        'kind = "Desk"',
        'kind = "Refrigerator"',
        "desk: nothing can stand on it; give its boards",
    ),
    "furniture outside": ("[3, 4, -90]", "[3, 5, -90]", "desk: it sticks out of room den"),
    "same name": ('"rack"', '"desk"', "furniture 'desk' is there twice"),
    "reserved name": ('"rack"', '"person"', "furniture 'person': this name has a meaning"),
    "overlap": ("[0.5, 3, 0]", "[2.5, 4, 0]", "desk and rack overlap"),
    "unknown object": ("mug =", "muk =", "there is no object 'muk'; objects: apple"),
    "unknown furniture": (
        'mug = "desk"',
        'mug = "bed"',
        "no furniture 'bed'; furniture: desk, rack",
    ),
    "spot off the surface": (
        'mug = "desk"',
        'mug = { furniture = "desk", at = [0.4, 0] }',
        r"mug: it does not fit at \(0.4, 0.0\) on desk",
    ),
}


@pytest.mark.parametrize(("right", "wrong", "sentence"), FAULTS.values(), ids=FAULTS)
def test_a_fault_in_a_home_file_is_named(load, right: str, wrong: str, sentence: str):
    assert right in FLAT
    with pytest.raises(InputError, match=sentence) as error:
        load(FLAT.replace(right, wrong, 1))
    assert "flat.toml: " in str(error.value)


def test_an_unknown_home_names_the_packaged_ones():
    with pytest.raises(InputError, match="home villa: .* packaged are four_rooms"):
        load_home("villa")


def test_a_missing_home_file_names_the_packaged_ones():
    with pytest.raises(InputError, match="villa.toml: .*No such file.* packaged are four_rooms"):
        load_home("villa.toml")


@pytest.mark.parametrize(
    ("placement", "sentence"),
    [
        ({"mug": "attic"}, "there is no furniture 'attic'; furniture: cabinet_kitchen"),
        ({"sword": "bed"}, "there is no object 'sword'; objects: apple"),
        ({"hammer": "delivery", "mug": "delivery", "banana": "delivery"}, "no spot is left"),
    ],
)
def test_a_wrong_placement_is_named(four_rooms, placement: dict[str, str], sentence: str):
    with pytest.raises(InputError, match=f"--place: .*{sentence}"):
        with_placement(four_rooms, placement)


def test_all_poses_at_once_are_those_of_each(four_rooms):
    poses = four_rooms.object_poses()
    assert list(poses) == list(four_rooms.objects)
    assert poses["mug"] == four_rooms.object_pose("mug")
