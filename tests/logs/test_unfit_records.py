"""A record that does not fit costs that record, and a full disk the log: never the mission."""

import logging
import subprocess
import sys
import threading
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from patience import PATIENCE_S
from rerun.chunk import RrdReader
from sample_mission import STARTED, TREE, chat_call, frame, outcome, tick

from executive.events import Ended
from executive.records import (
    Entity,
    EventTaken,
    Finished,
    LlmCall,
    Note,
    Picture,
    Record,
    Scene,
    Shape,
    Transform,
    Transforms,
    Utterance,
)
from executive.types.geometry import Pose
from executive.types.results import Answered
from logs.recorder import FanOut
from logs.recording.channels import MOST_IN_A_MESSAGE
from logs.recording.reader import Run
from logs.recording.recovery import recover
from logs.recording.sink import McapSink
from logs.viewer.sink import RerunSink

LATE = "and on it goes"


def call(**changed: Any) -> LlmCall:
    result = chat_call().result
    return LlmCall(replace(result, usage=replace(result.usage, **changed)))


def anything(value: object) -> Any:
    """A value of a type that no type checker would let pass, as a server may send it."""
    return value


UNFIT: dict[str, Record] = {
    "half a character": Utterance("person", "\ud83d"),
    "a level that is none": Note("shouting", "hello"),
    "a number that is a text": call(output_tokens=anything("twelve")),
    "a time that is a text": call(total_s=anything("long")),
    "a parameter beyond 64 bits": call(parameters={"seed": 2**70}),
    "an answer that is a number": EventTaken(Ended(1, Answered(anything(5)))),
    "a request beyond 64 bits": EventTaken(Ended(2**70, Answered("yes"))),
    "a time that is no number": call(total_s=float("nan")),
    "a model that was asked nothing": LlmCall(
        replace(chat_call().result, request=replace(chat_call().result.request, messages=()))
    ),
    "an event that is none": EventTaken(anything("a text")),
    "an end at no time": Finished(replace(outcome(), mission_time_s=float("inf"))),
    "a status that is none": Finished(replace(outcome(), inquiries=-1)),
    "a picture without pixels": Picture(replace(frame(), color=np.zeros((0, 0, 3), np.uint8))),
    "a mesh that is gone": Scene((Entity("x", "map", (Shape("mesh", (1, 1, 1), (1, 1, 1, 1)),)),)),
    "a tick of megabytes": replace(
        tick(0, "mission", *["RUNNING"] * 5), situation={"object": "x" * MOST_IN_A_MESSAGE}
    ),
    "a frame that is nowhere": Transforms(
        (Transform("map", "x", Pose(anything(("a", "b", "c")))),)
    ),
}


def logged(folder: Path, *records: Record) -> Run:
    fan_out = FanOut(lambda: 1.0)
    fan_out.open([McapSink(folder / "mission.mcap", STARTED, {}, {})], STARTED)
    for entry in (TREE, *records, Utterance("robot", LATE)):
        fan_out.record(entry)
    fan_out.close()
    return Run(folder)


@pytest.mark.parametrize("unfit", UNFIT.values(), ids=UNFIT)
def test_the_mcap_goes_on_and_the_loss_is_told(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, unfit: Record
) -> None:
    with caplog.at_level(logging.WARNING):
        run = logged(tmp_path, unfit, unfit)
    assert run.whole
    assert [at.value.text for at in run.dialog()][-1] == LATE
    kind = type(unfit).__name__
    assert [r.message for r in caplog.records if f"of kind {kind} could not" in r.message]
    assert len(caplog.records) == 1


def test_tokens_that_are_no_whole_number_are_counted_down(tmp_path: Path) -> None:
    (at,) = logged(tmp_path, call(output_tokens=2.5, input_tokens=float("nan"))).llm_calls()
    assert (at.value.result.usage.output_tokens, at.value.result.usage.input_tokens) == (2, 0)


@pytest.mark.parametrize("unfit", UNFIT.values(), ids=UNFIT)
@pytest.mark.filterwarnings("ignore::rerun.error_utils.RerunWarning")
def test_the_rerun_recording_goes_on(tmp_path: Path, unfit: Record) -> None:
    fan_out = FanOut(lambda: 1.0)
    file = tmp_path / "run" / "mission.rrd"
    file.parent.mkdir()
    fan_out.open([RerunSink(file)], STARTED)
    for entry in (TREE, unfit, Utterance("robot", LATE)):
        fan_out.record(entry)
    fan_out.close()
    paths = {str(chunk.entity_path) for chunk in RrdReader(file).stream()}
    assert "/dialog" in paths


def test_records_from_any_thread_at_any_time_break_nothing(tmp_path: Path) -> None:
    fan_out = FanOut(lambda: 1.0)
    over = threading.Event()

    def talk() -> None:
        while not over.is_set():
            fan_out.record(Note("info", "hello"))

    threads = [threading.Thread(target=talk) for _ in range(3)]
    for thread in threads:
        thread.start()
    for number in range(3):
        folder = tmp_path / str(number)
        folder.mkdir()
        fan_out.open([McapSink(folder / "mission.mcap", STARTED, {}, {})], STARTED)
        fan_out.record(TREE)
        fan_out.close()
    over.set()
    for thread in threads:
        thread.join()
    assert all(Run(tmp_path / str(number)).whole for number in range(3))


FULL_DISK = """
import io, resource, sys
from pathlib import Path
from executive.app.session import Session
from executive.config import Settings
resource.setrlimit(resource.RLIMIT_FSIZE, (75_000, 75_000))
settings = Settings(world="fake", knowledge="okb", user="oracle", runs=Path(sys.argv[1]))
session = Session(settings, out=io.StringIO())
print(session.run("Bring a hammer").status)
session.close()
"""


def test_a_mission_on_a_full_disk_goes_on_and_its_log_is_recovered_up_to_there(
    tmp_path: Path,
) -> None:
    mission = subprocess.run(
        [sys.executable, "-c", FULL_DISK, str(tmp_path / "runs")],
        capture_output=True,
        text=True,
        check=False,
        timeout=PATIENCE_S,
    )
    assert mission.stdout == "done\n", mission.stderr
    assert "McapSink" in mission.stderr
    (file,) = tmp_path.glob("runs/*/mission.mcap")
    assert file.stat().st_size <= 75_000
    assert Run(recover(file)).whole
