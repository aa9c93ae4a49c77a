"""`--robot` and `--profile`: missions with a robot over the wire, and what is said before them."""

import json
import math
import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from second_robot import PROFILE, TOPICS, SecondRobot

from executive.__main__ import main
from executive.replay import replay
from executive.ros.__main__ import main as look
from executive.ros.address import HEADERS
from executive.testing.bench import four_rooms

NOBODY = "ws://127.0.0.1:9"


@pytest.fixture
def there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[SecondRobot]:
    monkeypatch.chdir(tmp_path)
    with SecondRobot(four_rooms().robot_start) as robot:
        yield robot


def run(*options: str) -> int:
    return main(["--llm", "none", "--user", "none", *options])


def profile_without(tmp_path: Path, *sections: str, **replaced: str) -> str:
    text = PROFILE.read_text()
    parts = [part for part in text.split("\n\n") if part.split("]")[0].lstrip("[") not in sections]
    text = "\n\n".join(parts)
    for name, other in replaced.items():
        text = text.replace(f"/acme/{name}", other)
    file = tmp_path / "changed.toml"
    file.write_text(text)
    return str(file)


def test_a_mission_over_the_wire_looks_for_the_thing_and_replays(
    there: SecondRobot, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert run("--robot", there.url, "--profile", str(PROFILE), "--json", "Find a power_drill") == 1
    outcome = json.loads(capsys.readouterr().out)
    assert outcome["visited"]
    assert replay(tmp_path / outcome["run_dir"]).parting is None
    assert {action for action, _ in there.goals} == {"/acme/go"}


def test_a_goal_that_never_ends_is_given_up_whatever_is_heard_of_it(
    there: SecondRobot, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    there.endless.add("/acme/go")
    hasty = tmp_path / "hasty.toml"
    hasty.write_text("action_timeout_s = 1.0\n")
    robot = ("--robot", there.url, "--profile", str(PROFILE), "--config", str(hasty))
    assert run(*robot, "Go to the desk") == 1
    assert "I could not get to the desk: it took longer than 1 s" in capsys.readouterr().out
    assert not there.busy
    assert not there.speed


def test_a_robot_without_an_arm_declines_at_once_to_bring(
    there: SecondRobot, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    profile = profile_without(tmp_path, "pick", "place", "hand")
    assert run("--robot", there.url, "--profile", profile, "--json", "Bring a mug") == 1
    outcome = json.loads(capsys.readouterr().out)
    assert "I have no arm" in outcome["reason"]
    assert not there.goals
    assert replay(tmp_path / outcome["run_dir"]).parting is None


def test_where_nobody_answers_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("--robot", NOBODY, "--profile", str(PROFILE), "Find a mug") == 2
    said = capsys.readouterr().err
    assert "nobody listens there (is rosbridge started?)" in said
    assert "docs/own-robot.md" in said


def test_a_robot_needs_a_profile(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("--robot", NOBODY, "Find a mug") == 2
    assert "--profile nav2, nav2_moveit2, served" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "other", "said"),
    [
        (
            "go",
            "/acme/walk",
            "drive: the robot has no action /acme/walk; of this type there is /acme/go",
        ),
        ("rgb", "/acme/odom", "/acme/odom is of type nav_msgs/msg/Odometry, and not sensor_msgs"),
        ("lens", "/acme/lense", "no topic /acme/lense; of this type there is /acme/lens"),
    ],
)
def test_what_does_not_fit_the_robot_is_said_before_anything_moves(
    there: SecondRobot,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    name: str,
    other: str,
    said: str,
) -> None:
    profile = profile_without(tmp_path, **{name: other})
    assert run("--robot", there.url, "--profile", profile, "Find a mug") == 2
    assert said in capsys.readouterr().err
    assert not there.goals


def test_what_is_of_another_type_is_not_proposed(
    there: SecondRobot, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    file = tmp_path / "other.toml"
    file.write_text(PROFILE.read_text().replace("/go", "/goo").replace("action/Go", "action/Run"))
    assert look(["check", there.url, "--profile", str(file)]) == 2
    said = capsys.readouterr().err
    assert "drive: the robot has no action /acme/goo; it has nothing of this type" in said


def test_a_clock_that_tells_no_time_is_refused(
    there: SecondRobot, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    there.topics = TOPICS | {"/acme/clock": "rosgraph_msgs/msg/Clock"}
    file = tmp_path / "clock.toml"
    file.write_text(f'{PROFILE.read_text()}\n[clock]\ntopic = "/acme/clock"\n')
    assert look(["check", there.url, "--profile", str(file)]) == 2
    assert "clock: nobody tells the time on /acme/clock" in capsys.readouterr().err


@pytest.mark.parametrize("velocity", [[], [math.nan]])
def test_joints_that_do_not_tell_whether_they_move_are_refused(
    there: SecondRobot, capsys: pytest.CaptureFixture[str], tmp_path: Path, velocity: list[float]
) -> None:
    there.told["/acme/fingers"] = {"velocity": velocity}
    file = tmp_path / "joints.toml"
    file.write_text(f'{PROFILE.read_text()}\n[joints]\ntopic = "/acme/fingers"\n')
    assert look(["check", there.url, "--profile", str(file)]) == 2
    assert "nobody tells on /acme/fingers whether my joints move" in capsys.readouterr().err


def test_a_robot_that_is_nowhere_in_the_map_is_refused(
    there: SecondRobot, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    file = tmp_path / "lost.toml"
    file.write_text(PROFILE.read_text().replace('"world"', '"map"'))
    assert run("--robot", there.url, "--profile", str(file), "Find a mug") == 2
    assert "nobody tells where body is in map" in capsys.readouterr().err


def test_a_room_that_the_home_does_not_have_is_refused(
    there: SecondRobot, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    file = tmp_path / "slip.toml"
    file.write_text(f'{PROFILE.read_text()}\n[limits]\nrooms = ["kitchen", "kichen"]\n')
    assert run("--robot", there.url, "--profile", str(file), "Find a mug") == 2
    assert "limits.rooms: the home has no room kichen; it has kitchen" in capsys.readouterr().err


def test_faults_are_not_for_robots_over_the_wire(
    there: SecondRobot, capsys: pytest.CaptureFixture[str]
) -> None:
    robot = ("--robot", there.url, "--profile", str(PROFILE))
    assert run(*robot, "--fault", "slip", "Find a mug") == 2
    assert f"the robot at {there.url}" in capsys.readouterr().err


def test_look_lists_what_the_robot_offers_and_proposes_a_profile(
    there: SecondRobot, capsys: pytest.CaptureFixture[str]
) -> None:
    assert look(["look", there.url]) == 0
    said = capsys.readouterr().out
    assert "/acme/go  acme_msgs/action/Go" in said
    assert 'map = "map"  # not told; there are body, ' in said
    assert '\ntopic = "/acme/odom"' in said
    assert 'action = ""  # not found; there is /acme/go (acme_msgs/action/Go), ' in said
    assert 'depth = ""  # not found; there is /acme/range\n' in said
    assert "# [joints]  # if velocities are told there" in said
    assert '# topic = "/acme/fingers"' in said


class Namespaced(SecondRobot):
    """What tells where it is has a name of its own, too."""

    frames = "/acme/tf"
    topics = {**{k: v for k, v in TOPICS.items() if k != "/tf"}, frames: TOPICS["/tf"]}


def test_frames_are_told_on_the_topic_that_the_profile_names(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "namespaced.toml"
    with Namespaced(four_rooms().robot_start) as robot:
        assert look(["check", robot.url, "--profile", str(PROFILE)]) == 2
        why = "frames.tf: the robot has no topic /tf; of this type there is /acme/tf"
        assert why in capsys.readouterr().err
        assert look(["look", robot.url]) == 0
        said = capsys.readouterr().out
        assert "there are body, eye, world" in said
        (told,) = [line for line in said.splitlines() if line.startswith("tf = ")]
        file.write_text(PROFILE.read_text().replace("[frames]", f"[frames]\n{told}"))
        assert look(["check", robot.url, "--profile", str(file)]) == 0


def test_pictures_of_several_cameras_are_refused(
    there: SecondRobot, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "eyes.toml"
    file.write_text(PROFILE.read_text().replace('camera = "eye"', ""))
    assert look(["check", there.url, "--profile", str(file)]) == 0
    there.told["/acme/lens"] = {"header": {"frame_id": "third_eye"}}
    assert look(["check", there.url, "--profile", str(file)]) == 2
    assert "colour, depth and lens are of eye, third_eye" in capsys.readouterr().err


def test_check_says_that_a_profile_fits(
    there: SecondRobot, capsys: pytest.CaptureFixture[str]
) -> None:
    assert look(["check", there.url, "--profile", str(PROFILE)]) == 0
    assert "fits the robot" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("then", "now", "said"),
    [
        ('color = "/acme/rgb"', 'color = "/acme/range"', "a colour picture with encoding '16UC1'"),
        ('depth = "/acme/range"', 'depth = "/acme/rgb"', "a depth picture with encoding 'bgr8'"),
        ('joint = "finger"', 'joint = "thumb"', "nobody tells on /acme/fingers where thumb is"),
    ],
)
def test_check_says_what_only_messages_tell(
    there: SecondRobot,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    then: str,
    now: str,
    said: str,
) -> None:
    file = with_slip(tmp_path, then, now)
    assert look(["check", there.url, "--profile", str(file)]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize(
    ("then", "now", "said"),
    [
        (
            'where = "$pose"',
            'wher = "$pose"',
            "no field wher; it has where (geometry_msgs/PoseStamped), ",
        ),
        ('where = "$pose"', 'where = "$place"', "in acme_msgs/Go_Goal, and $place is not; $pose"),
        ('"$pose"', '{ pos = "$pose" }', "PoseStamped has no field pos; it has header (std_msgs/"),
        ('"$pose"', '{ header = { frame_id = 1 }, pose = "$pose" }', "frame_id is string in std"),
        ("hurry = true", 'hurry = "yes"', "hurry is boolean in acme_msgs/Go_Goal, and yes is not"),
        ("hurry = true", "hurry = 1", "hurry is boolean in acme_msgs/Go_Goal, and 1 is not"),
        ('what = "$label"', 'what = "$points"', "pick.goal: what is string in acme_msgs/Grab_Goal"),
        ('near = "$point"', 'near = "$pose"', "and $pose is not; $point"),
    ],
)
def test_a_goal_that_does_not_fit_the_action_is_said_before_anything_moves(
    there: SecondRobot,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    then: str,
    now: str,
    said: str,
) -> None:
    file = with_slip(tmp_path, then, now)
    assert look(["check", there.url, "--profile", str(file)]) == 2
    assert said in capsys.readouterr().err


def with_slip(folder: Path, then: str, now: str) -> Path:
    """The robot's profile, with something else in it."""
    text = PROFILE.read_text()
    assert then in text
    file = folder / "slip.toml"
    file.write_text(text.replace(then, now))
    return file


def test_check_says_that_a_picture_may_come_too_late(
    there: SecondRobot, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    there.told["/acme/range"] = {"header": {"stamp": {"sec": 0, "nanosec": 0}}}
    file = with_slip(tmp_path, "[camera]", "[camera]\nlate_s = 0.5")
    assert look(["check", there.url, "--profile", str(file)]) == 2
    assert "over a slow link, give camera.late_s more" in capsys.readouterr().err


def test_profiles_that_come_along_can_be_read(capsys: pytest.CaptureFixture[str]) -> None:
    assert look(["profiles"]) == 0
    assert "nav2  a robot with Nav2" in capsys.readouterr().out


def test_headers_of_the_environment_are_sent_and_recorded_nowhere(
    there: SecondRobot, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setitem(os.environ, HEADERS, '{"Authorization": "Bearer letmein"}')
    run("--robot", there.url, "--profile", str(PROFILE), "Find a mug")
    assert {headers["Authorization"] for headers in there.headers} == {"Bearer letmein"}
    kept = [file for file in (tmp_path / "runs").rglob("*") if file.is_file()]
    assert kept
    assert not any(b"letmein" in file.read_bytes() for file in kept)
