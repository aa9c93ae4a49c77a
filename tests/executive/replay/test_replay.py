"""A recorded mission, fed to a fresh tree, is the same mission."""

import io
import json
from pathlib import Path

import pytest
import tomli_w
from mcap.reader import make_reader
from outcome_cases import CASES, Case, favouring
from py_trees.common import Status as NodeStatus
from replays import recorded
from sample_mission import STARTED, mission

import executive.replay.recorded
from executive.app.session import Session
from executive.config import KnowledgeSystem, Settings
from executive.errors import InputError
from executive.events import Inbox, StopRequested
from executive.replay import replay, replay_text, replays_text
from executive.types.commands import CommandKind
from executive.types.goals import DriveTo, Goal, LookAt, Pick, PutDown
from executive.types.outcome import MissionStatus
from executive.user import Console
from kb.ontology import ontology
from logs.__main__ import main
from logs.recorder import Stamp
from logs.recording.sink import McapSink
from trees.by_plan import search
from trees.looking import SeeTarget
from trees.tree import MissionTree


@pytest.mark.parametrize("case", CASES, ids=[case.says for case in CASES])
def test_every_branch_replays_tick_for_tick(tmp_path: Path, case: Case) -> None:
    again = replay(recorded(tmp_path, case.words, **case.given))
    assert again.parting is None
    assert again.notes == ()
    assert again.ticks > 0


@pytest.mark.parametrize("kind", list(CommandKind))
@pytest.mark.parametrize("defaults", [True, False])
@pytest.mark.parametrize(("llm", "remembers"), [(False, False), (True, False), (True, True)])
def test_all_systems_situations_and_kinds_replay(
    tmp_path: Path, kind: CommandKind, defaults: bool, llm: bool, remembers: bool
) -> None:
    among = {"among": ("cabinet_kitchen", "counter_wagon", "high_table")} if defaults else {}
    run = recorded(
        tmp_path,
        f"{kind} a sugar_box",
        llm=llm,
        remembers=remembers,
        defaults=defaults,
        elicit="rank",
        replies=[favouring("high_table", "counter_wagon", **among)],
    )
    assert replay(run).parting is None


@pytest.mark.parametrize("failing", [DriveTo, LookAt, Pick, PutDown])
@pytest.mark.parametrize("always", [True, False], ids=["always", "once"])
def test_failures_of_the_robot_replay(tmp_path: Path, failing: type, always: bool) -> None:
    failed: list[Goal] = []

    def fault(goal: Goal) -> str | None:
        if not isinstance(goal, failing) or (failed and not always):
            return None
        failed.append(goal)
        return "the way is blocked"

    run = recorded(tmp_path, "Bring a power_drill", llm=False, fault=fault)
    assert failed
    assert replay(run).parting is None


def test_a_stopped_mission_replays(tmp_path: Path) -> None:
    def stop(goal: Goal, inbox: Inbox) -> None:
        if isinstance(goal, Pick):
            inbox.post(StopRequested("the person"))

    run = recorded(tmp_path, "Take a power_drill", llm=False, during=stop)
    assert json.loads((run / "outcome.json").read_text())["status"] == MissionStatus.STOPPED
    again = replay(run)
    assert (again.parting, again.notes) == (None, ())


def test_waiting_in_vain_replays_to_the_last_digit(tmp_path: Path) -> None:
    run = recorded(
        tmp_path,
        "Find an apple",
        defaults=False,
        replies=[None],
        answers=[None],
        elicit="rank",
        llm_timeout_s=0.1 + 0.2,
        answer_timeout_s=0.7,
    )
    assert replay(run).parting is None


def test_the_second_mission_of_a_session_replays(tmp_path: Path) -> None:
    settings = Settings(world="fake", runs=tmp_path, knowledge=KnowledgeSystem.OKB)
    inbox = Inbox()
    typed = io.StringIO("Find a power_drill\nTake a hammer\n")
    console = Console(inbox, typed, io.StringIO())
    with Session(settings, inbox=inbox, user=console) as session:
        while (words := session.next_command(console)) is not None:
            session.run(words)
    first, second = sorted(tmp_path.iterdir(), key=lambda run: "take" in run.name)
    assert replay(first).parting is None
    assert replay(second).parting is None


def test_a_mission_that_was_cut_anywhere_replays_as_far_as_it_goes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("logs.recording.sink.CHUNK_BYTES", 1)
    run = recorded(tmp_path, "Find a power_drill", llm=False)
    file, ticks = run / "mission.mcap", replay(run).ticks
    data = file.read_bytes()
    with file.open("rb") as whole:
        summary = make_reader(whole).get_summary()
    assert summary is not None
    counts = []
    for chunk in summary.chunk_indexes[1:]:
        file.write_bytes(data[: chunk.chunk_start_offset])
        again = replay(run)
        assert again.parting is None
        assert again.notes == ("the recording ends early",)
        counts.append(again.ticks)
    assert counts == sorted(counts)
    assert (counts[0], counts[-1]) == (0, ticks)


# --- what has changed ---


def test_a_changed_behaviour_parts_at_the_tick_where_it_decides_otherwise(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    run = recorded(tmp_path, "Find a power_drill", llm=False)
    monkeypatch.setattr(SeeTarget, "ended", lambda self, result: NodeStatus.FAILURE)
    again = replay(run)
    assert again.parting is not None
    assert (again.ticks, again.parting.tick) == (3, 3)
    see = next(aspect for aspect in again.parting.aspects if aspect.what.endswith("/see"))
    assert see.one == "SUCCESS power_drill, confidence 1.00"
    assert main(["replay", str(run)]) == 1
    assert "3 ticks as recorded; parts at tick 3, 7.001 s" in capsys.readouterr().out


def test_a_tree_of_another_shape_is_told_by_its_behaviours(tmp_path: Path) -> None:
    run = recorded(tmp_path, "Find a power_drill", llm=False)
    again = replay(run, lambda context: MissionTree(search(context)))
    assert "behaviour gone since: mission" in again.notes
    assert "behaviour new since: search" in again.notes


def test_a_tree_that_ends_early_parts_where_the_recording_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = recorded(tmp_path, "Find a power_drill", llm=False)
    monkeypatch.setattr(SeeTarget, "update", lambda self: 1 / 0)
    again = replay(run)
    assert again.parting is not None
    assert (again.parting.tick, again.parting.aspects[0].other) == (2, "has ended")


def test_a_mission_replays_with_the_ontology_of_its_day(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = recorded(tmp_path, "Find a power_drill", llm=False)
    today = tmp_path / "defaults.owl"
    today.write_bytes(ontology.DEFAULTS.read_bytes().replace(b"shelf_lobby", b"desk"))
    monkeypatch.setattr(ontology, "DEFAULTS", today)
    executive.replay.recorded._ontology.cache_clear()
    assert replay(run).parting is None


def test_a_recording_without_its_home_is_refused(tmp_path: Path) -> None:
    sink = McapSink(tmp_path / "mission.mcap", STARTED, {}, {})
    for time, record in mission():
        sink.write(Stamp(time, 0), record)
    sink.close()
    with pytest.raises(InputError, match="keeps no 'requests_before'"):
        replay(tmp_path)


def test_a_configuration_that_this_version_does_not_know_is_refused(tmp_path: Path) -> None:
    run = recorded(tmp_path, "Find a power_drill", llm=False)
    file = run / "mission.mcap"
    file.write_bytes(file.read_bytes().replace(b"camera_hz", b"camera_xx"))
    with pytest.raises(InputError, match="config.toml"):
        replay(run)


def test_recordings_replay_from_the_command_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    recorded(tmp_path, "Find a power_drill", llm=False)
    assert main(["replay", str(tmp_path)]) == 0
    assert "ticks as recorded" in capsys.readouterr().out
    assert main(["replay", str(tmp_path), "--json"]) == 0
    (answer,) = json.loads(capsys.readouterr().out)
    assert answer["parting"] is None


def test_without_a_name_the_newest_recording_is_replayed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    for words in ("Find an apple", "Find a power_drill"):
        last = recorded(tmp_path / "runs", words, llm=False)
    assert main(["replay"]) == 0
    told = capsys.readouterr()
    assert told.out.startswith(f"{last.name}: ")
    assert told.err == f"runs/{last.name}: the newest of 2\n"


def test_a_stop_before_anything_began_is_told_without_a_speed(tmp_path: Path) -> None:
    at_once = replay(recorded(tmp_path / "one", "stop it", llm=False))
    assert replay_text(at_once).endswith(": 0 ticks as recorded")
    assert replays_text([at_once]) == "1 of 1 mission as recorded"
    short = replay(recorded(tmp_path / "three", "Dance", llm=False))
    assert replay_text(short).endswith(": 1 tick as recorded")
    long = replay(recorded(tmp_path / "two", "Find a power_drill", llm=False))
    fast = f"{long.speed:.0f} times"
    assert replays_text([at_once, long]).endswith(f"the slowest {fast})")


def test_one_recording_of_many_that_cannot_be_read_keeps_no_other_from_being_replayed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for _ in range(2):
        recorded(tmp_path, "Find a power_drill", llm=False)
    broken = tmp_path / "broken" / "mission.mcap"
    broken.parent.mkdir()
    broken.write_bytes(b"no mcap at all")
    assert main(["replay", str(tmp_path)]) == 1
    said = capsys.readouterr().out
    assert "broken: " in said
    assert "2 of 2 missions as recorded" in said


@pytest.mark.parametrize("question_s", [0.0, 60.0])
def test_a_search_by_plan_replays(tmp_path: Path, question_s: float) -> None:
    run = recorded(
        tmp_path,
        "Bring the mug",
        llm=False,
        remembers=False,
        search="plan",
        question_s=question_s,
        place={"mug": "sofa"},
    )
    again = replay(run)
    assert (again.parting, again.notes) == (None, ())


def test_a_recording_that_does_not_say_how_it_was_searched_was_searched_by_stages(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As all were of earlier days."""
    leave_out = {"search", "question_s"}
    monkeypatch.setattr(
        Settings,
        "to_toml",
        lambda self: tomli_w.dumps(
            self.model_dump(mode="json", exclude_none=True, exclude=leave_out)
        ),
    )
    run = recorded(tmp_path, "Find the mug", llm=False, remembers=False, place={"mug": "sofa"})
    again = replay(run)
    assert (again.parting, again.notes) == (None, ())
