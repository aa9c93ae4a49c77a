from collections.abc import Iterator

import numpy as np
import pytest
from kitchen import MODELS, Kitchen, home_before
from scipy.spatial.transform import Rotation

from executive.testing.bench import four_rooms
from executive.types.geometry import Pose
from executive.types.goals import DriveTo, Pick, PutDown
from executive.types.perception import Detection
from executive.types.results import Failed, Succeeded
from sim.body.skill import CannotError, Skill
from sim.home.validation import with_placement
from sim.manipulation.clutter import CELL_M, Column
from sim.manipulation.grasps import WIDEST, HandPose, find_grasps, varied
from sim.manipulation.placing import free_spots
from sim.manipulation.planning import PlanningWorld
from sim.manipulation.reaching import COMFORT
from sim.manipulation.registration import fit_pose
from sim.objects.solids import sample_surface, signed_distance
from sim.world import PhysicsWorld

pytestmark = pytest.mark.physics


@pytest.fixture
def kitchen() -> Iterator[Kitchen]:
    kitchen = Kitchen()
    kitchen.do(DriveTo(kitchen.place))
    yield kitchen
    kitchen.world.close()


def test_what_it_sees_it_picks_up_and_puts_down_again(kitchen: Kitchen) -> None:
    before = kitchen.world.truth("sugar_box")
    assert kitchen.world.resting_place("sugar_box") == "counter_wagon"
    assert kitchen.do(Pick(kitchen.detection_of("sugar_box"))) == Succeeded()
    assert kitchen.robot.holding
    assert kitchen.world.resting_place("sugar_box") is None
    assert kitchen.do(PutDown(kitchen.place)) == Succeeded()
    assert not kitchen.robot.holding
    assert kitchen.world.resting_place("sugar_box") == "counter_wagon"
    assert kitchen.world.truth("sugar_box").position[2] == pytest.approx(
        before.position[2], abs=2e-3
    )


def test_a_held_thing_is_put_nowhere_else_than_where_the_robot_is(kitchen: Kitchen) -> None:
    assert kitchen.do(PutDown("desk")) == Failed("I am not at the desk")


def test_what_is_hardly_seen_is_not_picked(kitchen: Kitchen) -> None:
    seen = kitchen.detection_of("sugar_box")
    hardly = Detection(seen.label, seen.confidence, seen.box, seen.mask, seen.points[:5])
    result = kitchen.do(Pick(hardly))
    assert result == Failed("I could not see the sugar_box well enough")


def test_an_unknown_thing_is_not_picked(kitchen: Kitchen) -> None:
    seen = kitchen.detection_of("sugar_box")
    unknown = Detection("anvil", 1.0, seen.box, seen.mask, seen.points)
    assert kitchen.do(Pick(unknown)) == Failed("I do not know how to grasp the anvil")


def test_what_was_taken_away_meanwhile_is_not_held(kitchen: Kitchen) -> None:
    seen = kitchen.detection_of("sugar_box")
    body = kitchen.world._body("sugar_box")
    kitchen.world._client.resetBasePositionAndOrientation(body, (5.0, 5.0, 0.1), (0, 0, 0, 1))
    result = kitchen.do(Pick(seen))
    assert result == Failed("I could not get hold of the sugar_box")
    assert not kitchen.robot.holding


@pytest.mark.parametrize(
    ("name", "place"),
    [
        ("spatula", "cabinet_kitchen"),
        ("hammer", "cabinet_kitchen"),
        ("adjustable_wrench", "counter_wagon"),
    ],
)
def test_what_lies_under_a_board_is_taken_as_believed_and_put_down(name: str, place: str) -> None:
    bench = Kitchen(with_placement(home_before(place), {name: place}), place)
    assert bench.do(DriveTo(place)) == Succeeded()
    assert bench.do(Pick(bench.detection_of(name, view=1))) == Succeeded()
    assert off_in_hand(bench.world, name) < 0.02
    assert bench.do(PutDown(place)) == Succeeded()
    assert bench.world.resting_place(name) == place
    bench.world.close()


@pytest.mark.parametrize(
    ("name", "place"), [("tomato_soup_can", "cabinet_kitchen"), ("banana", "shelf_lobby")]
)
def test_what_was_turned_or_passed_an_edge_in_the_hand_is_put_down(name: str, place: str) -> None:
    bench = Kitchen(with_placement(home_before(place), {name: place}), place)
    assert bench.do(DriveTo(place)) == Succeeded()
    assert bench.do(Pick(bench.detection_of(name))) == Succeeded()
    assert bench.do(PutDown(place)) == Succeeded()
    assert bench.world.resting_place(name) == place
    bench.world.close()


def test_every_way_to_a_spot_brings_the_thing_there_as_it_shall_stand(kitchen: Kitchen) -> None:
    assert kitchen.do(Pick(kitchen.detection_of("sugar_box"))) == Succeeded()
    manipulator = kitchen.robot._manipulator
    held, piece = manipulator.hand.held, manipulator._home.furniture_named(kitchen.place)
    here = manipulator._hardware.base_pose
    assert held is not None
    spots = list(free_spots(piece, piece.surfaces()[0], held.model, np.empty((0, 3))))[:3]
    ends = [
        (spot, hand.position + hand.rotation.apply(held.position), hand.rotation * held.rotation)
        for spot, approach in manipulator._chooser.ways_to_spots(held, piece, spots, here)
        for hand in approach.hands
    ]
    assert len(ends) > len(spots)
    for spot, position, rotation in ends:
        assert position == pytest.approx(spot.position, abs=1e-9)
        assert (rotation * Rotation.from_quat(spot.orientation).inv()).magnitude() < 1e-6


def test_what_is_taken_off_its_middle_does_not_turn_in_the_fingers() -> None:
    home = with_placement(home_before("refrigerator"), {"scissors": "refrigerator"})
    bench = Kitchen(home, "refrigerator", seed=2)
    assert bench.do(DriveTo("refrigerator")) == Succeeded()
    assert bench.do(Pick(bench.detection_of("scissors"))) == Succeeded()
    assert turned_in_hand(bench.world, "scissors") < np.radians(5.0)
    bench.world.close()


def test_what_is_knocked_out_of_the_hand_while_it_is_put_down_is_missed(kitchen: Kitchen) -> None:
    assert kitchen.do(Pick(kitchen.detection_of("sugar_box"))) == Succeeded()
    body, client = kitchen.world._body("sugar_box"), kitchen.world._client
    request = kitchen.robot.start(PutDown(kitchen.place))
    while kitchen.robot._manipulator._is_folded:
        kitchen.world.advance(0.1)
    client.resetBasePositionAndOrientation(body, (5.0, 5.0, 0.1), (0, 0, 0, 1))
    assert kitchen.end_of(request) == Failed("the sugar_box fell from my hand", lost=True)


def test_what_stayed_in_the_hand_of_an_arm_that_was_not_folded_is_not_grasped_again(
    kitchen: Kitchen, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = kitchen.detection_of("sugar_box")
    with monkeypatch.context() as stiff:
        stiff.setattr(kitchen.robot._manipulator, "stow", cannot_fold)
        assert kitchen.do(Pick(seen)) == Failed("I cannot fold my arm")
    assert kitchen.robot.holding
    assert kitchen.do(Pick(seen)) == Succeeded()
    assert kitchen.robot.holding


def cannot_fold() -> Skill:
    raise CannotError("I cannot fold my arm")
    yield


def test_an_arm_that_cannot_be_folded_without_a_touch_stays_out(kitchen: Kitchen) -> None:
    hardware, planning = kitchen.robot._manipulator._hardware, kitchen.world._planning
    for joint, position in zip(hardware._arm, COMFORT, strict=True):
        kitchen.world._client.resetJointState(hardware.body, joint, position)
    hardware.command_arm(COMFORT, np.zeros(len(COMFORT)))
    hand = planning.hand(hardware.base_pose, COMFORT).position
    around = np.arange(-0.6, 0.6, CELL_M)
    full = [Column(hand[0] + dx, hand[1] + dy, 0.0, 2.0) for dx in around for dy in around]
    planning.assume_clutter([], full)
    result = kitchen.do(DriveTo("desk"))
    assert result == Failed("I cannot fold my arm without touching anything")
    assert np.abs(hardware.arm_positions - COMFORT).max() < 0.1


def turned_in_hand(world: PhysicsWorld, name: str) -> float:
    """How far a thing is turned from how the robot believes it to be in the hand (radians)."""
    manipulator = world.robot._manipulator
    hardware, held = manipulator._hardware, manipulator.hand.held
    assert held
    hand = manipulator._planning.hand(hardware.base_pose, hardware.arm_positions)
    truly = Rotation.from_quat(world.truth(name).orientation)
    return float((hand.rotation * held.rotation * truly.inv()).magnitude())


def off_in_hand(world: PhysicsWorld, name: str) -> float:
    """How far a thing is from where in the hand the robot believes it (metres)."""
    manipulator = world.robot._manipulator
    hardware, held = manipulator._hardware, manipulator.hand.held
    assert held
    hand = manipulator._planning.hand(hardware.base_pose, hardware.arm_positions)
    believed = hand.position + hand.rotation.apply(held.position)
    return float(np.linalg.norm(believed - world.truth(name).position))


def test_of_a_box_at_eye_height_the_front_is_enough() -> None:
    model, turn, eye = MODELS["cracker_box"], Rotation.from_euler("z", 0.2), (1.2, 0.0, 0.1)
    points, normals = sample_surface(model.shapes)
    found = fit_pose(model, turn.apply(points[normals[:, 0] > 0.9]), np.array(eye))
    assert np.hypot(*found.position[:2]) < 4e-3
    away = (turn * Rotation.from_quat(found.orientation).inv()).magnitude()
    assert min(away, np.pi - away) < 0.02


def test_what_lies_on_its_broad_side_is_said_to_be_too_wide(kitchen: Kitchen) -> None:
    fall = Rotation.from_euler("y", np.pi / 2)
    x, y, z = kitchen.world.truth("sugar_box").position
    kitchen.world._client.resetBasePositionAndOrientation(
        kitchen.world._body("sugar_box"), (x, y, z + 0.02), fall.as_quat()
    )
    result = kitchen.do(Pick(kitchen.detection_of("sugar_box")))
    wide = "it is wider than my hand opens"
    assert result == Failed(f"I cannot grasp the sugar_box as it lies: {wide}")


@pytest.mark.parametrize("name", ["sugar_box", "mug", "mustard_bottle", "hammer"])
def test_the_visible_side_of_a_thing_tells_where_it_stands(name: str) -> None:
    model = MODELS[name]
    turn, stand = Rotation.from_euler("z", 1.9), np.array([2.0, 1.0, 0.8])
    points, normals = sample_surface(model.shapes)
    points, normals = turn.apply(points) + stand, turn.apply(normals)
    eye = np.array([1.2, 1.2, 1.4])
    visible = ((eye - points) * normals).sum(axis=1) > 0.05
    found = fit_pose(model, points[visible], eye)
    back = Rotation.from_quat(found.orientation).inv().apply(points - found.position)
    assert np.abs(signed_distance(model.shapes, back)).mean() < 2e-3


@pytest.mark.parametrize("name", sorted(MODELS))
def test_there_is_a_grasp_from_above_for_everything(name: str) -> None:
    grasps = find_grasps(MODELS[name], Pose((0.0, 0.0, 1.0)), facing=0.0, tilt=0.0)
    assert grasps
    assert all(grasp.hand.approach[2] == pytest.approx(-1.0) for grasp in grasps)


def test_a_box_is_taken_across_its_narrow_side() -> None:
    best = find_grasps(MODELS["cracker_box"], Pose(), facing=0.0, tilt=0.0)[0]
    across = best.hand.rotation.apply((0.0, 1.0, 0.0))
    assert abs(across[0]) > 0.95


def test_varied_grasps_are_spread_over_a_long_thing() -> None:
    grasps = varied(find_grasps(MODELS["spatula"], Pose(), facing=0.0, tilt=0.0), 8)
    places = [tuple(np.round(grasp.hand.position, 3)) for grasp in grasps]
    assert len(set(places)) == len(places) == 8
    assert np.ptp([place[0] for place in places]) + np.ptp([p[1] for p in places]) > 0.05


def test_of_a_mug_one_wall_is_taken() -> None:
    grasps = find_grasps(MODELS["mug"], Pose(), facing=0.0, tilt=0.0)
    off_middle = [np.hypot(*grasp.hand.position[:2]) for grasp in grasps[:5]]
    assert min(off_middle) > 0.03
    assert max(grasp.gap for grasp in grasps[:5]) < WIDEST


def test_a_spot_is_free_where_nothing_rises() -> None:
    piece = four_rooms().furniture_named("delivery")
    (top,) = piece.surfaces()
    empty = np.empty((0, 3))
    first = next(free_spots(piece, top, MODELS["mug"], empty)).position
    crowd = np.array(first) + np.random.default_rng(0).normal(0.0, 0.01, (50, 3)) + (0, 0, 0.05)
    second = next(free_spots(piece, top, MODELS["mug"], crowd)).position
    assert np.hypot(second[0] - first[0], second[1] - first[1]) > 0.05


@pytest.fixture(scope="module")
def planning() -> Iterator[PlanningWorld]:
    planning = PlanningWorld(four_rooms())
    yield planning
    planning.close()


def test_solved_joints_bring_the_hand_to_its_target(planning: PlanningWorld) -> None:
    base = np.array(four_rooms().robot_start)
    target = planning.hand(base, COMFORT).shifted(np.array([0.05, -0.1, 0.1]))
    found = planning.solve(base, target, COMFORT)
    assert found is not None
    assert np.linalg.norm(planning.hand(base, found).position - target.position) < 1e-3


def test_what_is_out_of_reach_has_no_solution_and_none_is_searched_for(
    planning: PlanningWorld, monkeypatch: pytest.MonkeyPatch
) -> None:
    base = np.array(four_rooms().robot_start)
    far = planning.hand(base, COMFORT).shifted(np.array([2.0, 0.0, 0.0]))
    monkeypatch.setattr(planning, "_error", None)
    assert planning.solve(base, far, COMFORT) is None


def test_where_the_hand_can_be_is_never_too_far(planning: PlanningWorld) -> None:
    random = np.random.default_rng(0)
    for _ in range(100):
        base, arm = random.uniform(-4.0, 4.0, 3), random.uniform(*planning.limits)
        outright = np.where(np.arange(8) % 2, 0.0, arm)
        for joints in (arm, np.clip(outright, *planning.limits)):
            assert planning.solve(base, planning.hand(base, joints), joints) is not None


def test_furniture_in_the_way_of_the_arm_is_named(planning: PlanningWorld) -> None:
    x, y, yaw = four_rooms().stand("high_table")
    near = np.array([x + 0.25 * np.cos(yaw), y + 0.25 * np.sin(yaw), yaw])
    assert planning.obstacle(near, COMFORT) == "high_table"
    assert planning.base_obstacle(np.array([x, y, yaw])) is None


def test_what_is_carried_keeps_a_margin_until_the_end_of_a_reach(planning: PlanningWorld) -> None:
    base, table = np.array(four_rooms().robot_start), four_rooms().furniture_named("high_table")
    (top,) = table.surfaces()
    hand, turn_back = planning.hand(base, COMFORT), planning.hand(base, COMFORT).rotation.inv()
    for height, on_the_way in ((0.005, "high_table"), (0.015, None)):
        above = np.array(table.to_map((*top.center[:2], top.center[2] + height)))
        offset = turn_back.apply(above - hand.position)
        planning.carry(MODELS["cracker_box"].shapes, HandPose(offset, turn_back))
        assert planning.obstacle(base, COMFORT) == on_the_way
        assert planning.obstacle(base, COMFORT, 0.0, reaching=True) is None
    planning.carry((), None)
