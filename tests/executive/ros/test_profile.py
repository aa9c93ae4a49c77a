"""A profile that is wrong is told with its key and what would be right."""

from pathlib import Path

import pytest
from motion_robot import PROFILE as MOTION_PROFILE
from second_robot import PROFILE

from executive.errors import InputError
from executive.ros.profile import load_profile, packaged_profiles
from executive.ros.templates import filled

WHOLE = PROFILE.read_text()
MOTIONS = MOTION_PROFILE.read_text()


def fault_of(tmp_path: Path, text: str) -> str:
    file = tmp_path / "mine.toml"
    file.write_text(text)
    with pytest.raises(InputError) as caught:
        load_profile(str(file))
    return str(caught.value)


@pytest.mark.parametrize(
    ("then", "now", "said"),
    [
        ('"/acme/go"', '"acme/go"', "drive.action is 'acme/go'; should begin with /"),
        ('"acme_msgs/action/Go"', '"Go"', "drive.type is 'Go'; should be PACKAGE/action/NAME"),
        ("silent_s = 3.0", "silent_s = -1", "drive.silent_s is -1; input should be greater"),
        ('where = "$pose"', 'where = "$nowhere"', "drive.goal has $nowhere; there are $pose"),
        ('goal = { where = "$pose", hurry = true }', "", "drive.goal is missing"),
        ('joint = "finger"', "", "joint and between belong together"),
        ("[odometry]", "[odometer]", "odometry is missing"),
        ("silent_s = 3.0", "leg_m = 2.0", "leg_m needs path"),
        ("silent_s = 3.0", "silent_s = true", "drive.silent_s is true; should be a number"),
        ("[camera]", "[camera]\nin_map = 0", "camera.in_map is 0; should be true or false"),
        ("about", "link_wait_s = -1\nabout", "link_wait_s is -1; input should be greater"),
        ('color = "/acme/rgb"', "", "camera.color is missing"),
        ("[frames]", "[frames]\nhat = 1", "there is no key frames.hat"),
        ("[frames]", '[limits]\nhours = ["8", "9"]\n[frames]', "limits.hours"),
        ("[frames]", '[limits]\nhours = ["08:00", "08:00"]\n[frames]', "or it would never drive"),
        ("[frames]", '[limits]\nhours = ["٠٨:00", "20:00"]\n[frames]', "should be like"),
        ('base = "body"', 'base = ""', "frames.base is ''; string should have at least 1"),
        ("[0.005, 0.035]", "[0.035, 0.005]", "hand: between should be two positions, the smaller"),
        ('where = "$pose"', "where = 7", "drive.goal has none of $pose, $place: all would be"),
        ('what = "$label", cloud = "$points"', "what = 1", "pick.goal has none of $label, $points"),
        ("hurry = true", "hurry = { by = [nan] }", "drive.goal: inf and nan cannot be sent"),
    ],
)
def test_what_is_wrong_is_told_with_its_key(tmp_path: Path, then: str, now: str, said: str) -> None:
    assert then in WHOLE
    assert said in fault_of(tmp_path, WHOLE.replace(then, now, 1))


def test_who_can_pick_up_has_to_put_down(tmp_path: Path) -> None:
    text = "\n\n".join(part for part in WHOLE.split("\n\n") if not part.startswith("[place]"))
    assert "pick and place belong together" in fault_of(tmp_path, text)


@pytest.mark.parametrize(
    ("then", "now", "said"),
    [
        ('mount = "neck"', "", "joints and mount are missing"),
        ("carry = { shoulder = 0.0, elbow = 2.0 }", "", "arm.carry is missing"),
        ("opens_m = 0.08", "opens_m = 0", "gripper.opens_m is 0"),
        ("open = 0.08", "open = 1e308", "gripper.open is 1e+308; input should be less than"),
        ("effort = 10.0", "effort = 0\nnewtons = true", "gripper: effort is not above 0"),
        ("effort = 10.0", "effort = 1\nnewtons = 1", "gripper.newtons is 1; should be true or"),
        ("closed = 0.0", "closed = 0.08", "gripper: open and closed are the same"),
        ("GripperCommand", "ParallelGripperCommand", "gripper: joint is missing: the name of"),
        ('tip = "grip"', 'tip = ""', "arm.tip is ''; string should have at least 1 character"),
        ("{ shoulder = 0.0, elbow = 2.0 }", "{}", "arm.carry is {}; table should have at least"),
        ("[arm]", "[odometer]", "there is no key odometer"),
    ],
)
def test_what_is_wrong_with_an_arm_is_told(tmp_path: Path, then: str, now: str, said: str) -> None:
    assert then in MOTIONS
    assert said in fault_of(tmp_path, MOTIONS.replace(then, now, 1))


def test_an_arm_needs_a_gripper_and_no_skills(tmp_path: Path) -> None:
    parts = MOTIONS.split("\n\n")
    alone = "\n\n".join(part for part in parts if not part.startswith("[gripper]"))
    assert "arm and gripper belong together" in fault_of(tmp_path, alone)
    skills = [part for part in WHOLE.split("\n\n") if part.startswith(("[pick]", "[place]"))]
    assert "not all of them" in fault_of(tmp_path, "\n\n".join([*parts, *skills]))


def test_an_unknown_name_lists_those_that_come_along() -> None:
    with pytest.raises(InputError, match="packaged are nav2, nav2_moveit2, served"):
        load_profile("r2d2")


@pytest.mark.parametrize("name", packaged_profiles())
def test_those_that_come_along_are_right_and_say_where_they_were_tried(name: str) -> None:
    profile = load_profile(name)
    assert profile.about
    assert profile.tried in ("in simulation", "not on hardware")


def test_a_goal_has_the_values_where_the_template_names_them() -> None:
    template = {"a": "$pose", "b": [{"c": "$label"}, 1.0], "d": "plain"}
    assert filled(template, {"pose": {"x": 1}, "label": "mug"}) == {
        "a": {"x": 1},
        "b": [{"c": "mug"}, 1.0],
        "d": "plain",
    }
