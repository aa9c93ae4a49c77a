"""Questions to recorded missions: why, tick by tick, side by side, in pictures."""

import json
import shutil
import sys
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import cv2
import numpy as np
import pyarrow.parquet as pq
import pytest
from mcap.reader import make_reader
from sample_mission import STARTED, TREE, chat_call, frame, mission, rank_call, tick

from executive.records import NodeShape, NodeState, Picture, Record, Tick, TreeShape, Verified
from logs.__main__ import main
from logs.questions import report
from logs.questions.comparison import compare
from logs.questions.decision import Alternative, why_text
from logs.questions.difference import Aspect, aspects_text, parting
from logs.questions.pictures import write_video
from logs.questions.why import denied, why
from logs.recorder import Stamp
from logs.recording.reader import At, Run
from logs.recording.recovery import first_damage, recover
from logs.recording.sink import McapSink
from logs.viewer import program


def record(folder: Path, records: Iterable[tuple[float, Record]], config: str = "") -> Path:
    """A run's folder with these records."""
    folder.mkdir(parents=True, exist_ok=True)
    sink = McapSink(folder / "mission.mcap", STARTED, {"config.toml": config.encode()}, {})
    for time, entry in records:
        sink.write(Stamp(time, 0), entry)
    sink.close()
    return folder


@pytest.fixture
def run_dir(tmp_path: Path) -> Path:
    return record(tmp_path / "one", mission())


def damage_a_chunk(path: Path, number: int) -> int:
    """Change a few bytes of a chunk; return its offset."""
    with path.open("rb") as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    offset = summary.chunk_indexes[number].chunk_start_offset
    data = bytearray(path.read_bytes())
    data[offset + 60 : offset + 68] = b"\0" * 8
    path.write_bytes(data)
    return offset


# --- why ---


def test_an_ordered_fault_stands_among_the_decisions_and_in_the_summary(run_dir: Path) -> None:
    (fault,) = [decision for decision in why(Run(run_dir)) if decision.source == "world"]
    assert (fault.question, fault.time_s) == ("fault", 6.2)
    assert fault.answer == "moved=sugar_box:desk@6: the sugar_box is taken to desk"
    text = report.summary_text([report.summary(Run(run_dir))])
    assert "6.2 s moved=sugar_box:desk@6: the sugar_box is taken to desk" in text


def test_a_fallback_is_a_decision_between_its_children(tmp_path: Path) -> None:
    decided = tick(0, "mission/drive", "RUNNING", "SUCCESS", "SUCCESS", "RUNNING", "INVALID")
    (decision,) = why(Run(record(tmp_path, [(0.0, TREE), (1.0, decided)])))
    assert (decision.question, decision.source, decision.time_s) == ("which places", "user", 1.0)
    assert decision.by == "mission/which places/ask"


def test_nested_decisions_settled_by_one_behaviour_are_told_once(tmp_path: Path) -> None:
    nodes = [
        ("mission", "", "sequence"),
        ("mission/outer", "mission", "selector"),
        ("mission/outer/first", "mission/outer", "behaviour"),
        ("mission/outer/inner", "mission/outer", "selector"),
        ("mission/outer/inner/taken", "mission/outer/inner", "behaviour"),
        ("mission/outer/inner/spare", "mission/outer/inner", "behaviour"),
    ]
    shape = TreeShape(tuple(NodeShape(p, up, Path(p).name, kind, "") for p, up, kind in nodes))
    statuses = ("RUNNING", "SUCCESS", "FAILURE", "SUCCESS", "SUCCESS", "INVALID")
    states = (NodeState(node[0], status) for node, status in zip(nodes, statuses, strict=True))
    decided = Tick(0, "Started", "mission", tuple(states), {}, 0.0)
    (decision,) = why(Run(record(tmp_path, [(0.0, shape), (1.0, decided)])))
    assert (decision.question, decision.by) == ("outer", "mission/outer/inner/taken")
    assert [a.what for a in decision.alternatives] == ["first", "spare"]


def test_what_failed_on_the_way_to_a_decision_says_why(tmp_path: Path) -> None:
    failed = tick(0, "mission/which places/ask", "FAILURE", "FAILURE", *["FAILURE"] * 3)
    (decision,) = why(Run(record(tmp_path, [(0.0, TREE), (1.0, failed)])))
    assert decision.answer == "nothing worked"
    assert decision.alternatives == (Alternative("ask", "no"),)


@pytest.mark.parametrize(
    ("condition", "contrary"),
    [
        ("in my hand", "not in my hand"),
        ("it was there", "it was not there"),
        ("person may help", "person may not help"),
        ("perhaps it is", "perhaps it is not"),
        ("something is left", "nothing is left"),
    ],
)
def test_a_condition_that_did_not_hold_reads_as_a_sentence(condition: str, contrary: str) -> None:
    assert denied(condition) == contrary


def test_of_a_recording_without_ticks_it_says_that_nothing_was_decided(tmp_path: Path) -> None:
    assert "no ticks" in why_text(why(Run(record(tmp_path, [(0.0, TREE)]))))


def test_what_the_model_named_in_vain_is_an_alternative(tmp_path: Path) -> None:
    shape = tuple(
        replace(node, source="llm") if node.name == "ask" else node for node in TREE.nodes
    )
    decided = tick(0, "mission/drive", "RUNNING", "SUCCESS", "SUCCESS", "RUNNING", "INVALID")
    records = [
        (0.0, type(TREE)(shape)),
        (0.5, rank_call()),
        (0.6, Verified("general_pos", (), (), ("spice rack",))),
        (1.0, decided),
    ]
    (decision,) = why(Run(record(tmp_path, records)))
    assert decision.source == "llm"
    assert Alternative("desk", "scored 0.70") in decision.alternatives
    assert Alternative("spice rack", "no such place here") in decision.alternatives


def test_what_was_dropped_belongs_to_the_call_before_it_even_at_one_moment(tmp_path: Path) -> None:
    dropped = [Verified("general_pos", (), (), (name,)) for name in ("pantry", "cellar")]
    records = [TREE, chat_call(), dropped[0], chat_call(), dropped[1]]
    first, second = report.llm(Run(record(tmp_path, [(0.0, entry) for entry in records])))
    assert first["verified"]["dropped"] == ("pantry",)
    assert second["verified"]["dropped"] == ("cellar",)


def test_what_the_model_prepared_for_a_call_is_told_with_it(tmp_path: Path) -> None:
    rows = report.llm(Run(record(tmp_path, [(0.0, rank_call())])))
    assert "  prepared  250 tokens in 1.20 s\n" in report.llm_text(rows)


def test_the_chain_ends_with_the_outcome(run_dir: Path) -> None:
    assert why(Run(run_dir))[-1].question == "outcome"


@pytest.mark.parametrize("question", ["why", "ticks", "timeline", "llm", "dialog"])
def test_an_answer_says_that_the_recording_of_a_killed_mission_ends_early(
    question: str, run_dir: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([question, str(run_dir)]) == 0
    assert "ends early" not in capsys.readouterr().out
    file = run_dir / "mission.mcap"
    file.write_bytes(file.read_bytes()[:-20])
    assert main([question, str(run_dir)]) == 0
    assert capsys.readouterr().out.endswith("\nthe recording ends early\n")


@pytest.mark.parametrize(
    ("question", "said"),
    [
        ("why", "nothing was decided: the recording has no ticks"),
        ("ticks", "nothing happened: the recording has no ticks"),
        ("timeline", "no behaviour ran: the recording has no ticks"),
        ("llm", "no call of the model"),
        ("dialog", "nothing was said"),
    ],
)
def test_of_a_mission_that_was_killed_before_its_first_tick_it_is_said_that_there_is_nothing(
    question: str, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run = record(tmp_path / "none", [(0.0, TREE)])
    assert main([question, str(run)]) == 0
    assert capsys.readouterr().out == f"{said}\n"


# --- ticks and summary ---


def test_each_tick_tells_its_events_and_what_it_changed(run_dir: Path) -> None:
    first, second, third = report.ticks(Run(run_dir))
    assert first["events"] == ["Started Bring a sugar_box"]
    assert [node["path"] for node in second["changed"]] == [
        "mission/which places",
        "mission/which places/ask",
        "mission/drive",
    ]
    assert third["events"] == ["Ended Succeeded"]


def test_the_summary_says_where_the_time_went(run_dir: Path) -> None:
    assert report.summary(Run(run_dir))["time_by_behaviour_s"] == {"drive": 4.0, "ask": 2.0}


def test_a_folder_of_runs_is_one_table_in_which_a_broken_one_has_its_row(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    record(tmp_path / "a", mission())
    (record(tmp_path / "b", mission()) / "mission.mcap").write_bytes(b"hello, hello, hello")
    assert main(["summary", str(tmp_path)]) == 0
    head, a, b = capsys.readouterr().out.splitlines()
    assert head.split()[:4] == ["run", "command", "status", "source"]
    assert a.split()[:5] == ["a", "Bring", "a", "sugar_box", "done"]
    assert "is not an mcap file" in b


@pytest.mark.parametrize(
    ("question", "answer"),
    [
        ("why", "2.000  which places: ask  [user]"),
        ("ticks", "RUNNING  mission/drive  (on the way)"),
        ("summary", "seconds by behaviour: drive 4.0, ask 2.0"),
        ("summary", "2 calls of the model, 0 questions, 1 place visited"),
    ],
)
def test_questions_are_answered_in_words_and_as_json(
    run_dir: Path, capsys: pytest.CaptureFixture[str], question: str, answer: str
) -> None:
    assert main([question, str(run_dir)]) == 0
    assert answer in capsys.readouterr().out
    assert main([question, str(run_dir), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)


def test_the_timeline_is_drawn_with_a_bar_for_each_span(run_dir: Path, tmp_path: Path) -> None:
    file = tmp_path / "when.svg"
    assert main(["timeline", str(run_dir), "--svg", str(file)]) == 0
    spans = report.timeline(Run(run_dir))
    svg = "{http://www.w3.org/2000/svg}"
    bars = [b for b in ElementTree.parse(file).iter(f"{svg}rect") if len(b)]
    assert len(bars) == len(spans)
    lengths = [float(bar.attrib["width"]) for bar in bars]
    ask, drive, _ = lengths
    assert drive == pytest.approx(2 * ask, rel=0.01)
    assert main(["timeline", str(run_dir), "--svg", str(tmp_path / "nowhere" / "a.svg")]) == 2


# --- side by side ---


def test_a_mission_does_not_part_from_itself(
    run_dir: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert parting(Run(run_dir), Run(run_dir)) is None
    assert main(["compare", str(run_dir), str(run_dir)]) == 0
    assert "decided alike, tick for tick" in capsys.readouterr().out


def test_two_missions_part_at_the_first_tick_that_is_not_the_same(
    tmp_path: Path, run_dir: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lost = tick(2, "mission/see", "FAILURE", "SUCCESS", "SUCCESS", "SUCCESS", "FAILURE")
    changed = [(t, lost if getattr(r, "number", 0) == 2 else r) for t, r in mission()]
    other = record(tmp_path / "other", changed, "seed = 8\n")
    compared = compare(Run(run_dir), Run(other))
    assert compared.parting is not None
    assert (compared.parting.tick, compared.parting.time_s) == (2, 6.0)
    see = compared.parting.aspects[-1]
    assert (see.what, see.one, see.other) == ("mission/see", "SUCCESS", "FAILURE")
    assert [aspect.what for aspect in compared.setup] == ["seed"]
    assert main(["compare", str(run_dir), str(other), "--json"]) == 1
    assert json.loads(capsys.readouterr().out)["parting"]["tick"] == 2


def test_a_mission_that_ends_earlier_parts_where_it_ends(tmp_path: Path, run_dir: Path) -> None:
    shorter = record(tmp_path / "other", [e for e in mission() if e[0] < 6.0])
    found = parting(Run(run_dir), Run(shorter))
    assert found is not None
    assert (found.tick, found.aspects[0].other) == (2, "has ended")


def test_a_long_value_is_shown_as_it_begins() -> None:
    shown = aspects_text([Aspect("belief", "short", "x" * 5000)], ("A", "B")).splitlines()
    assert shown[1] == "    A  short"
    assert shown[2].startswith("    B  xxx")
    assert shown[2].endswith("(all: --json)")
    assert len(shown[2]) < 200


# --- pictures ---


def test_pictures_are_written_as_png(run_dir: Path, tmp_path: Path) -> None:
    out = tmp_path / "pictures"
    assert main(["frames", str(run_dir), "--png", "--out", str(out)]) == 0
    (file,) = out.iterdir()
    picture = cv2.imread(str(file))
    assert file.suffix == ".png"
    assert picture is not None
    assert picture.shape == (120, 160, 3)


def test_a_second_of_the_video_is_a_second_of_the_mission(tmp_path: Path) -> None:
    seen = [(0.0, TREE), *((float(2 * n), Picture(frame(n))) for n in range(3))]
    out = tmp_path / "mission.mp4"
    assert main(["frames", str(record(tmp_path / "run", seen)), "--out", str(out)]) == 0
    video = cv2.VideoCapture(str(out))
    pictures, hz = video.get(cv2.CAP_PROP_FRAME_COUNT), video.get(cv2.CAP_PROP_FPS)
    assert pictures / hz == pytest.approx(4.1)


def test_pictures_of_two_sizes_are_all_in_the_video(tmp_path: Path) -> None:
    seen = [At(0.0, picture(40, 30)), At(1.0, picture(80, 60)), At(2.0, picture(40, 30))]
    out = tmp_path / "mission.mp4"
    count = write_video(seen, out)
    video = cv2.VideoCapture(str(out))
    assert video.get(cv2.CAP_PROP_FRAME_COUNT) == count == 21
    assert video.get(cv2.CAP_PROP_FRAME_WIDTH) == 80


def picture(width: int, height: int) -> bytes:
    return cv2.imencode(".jpg", np.full((height, width, 3), 128, np.uint8))[1].tobytes()


def test_a_recording_without_pictures_makes_no_video(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run = record(tmp_path / "run", [(0.0, TREE)])
    assert main(["frames", str(run), "--out", str(tmp_path / "mission.mp4")]) == 2
    assert "holds no pictures" in capsys.readouterr().err


@pytest.mark.parametrize(("options", "flags"), [([], []), (["--web"], ["--web-viewer"])])
def test_the_viewer_is_opened_natively_or_in_the_browser(
    run_dir: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    options: list[str],
    flags: list[str],
) -> None:
    (run_dir / "mission.rrd").touch()
    seen = tmp_path / "arguments"
    write = f"import sys; open({str(seen)!r}, 'w').write(chr(10).join(sys.argv[1:]))"
    monkeypatch.setattr(program, "COMMAND", [sys.executable, "-c", write])
    monkeypatch.setenv("DISPLAY", ":0")
    assert main(["view", str(run_dir), *options]) == 0
    assert seen.read_text().splitlines() == [*flags, str(run_dir / "mission.rrd")]


# --- tables ---


def test_runs_in_bulk_become_tables_that_join_by_run(tmp_path: Path) -> None:
    record(tmp_path / "runs" / "a", mission())
    record(tmp_path / "runs" / "b", [(0.0, TREE)])
    assert main(["export", str(tmp_path / "runs"), "--parquet", str(tmp_path / "tables")]) == 0
    tables = {file.stem: pq.read_table(file).to_pylist() for file in tmp_path.glob("tables/*")}
    assert [(row["run"], row["status"]) for row in tables["runs"]] == [("a", "done"), ("b", None)]
    assert {row["run"] for row in tables["behaviours"]} == {"a"}
    assert len(tables["behaviours"]) == len(TREE.nodes) * len(tables["ticks"])
    rank, chat = tables["llm_calls"]
    assert json.loads(rank["scores"])["desk"] == 0.7
    assert chat["verified"]["dropped"] == ["spice rack"]
    assert [row["result"] for row in tables["events"]] == [None, "Succeeded"]


# --- damage ---


def test_damage_is_named_by_its_offset_and_the_rest_is_saved(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "mission.mcap"
    sink = McapSink(path, STARTED, {}, {})
    for time, entry in mission():
        sink.write(Stamp(time, 0), entry)
        sink.flush()
    sink.close()
    offset = damage_a_chunk(path, 5)
    assert (first_damage(path) or ())[0] == offset
    assert main(["ticks", str(tmp_path)]) == 2
    assert f"the file is damaged at byte {offset}; `python -m logs recover" in (
        capsys.readouterr().err
    )
    assert Run(recover(path)).outcome() is not None


def test_recover_says_where_the_file_breaks(
    run_dir: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = run_dir / "mission.mcap"
    shutil.copy(path, path.with_name("whole.mcap"))
    path.write_bytes(path.read_bytes()[:-2000])
    assert main(["recover", str(path)]) == 0
    assert "does not read at byte" in capsys.readouterr().out
    assert main(["recover", str(path.with_name("whole.mcap"))]) == 0
    assert "nothing was missing" in capsys.readouterr().out
