"""A mission's rerun recording, read with rerun's own reader."""

import atexit
import os
import resource
import signal
import sys
import threading
from collections import Counter
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
import rerun as rr
from rerun.chunk import RrdReader
from sample_mission import detection, frame, mission, robot_at, scene, tick

from executive.errors import ExecutiveError
from executive.records import Picture, Record, Scene, Seen, Shape
from executive.types.perception import Box
from logs.recorder import Stamp
from logs.viewer import program
from logs.viewer import sink as module
from logs.viewer.display import DISPLAYS
from logs.viewer.sink import RerunSink


@pytest.fixture(autouse=True)
def _strict() -> None:
    rr.set_strict_mode(True)


def write(path: Path, *records: tuple[float, Record]) -> Path:
    sink = RerunSink(path)
    for time, record in records:
        sink.write(Stamp(time, 0), record)
    sink.flush()
    sink.close()
    return path


def rows(path: Path) -> Counter[str]:
    """How many rows each entity has."""
    counted: Counter[str] = Counter()
    for chunk in RrdReader(path).stream():
        counted[str(chunk.entity_path)] += chunk.to_record_batch().num_rows
    return counted


def texts(path: Path, entity: str) -> list[str]:
    """All texts logged to an entity."""
    found: list[str] = []
    for chunk in RrdReader(path).stream():
        if str(chunk.entity_path) == entity:
            batch = chunk.to_record_batch()
            (column,) = (name for name in batch.schema.names if name.endswith(":text"))
            found += [row[0] for row in batch.column(column).to_pylist() if row]
    return found


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write(tmp_path_factory.mktemp("run") / "mission.rrd", *mission())


def test_a_mission_fills_every_view(recording: Path) -> None:
    logged = rows(recording)
    for entity in (
        "/scene/home/box",
        "/scene/robot/cylinder",
        "/scene/robot/sphere",
        "/frames",
        "/plan",
        "/camera",
        "/camera/detections",
        "/behaviour_tree/branch",
        "/behaviour_tree/whole",
        "/mission/0_doing",
        "/belief",
        "/llm",
        "/dialog",
        "/log",
    ):
        assert logged[entity], entity


def test_the_recording_is_on_mission_time_wall_time_and_tick(recording: Path) -> None:
    names = {
        name
        for chunk in RrdReader(recording).stream()
        if str(chunk.entity_path) == "/belief"
        for name in chunk.to_record_batch().schema.names
    }
    assert {"mission_time", "wall_time", "tick"} <= names


def test_a_call_reads_as_asked_answered_accepted_and_dropped(recording: Path) -> None:
    document = texts(recording, "/llm")[2]
    parts = (
        "**Asked** I am searching for sugar_box",
        '**Answered** {"places": ["cupboard", "spice rack"]}',
        "**✓ In this home** cupboard",
        "**✗ Dropped, not in this home** spice rack",
        "You help a robot",
    )
    places = [document.index(part) for part in parts]
    assert places == sorted(places)


def test_a_ranking_reads_from_the_likeliest_place_down(recording: Path) -> None:
    document = texts(recording, "/llm")[0]
    places = [document.index(place) for place in ("| cupboard", "| dining_table", "| desk")]
    assert places == sorted(places)


def test_the_belief_shows_each_candidate_with_its_probability_and_what_became_of_it(
    recording: Path,
) -> None:
    first, on_the_way, *_, end = texts(recording, "/belief")
    assert "No place is known yet" in first
    assert "| ▶ | cupboard | ●●●●●● 60% | llm |" in on_the_way
    assert "| ✓ | cupboard |" in end


def test_a_tree_that_did_not_change_is_not_drawn_again(tmp_path: Path) -> None:
    tree, *_ = (record for _, record in mission())
    same = ["RUNNING", "RUNNING", "RUNNING", "INVALID", "INVALID"]
    ticks = [tick(number, "mission/which places/ask", *same) for number in range(5)]
    path = write(tmp_path / "a.rrd", (0.0, tree), *((1.0, t) for t in ticks))
    assert rows(path)["/behaviour_tree/branch"] == 1


def test_of_a_tree_that_only_changed_its_statuses_only_the_colours_are_drawn_again(
    tmp_path: Path,
) -> None:
    tree, *_ = (record for _, record in mission())
    statuses = (["RUNNING"] * 3 + ["INVALID"] * 2, ["RUNNING"] * 5)
    ticks = [tick(n, "mission/which places/ask", *each) for n, each in enumerate(statuses)]
    path = write(tmp_path / "a.rrd", (0.0, tree), *((1.0, t) for t in ticks))
    drawn = [
        {name for name in chunk.to_record_batch().schema.names if name.startswith("Graph")}
        for chunk in RrdReader(path).stream()
        if str(chunk.entity_path) == "/behaviour_tree/whole"
    ]
    again, first = sorted(drawn, key=len)
    assert again == {"GraphNodes:colors"} < first


def test_pictures_keep_their_times_though_they_are_sent_together(tmp_path: Path) -> None:
    taken = ((time, Picture(frame(number))) for number, time in enumerate((0.1, 1.2345, 2.0)))
    times = [
        time.total_seconds()
        for chunk in RrdReader(write(tmp_path / "a.rrd", *taken)).stream()
        if "EncodedImage:blob" in chunk.to_record_batch().schema.names
        for time in chunk.to_record_batch().column("mission_time").to_pylist()
    ]
    assert sorted(times) == [0.1, 1.234, 2.0]


def test_all_pictures_have_one_size_and_boxes_are_where_the_things_are(tmp_path: Path) -> None:
    glance = frame(1)
    small = replace(glance, color=glance.color[::2, ::2], intrinsics=glance.intrinsics.scaled(0.5))
    path = write(
        tmp_path / "a.rrd",
        *((0.0, Picture(frame())), (1.0, Picture(small))),
        (1.1, Seen(1, (replace(detection(), box=Box(35, 25, 15, 15)),))),
    )
    sizes, boxes = set(), []
    for chunk in RrdReader(path).stream():
        batch = chunk.to_record_batch()
        for name in batch.schema.names:
            if name == "EncodedImage:blob":
                for (blob,) in batch.column(name).to_pylist():
                    sizes.add(cv2.imdecode(np.asarray(blob, np.uint8), cv2.IMREAD_COLOR).shape)
            elif name in ("Boxes2D:centers", "Boxes2D:half_sizes"):
                boxes += [row[0] for row in batch.column(name).to_pylist() if row]
    assert sizes == {(480, 640, 3)}
    assert sorted(boxes) == [[60.0, 60.0], [340.0, 260.0]]


def test_every_behaviour_has_a_lane_from_when_it_first_does_something(recording: Path) -> None:
    logged = rows(recording)
    assert logged["/behaviours/2_ask"] == 1 + 2  # its colours, running, success
    assert logged["/behaviours/3_drive"] == 1 + 2
    early = [record for time, record in mission() if time < 2]
    half = write(recording.parent / "half.rrd", *((0.0, record) for record in early))
    assert "/behaviours/3_drive" not in rows(half)


def test_what_is_declared_a_stage_has_a_lane_among_the_parts_of_the_mission(
    recording: Path,
) -> None:
    lanes = {path for path in rows(recording) if path.startswith("/mission/")}
    assert lanes == {"/mission/0_doing", "/mission/0_place", "/mission/1_drive"}


def test_the_scene_is_logged_once_and_only_frames_move(tmp_path: Path) -> None:
    moves = [(float(t), robot_at(float(t))) for t in range(10)]
    logged = rows(write(tmp_path / "a.rrd", (0.0, scene()), *moves))
    assert logged["/scene/home/box"] == 1
    assert logged["/frames"] == 10


def test_what_was_seen_in_the_last_picture_is_gone_with_the_next(tmp_path: Path) -> None:
    seen = Seen(0, ())
    path = write(tmp_path / "a.rrd", (0.0, Picture(frame())), (0.1, seen), (1.0, Picture(frame(1))))
    assert rows(path)["/camera/detections"] == 1 + 1 + 1  # its frame, what was seen, its end


def test_a_shape_of_unknown_kind_is_refused(tmp_path: Path) -> None:
    entity = scene().entities[0]
    odd = type(entity)("odd", "map", (Shape("torus", (1, 1, 1), (0, 0, 0, 1)),))
    sink = RerunSink(tmp_path / "a.rrd")
    with pytest.raises(ValueError, match="torus"):
        sink.write(Stamp(0.0, 0), Scene((odd,)))
    sink.close()


def test_a_viewer_that_cannot_start_is_said_in_a_sentence(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(program, "COMMAND", ["false"])
    with pytest.raises(ExecutiveError, match="does not start"):
        RerunSink(tmp_path / "a.rrd", view=True)
    with pytest.raises(ExecutiveError, match="does not start"):
        program.show(tmp_path / "a.rrd")


def test_a_file_that_rerun_never_opens_is_not_waited_for(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    released = threading.Event()
    monkeypatch.setattr(module, "FLUSH_S", 0.01)
    monkeypatch.setattr(rr.RecordingStream, "set_sinks", lambda *_, **__: released.wait())
    monkeypatch.setattr(atexit, "unregister", lambda _: None)
    with pytest.raises(OSError, match="rerun does not open its file within 0.01 s"):
        RerunSink(tmp_path / "a.rrd")
    released.set()


def test_a_file_that_the_disk_has_no_room_to_finish_is_an_error(tmp_path: Path) -> None:
    sink = RerunSink(tmp_path / "a.rrd")
    sink.flush()
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    room = (tmp_path / "a.rrd").stat().st_size
    resource.setrlimit(resource.RLIMIT_FSIZE, (room, before[1]))
    try:
        with pytest.raises(OSError, match="has not finished its file"):
            sink.close()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere no variable names a display")
def test_where_no_display_is_the_viewer_is_not_started(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(program, "COMMAND", ["true"])
    for name in DISPLAYS:
        monkeypatch.delenv(name, raising=False)
    with pytest.raises(ExecutiveError, match="it needs a display"):
        program.show(tmp_path / "a.rrd")
    program.show(tmp_path / "a.rrd", web=True)


@pytest.mark.viewer
def test_closing_the_live_viewer_does_not_end_the_file(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    live = program.start("--headless")
    monkeypatch.setattr(program, "start", lambda: live)
    sink = RerunSink(tmp_path / "a.rrd", view=True)
    try:
        sink.write(Stamp(0.0, 0), scene())
        sink.flush()
    finally:
        os.killpg(live.process.pid, signal.SIGKILL)
        live.process.wait()
    for time, record in mission():
        sink.write(Stamp(time, 0), record)
        sink.flush()
    sink.close()
    assert rows(tmp_path / "a.rrd")["/dialog"] == 2
