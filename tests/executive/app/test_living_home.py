import io
import logging
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from executive import Session, load_settings
from executive.app.embodiment import Embodiment
from executive.app.living import LivingHome
from executive.errors import InputError
from executive.replay import replay
from executive.testing.bench import four_rooms
from executive.types.outcome import Outcome
from sim.home.arrangement import Spot
from sim.home.state import HomeState, read_state, spot_on, with_room, write_state

FOREIGN = [
    ('name = "house"\nrooms = []\n', "is no state of a home: home: is missing; name a file"),
    ("home = 3\ntime_s = 0.0\n", "is no state of a home: home"),
    ("home = ", "is not TOML"),
    ('home = "villa"\ntime_s = 0.0\n', "is the state of the home villa, not of four_rooms"),
    ('home = "four_rooms"\ntime_s = -1.0\n', "is no state of a home: time_s"),
    ('home = "four_rooms"\ntime_s = 0.0\n[objects]\nlamp = "desk"\n', "there is no object lamp"),
    ('home = "four_rooms"\ntime_s = 0.0\n[objects]\nmug = "piano"\n', "no furniture piano"),
    (
        'home = "four_rooms"\ntime_s = 0.0\n[objects]\nmug = {furniture = "desk", surface = 7}\n',
        "desk has no surface 7; it has 1",
    ),
]


@pytest.fixture
def state(tmp_path: Path) -> Path:
    return tmp_path / "home.toml"


@pytest.fixture
def program(tmp_path: Path, state: Path) -> Callable[..., Outcome]:
    def run(words: str, **settings: Any) -> Outcome:
        given = {"world": "fake", "llm": "none", "user": "oracle", "home_state": state}
        given |= {"detector": "simulated", "camera_hz": 0.0, "runs": tmp_path / "runs"}
        with Session(load_settings(**{**given, **settings}), out=io.StringIO()) as session:
            return session.run(words)

    return run


@pytest.mark.parametrize("world", ["fake", pytest.param("physics", marks=pytest.mark.physics)])
def test_what_was_brought_is_where_it_was_left_in_the_next_program(
    program: Callable[..., Outcome], world: str
) -> None:
    assert program("Bring the hammer", world=world).location == "shelf_lobby"
    assert program("Find the hammer", world=world, user="oracle").location == "delivery"


def test_what_the_robot_still_holds_is_put_back_where_it_was(
    program: Callable[..., Outcome], state: Path
) -> None:
    program("Take the mug")
    assert tomllib.loads(state.read_text())["objects"]["mug"] == "coffee_table"


def test_what_is_placed_by_option_is_not_where_it_was_left(
    program: Callable[..., Outcome],
) -> None:
    program("Bring the mug")
    assert program("Find the mug", place={"mug": "desk"}).location == "desk"


def test_time_does_not_run_backwards_in_a_home(
    program: Callable[..., Outcome], state: Path
) -> None:
    write_state(state, HomeState(home="four_rooms", time_s=9e9))
    took_s = program("Find the mug").mission_time_s
    assert tomllib.loads(state.read_text())["time_s"] == pytest.approx(9e9 + took_s, abs=0.1)


@pytest.mark.parametrize(("text", "sentence"), FOREIGN)
def test_a_file_that_is_no_state_of_this_home_is_refused_and_stays_as_it_is(
    program: Callable[..., Outcome], state: Path, text: str, sentence: str
) -> None:
    state.write_text(text)
    with pytest.raises(InputError, match=sentence):
        program("Find the mug")
    assert state.read_text() == text


def test_a_folder_that_cannot_be_written_to_is_told_before_anything_begins(
    program: Callable[..., Outcome], tmp_path: Path
) -> None:
    with pytest.raises(InputError, match="could not be kept: No such file or directory"):
        program("Find the mug", home_state=tmp_path / "none" / "home.toml")


def test_a_disk_that_fails_later_costs_no_mission_and_no_file(
    program: Callable[..., Outcome],
    state: Path,
    monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
) -> None:
    program("Find the mug")
    before, calls = state.read_text(), []

    def full(file: Path, new: HomeState) -> None:
        calls.append(new)
        if len(calls) > 1:
            raise OSError(28, "No space left on device")

    monkeypatch.setattr("executive.app.living.write_state", full)
    with caplog.at_level(logging.WARNING):
        assert program("Bring the mug").status == "done"
    assert "could not be kept: No space left on device" in caplog.text
    assert state.read_text() == before


def test_a_file_is_written_whole_or_not_at_all(
    state: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_state(state, HomeState(home="four_rooms", time_s=1.0))
    monkeypatch.setattr("os.fsync", lambda _: (_ for _ in ()).throw(OSError(28, "full")))
    with pytest.raises(OSError, match="full"):
        write_state(state, HomeState(home="four_rooms", time_s=2.0))
    assert [file.name for file in state.parent.iterdir()] == ["home.toml"]
    kept = read_state(state, four_rooms())
    assert kept
    assert kept.time_s == 1.0


def test_the_recording_replays_without_the_file(
    program: Callable[..., Outcome], state: Path
) -> None:
    program("Bring the mug")
    outcome = program("Find the mug")
    state.unlink()
    assert replay(Path(str(outcome.run_dir))).parting is None
    assert not state.exists()


def test_a_spot_is_where_the_thing_stood() -> None:
    home = four_rooms()
    piece = home.furniture_named("sideboard")
    pose = home.object_pose("adjustable_wrench")
    spot = spot_on(piece, pose.position, piece.pose[2] + 0.3)
    there = home.as_left({"adjustable_wrench": spot}).arrangement()["adjustable_wrench"]
    here = home.arrangement()["adjustable_wrench"]
    assert (there.x, there.y, there.z) == pytest.approx((here.x, here.y, here.z))
    assert there.yaw == pytest.approx(0.3)


def test_what_has_no_room_is_put_where_there_is_some() -> None:
    full = four_rooms().as_left({n: Spot(furniture="delivery") for n in four_rooms().objects})
    placement = with_room(full).placement
    assert list(placement.values()).count("delivery") > 1
    assert len(set(placement.values())) > 1


def test_things_wander_between_commands_by_the_hours_that_pass(state: Path, tmp_path: Path) -> None:
    daily = tmp_path / "habits.toml"
    daily.write_text('[[habits]]\nthings = "mug"\nto = "sideboard"\nhours = [12.0, 12.1]\n')
    noon_s = 12 * 3600.0 + 200_000 * 86400.0
    write_state(state, HomeState(home="four_rooms", time_s=noon_s - 2 * 3600))
    given = {"world": "fake", "llm": "none", "user": "oracle", "home_state": state}
    settings = load_settings(**given, habits=str(daily), hours_between=1.5)
    found = []
    with Session(settings, out=io.StringIO(), recorded=False) as session:
        found += [session.run("Find the mug").location for _ in range(2)]
    assert found == ["coffee_table", "sideboard"]
    assert tomllib.loads(state.read_text())["objects"]["mug"] == "sideboard"


def test_habits_in_a_world_that_is_not_ours_are_refused() -> None:
    settings = load_settings(home_state="x", habits="household")
    living = LivingHome(settings, four_rooms())
    nobody: Any = None
    with pytest.raises(InputError, match="'home_state': .*use --world physics or fake"):
        living.move_in(Embodiment(nobody, nobody, nobody))
