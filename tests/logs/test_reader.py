"""Runs are read back as they were recorded, also when they end early."""

import json
import signal
import subprocess
import sys
from pathlib import Path

import pytest
import sample_mission
from mcap.reader import make_reader
from mcap.writer import Writer
from rerun.chunk import RrdReader
from rerun.error_utils import RerunWarning
from sample_mission import (
    STARTED,
    TREE,
    chat_call,
    mission,
    outcome,
    rank_call,
)

from executive.errors import InputError
from executive.events import Ended, Started
from executive.records import Tick, Utterance
from executive.types.results import Succeeded
from logs.__main__ import main
from logs.questions import report
from logs.recorder import Stamp
from logs.recording.reader import Run
from logs.recording.recovery import recover
from logs.recording.sink import McapSink

WRITE_UNTIL_KILLED = """
import itertools, sys, time
from pathlib import Path
from rerun.chunk import RrdReader
from sample_mission import STARTED, TREE, tick
from executive.errors import InputError
from logs import recorder
from logs.recording.reader import Run
from logs.recording.sink import McapSink
from logs.viewer.sink import RerunSink

def ticks_on_the_disk():
    try:
        return sum(1 for _ in Run(path).ticks())
    except InputError:
        return 0

def beliefs_on_the_disk():
    try:
        chunks = RrdReader(path.with_suffix(".rrd")).stream()
        return sum(c.to_record_batch().num_rows for c in chunks if c.entity_path == "/belief")
    except (OSError, RuntimeError, ValueError):
        return 0

recorder.FLUSH_S = 0.05
path = Path(sys.argv[1])
sinks = [McapSink(path, STARTED, {"a.toml": b"x = 1"}, {"seed": "7"})]
sinks.append(RerunSink(path.with_suffix(".rrd")))
number = 0
fan_out = recorder.FanOut(lambda: number / 100)
fan_out.open(sinks, STARTED)
fan_out.record(TREE)
for number in itertools.count():
    fan_out.record(tick(number, "mission/drive", *["RUNNING"] * len(TREE.nodes)))
    if number == 200:
        while min(ticks_on_the_disk(), beliefs_on_the_disk()) <= 200:
            time.sleep(0.05)
        print("ready", flush=True)
"""


@pytest.fixture
def run_dir(tmp_path: Path) -> Path:
    sink = McapSink(tmp_path / "mission.mcap", STARTED, {}, {"seed": "7"})
    for time, record in mission():
        sink.write(Stamp(time, 0), record)
    sink.close()
    return tmp_path


@pytest.fixture(scope="module")
def killed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("killed") / "mission.mcap"
    writer = subprocess.Popen(
        [sys.executable, "-c", WRITE_UNTIL_KILLED, str(path)],
        stdout=subprocess.PIPE,
        cwd=Path(sample_mission.__file__).parent,
    )
    assert writer.stdout is not None
    with writer.stdout as ready:
        ready.readline()
        writer.send_signal(signal.SIGKILL)
        writer.wait()
    return path


def test_what_is_read_equals_what_was_recorded(run_dir: Path) -> None:
    run, records = Run(run_dir), list(mission())
    assert run.tree() == TREE
    assert [(at.time_s, at.value) for at in run.ticks()] == [
        (time, record) for time, record in records if isinstance(record, Tick)
    ]
    assert [at.value for at in run.llm_calls()] == [rank_call(), chat_call()]
    assert [at.value for at in run.dialog()] == [r for _, r in records if isinstance(r, Utterance)]
    assert run.outcome() == outcome()
    assert run.metadata["seed"] == "7"


def test_events_are_read_as_they_were_taken(run_dir: Path) -> None:
    started, ended = (at.value for at in Run(run_dir).events())
    assert started == Started("Bring a sugar_box")
    assert isinstance(ended, Ended)
    assert (ended.request, ended.result) == (3, Succeeded())


def test_frames_are_jpegs(run_dir: Path) -> None:
    (frame,) = Run(run_dir).frames()
    assert frame.time_s == 6.0
    assert frame.value.startswith(b"\xff\xd8")


def test_a_killed_run_reads_up_to_its_end(killed: Path) -> None:
    run = Run(killed.parent)
    assert not run.whole
    numbers = [at.value.number for at in run.ticks()]
    assert numbers == list(range(len(numbers)))
    assert len(numbers) > 200
    assert run.outcome() is None


def test_a_killed_run_recovers_to_a_whole_file_with_the_same_content(killed: Path) -> None:
    recovered = recover(killed)
    whole = Run(recovered)
    assert whole.whole
    assert list(whole.ticks()) == list(Run(killed).ticks())
    with recovered.open("rb") as file:
        assert [a.name for a in make_reader(file).iter_attachments()] == ["a.toml"]


def test_a_killed_runs_rrd_streams_too(killed: Path) -> None:
    with pytest.warns(RerunWarning, match="no footer"):
        chunks = RrdReader(killed.with_suffix(".rrd")).stream()
    assert sum(c.to_record_batch().num_rows for c in chunks if c.entity_path == "/belief") > 200


@pytest.mark.parametrize("kept", [0.3, 0.6, 0.9])
def test_a_file_cut_anywhere_still_reads(run_dir: Path, kept: float) -> None:
    path = run_dir / "mission.mcap"
    data = path.read_bytes()
    path.write_bytes(data[: int(len(data) * kept)])
    assert len(list(Run(run_dir).llm_calls())) <= 2


def test_the_timeline_says_when_each_leaf_was_at_work(run_dir: Path) -> None:
    spans = [(s.path, s.start_s, s.end_s, s.status) for s in report.timeline(Run(run_dir))]
    assert spans == [
        ("mission/which places/ask", 0.0, 2.0, "SUCCESS"),
        ("mission/drive", 2.0, 6.0, "SUCCESS"),
        ("mission/see", 6.0, 6.0, "SUCCESS"),
    ]


def test_each_verification_belongs_to_the_call_before_it(run_dir: Path) -> None:
    rank, chat = report.llm(Run(run_dir))
    assert chat["verified"]["dropped"] == ("spice rack",)
    assert "verified" not in rank
    assert rank["scores"]["desk"] == 0.7


@pytest.mark.parametrize(
    ("question", "answer"),
    [
        ("summary", "'Bring a sugar_box' done in cupboard (says llm)"),
        ("timeline", "2.000     6.000  SUCCESS  mission/drive"),
        ("llm", "dropped   spice rack"),
        ("dialog", "6.500  robot   Here is the sugar_box."),
    ],
)
def test_questions_are_answered_as_text_and_as_json(
    run_dir: Path, capsys: pytest.CaptureFixture[str], question: str, answer: str
) -> None:
    assert main([question, str(run_dir)]) == 0
    assert answer in capsys.readouterr().out
    assert main([question, str(run_dir), "--json"]) == 0
    assert isinstance(json.loads(capsys.readouterr().out), list)


def test_frames_are_written_as_files(run_dir: Path, tmp_path: Path) -> None:
    assert main(["frames", str(run_dir), "--out", str(tmp_path / "pictures")]) == 0
    (picture,) = (tmp_path / "pictures").iterdir()
    assert picture.name == "00001-6.000s.jpg"


def test_a_broken_file_is_recovered_from_the_command_line(
    killed: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["recover", str(killed)]) == 0
    assert "mission.recovered.mcap" in capsys.readouterr().out
    assert main(["summary", str(killed)]) == 0
    assert "no outcome (the recording ends early)" in capsys.readouterr().out


@pytest.mark.parametrize("question", ["summary", "timeline", "llm", "dialog", "view", "recover"])
def test_a_wrong_folder_is_said_in_a_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], question: str
) -> None:
    assert main([question, str(tmp_path / "nowhere")]) == 2
    assert "nowhere: " in capsys.readouterr().err


def test_a_folder_without_a_recording_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"holds no mission\.mcap"):
        Run(tmp_path)


def test_a_file_that_is_no_mcap_is_refused(tmp_path: Path) -> None:
    (tmp_path / "mission.mcap").write_bytes(b"hello, hello, hello")
    with pytest.raises(InputError, match="is not an mcap file: .*; name a run's folder"):
        Run(tmp_path)


def test_an_mcap_of_something_else_is_refused_and_told_what_it_lacks(tmp_path: Path) -> None:
    with (tmp_path / "mission.mcap").open("wb") as file:
        writer = Writer(file)
        writer.start()
        writer.add_message(writer.register_channel("/odom", "json", 0), 0, b"{}", 0)
        writer.finish()
    with pytest.raises(InputError, match="topic /bt/tree is missing"):
        Run(tmp_path)
