"""A recording may be a stranger's: whatever is in it, a command answers or says what is wrong."""

import contextlib
import io
import json
import os
import struct
import sys
from collections.abc import Iterator
from dataclasses import fields, replace
from pathlib import Path

import pyarrow.parquet as pq
import pytest
from google.protobuf.descriptor_pb2 import FileDescriptorSet
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.opcode import Opcode
from mcap_protobuf.schema import build_file_descriptor_set
from recordings import chunk, framed, insert, record, records_of, repack
from sample_mission import STARTED, TREE, detection, frame, tick

from executive.errors import InputError
from executive.events import Ended
from executive.records import (
    EventTaken,
    NodeShape,
    NodeState,
    Picture,
    Record,
    TreeShape,
)
from executive.types.outcome import Outcome
from executive.types.results import Saw
from logs.__main__ import main
from logs.questions import export
from logs.recording import mcap_file, parsing
from logs.recording.channels import MESSAGES
from logs.recording.mcap_file import MiB
from logs.recording.older import recorded_class
from logs.recording.reader import Run
from logs.recording.recovery import recover
from logs.recording.schema import PACKAGE

QUESTIONS = ("why", "summary", "ticks", "timeline", "llm", "dialog", "frames", "export", "replay")


def ask(question: str, run: Path, out: Path) -> int:
    """The exit status of a command about a run; what it writes goes to `out`."""
    options = {
        "frames": ["--png", "--out", str(out)],
        "export": ["--parquet", str(out)],
        "compare": [str(run)],
    }
    return main([question, str(run), *options.get(question, [])])


@pytest.fixture
def run(tmp_path: Path) -> Path:
    return record(tmp_path / "run")


# --- the file ---


def bomb(packing: str, says: int | None = None) -> bytes:
    return chunk(framed(0x90, bytes(40 * MiB)), packing, says=says)


@pytest.mark.parametrize("packing", ["zstd", "lz4"])
def test_a_chunk_that_says_that_it_is_huge_is_not_unpacked(run: Path, packing: str) -> None:
    at = insert(run, bomb(packing, says=10 * 2**30))
    with pytest.raises(InputError, match=rf"unpacks to 10737418240 bytes.*damaged at byte {at}"):
        list(Run(run).ticks())


@pytest.mark.parametrize("packing", ["zstd", "lz4"])
def test_a_chunk_that_is_more_than_it_says_is_unpacked_no_further(run: Path, packing: str) -> None:
    at = insert(run, bomb(packing, says=1000))
    with pytest.raises(InputError, match=rf"not unpack to its 1000 bytes.*damaged at byte {at}"):
        list(Run(run).ticks())


def test_many_chunks_may_not_unpack_to_more_than_a_mission_does(
    run: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(mcap_file, "MOST_UNPACKED", MiB)
    insert(run, *[chunk(framed(0x90, bytes(MiB)))] * 30)
    with pytest.raises(InputError, match="more than the .* that are read of a file of this size"):
        list(Run(run).ticks())


def test_of_many_tiny_records_no_more_are_read_than_a_mission_has(
    run: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(mcap_file, "MOST_RECORDS", 1000)
    assert list(Run(run).ticks())
    at = insert(run, chunk(framed(0x90, b"") * 1000))
    with pytest.raises(InputError, match=f"records that are read: .* damaged at byte {at}"):
        list(Run(run).ticks())


@pytest.mark.parametrize("opcode", [Opcode.ATTACHMENT, Opcode.METADATA, Opcode.CHUNK])
def test_a_record_that_is_huge_is_not_read(run: Path, opcode: int) -> None:
    file, huge = run / "mission.mcap", 3 * 2**30
    with file.open("r+b") as sparse:
        at = insert(run)
        sparse.seek(at)
        sparse.write(struct.pack("<BQ", opcode, huge))
        sparse.truncate(at + 9 + huge + 100)
    with pytest.raises(InputError, match=f"of {huge} bytes is more than .* damaged at byte {at}"):
        list(Run(run).ticks())


def test_of_two_files_in_one_nobody_is_told_that_nothing_is_missing(
    run: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file, before = run / "mission.mcap", list(Run(run).ticks())
    one = file.read_bytes()
    file.write_bytes(one * 2)
    assert main(["summary", str(run)]) == 2
    assert (
        f"another file begins here, which is not read: the file is damaged at byte {len(one)}"
        in (capsys.readouterr().err)
    )
    assert list(Run(recover(file)).ticks()) == before
    file.write_bytes(one + bytes(100))
    assert list(Run(run).ticks()) == before


def test_a_recording_packed_with_lz4_reads(run: Path) -> None:
    before = list(Run(run).ticks())
    repack(run, packing="lz4")
    assert list(Run(run).ticks()) == before


@pytest.mark.parametrize("question", [*QUESTIONS, "compare"])
@pytest.mark.parametrize("packing", ["zstd", "lz4"])
def test_every_command_names_the_byte_at_which_a_recording_is_damaged(
    run: Path, capsys: pytest.CaptureFixture[str], question: str, packing: str
) -> None:
    repack(run, packing=packing)
    file = run / "mission.mcap"
    data = bytearray(file.read_bytes())
    _, at, *_ = (o for o, opcode, _ in records_of(bytes(data)) if opcode == Opcode.CHUNK)
    data[at + 70] ^= 0xFF
    file.write_bytes(data)
    assert ask(question, run, run / "out") == 2
    assert f"damaged at byte {at}" in capsys.readouterr().err
    assert not list(run.glob("out/*"))


def test_a_byte_that_was_changed_is_noticed_where_nothing_is_packed(run: Path) -> None:
    repack(run, packing="")
    assert len(list(Run(run).dialog())) == 2
    file = run / "mission.mcap"
    file.write_bytes(file.read_bytes().replace(b"Here is the sugar_box", b"Here is no sugar_box."))
    with pytest.raises(InputError, match="checksum of a chunk is wrong: .* damaged at byte"):
        list(Run(run).dialog())


def test_the_index_at_the_end_of_a_file_is_not_believed(run: Path) -> None:
    before, file = list(Run(run).ticks()), run / "mission.mcap"
    data = bytearray(file.read_bytes())
    for offset, opcode, whole in records_of(bytes(data)):
        if opcode in (Opcode.CHUNK_INDEX, Opcode.STATISTICS, Opcode.MESSAGE_INDEX):
            data[offset + 9 : offset + len(whole)] = b"\xff" * (len(whole) - 9)
    file.write_bytes(data)
    assert list(Run(run).ticks()) == before


def test_what_a_power_failure_leaves_reads_up_to_the_zeros(run: Path) -> None:
    file = run / "mission.mcap"
    data = file.read_bytes()
    *_, last = (o for o, opcode, _ in records_of(data) if opcode == Opcode.CHUNK)
    file.write_bytes(data[:last] + bytes(len(data) - last))
    assert len(list(Run(run).ticks())) == 3
    assert not Run(run).whole


def damaged(data: bytes, damage: tuple[str, int, bytes]) -> bytes:
    kind, at, junk = damage
    at %= len(data)
    match kind:
        case "cut":
            return data[:at]
        case "insert":
            return data[:at] + junk + data[at:]
        case _:
            return data[:at] + junk + data[at + len(junk) :]


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return record(tmp_path_factory.mktemp("sound"))


some_damage = st.tuples(
    st.sampled_from(["cut", "insert", "replace"]),
    st.integers(0, 2**20),
    st.binary(min_size=1, max_size=9),
)


@settings(max_examples=40, deadline=None)
@given(some_damage, st.booleans())
def test_whatever_is_damaged_the_commands_answer_or_refuse(
    sound: Path, damage: tuple[str, int, bytes], inside: bool
) -> None:
    run = record(sound / "damaged")
    if inside:
        repack(run, lambda data: damaged(data, damage))
    else:
        file = run / "mission.mcap"
        file.write_bytes(damaged(file.read_bytes(), damage))
    for question in ("why", "summary", "ticks", "llm", "recover", "replay"):
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            assert ask(question, run, run / "out") in (0, 2)


# --- what the records say ---


def with_tick(**changed: object) -> list[tuple[float, Record]]:
    whole = tick(0, "mission", *["RUNNING"] * 5)
    return [(0.0, TREE), (1.0, replace(whole, **changed))]  # type: ignore[arg-type]


def nested(levels: int) -> object:
    value: object = 1
    for _ in range(levels):
        value = [value]
    return value


ring = NodeShape("a", "a", "a", "selector", "Selector")
UNFIT: dict[str, list[tuple[float, Record]]] = {
    "a tree that bites its tail": [(0.0, TreeShape((ring,)))],
    "a tree with a path twice": [(0.0, TreeShape((*TREE.nodes, TREE.nodes[1])))],
    "a tick without its behaviours": with_tick(nodes=()),
    "a status that is none": with_tick(
        nodes=tuple(NodeState(n.path, "UNKNOWN") for n in TREE.nodes)
    ),
    "candidates that are a number": with_tick(situation={"candidates": 5}),
    "a candidate without a place": with_tick(situation={"candidates": [{"at": "desk"}]}),
    "places as a list": with_tick(situation={"unreached": ["desk"]}),
    "a value nested deeply": with_tick(situation={"object": nested(100)}),
    "a tick without an end": with_tick(duration_s=float("nan")),
    "a time long after": [(0.0, TREE), (1e9, TREE), (1e9, with_tick()[1][1])],
}


@pytest.mark.parametrize("records", UNFIT.values(), ids=UNFIT)
@pytest.mark.parametrize("question", ["why", "timeline"])
def test_what_no_mission_records_is_said_with_its_place(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    records: list[tuple[float, Record]],
    question: str,
) -> None:
    assert ask(question, record(tmp_path / "run", records), tmp_path / "out") == 2
    assert "cannot be read: " in (error := capsys.readouterr().err)
    assert "damaged at byte" in error


@pytest.mark.parametrize("lists", [[[]] * 2000, ["x" * 100_000], [{}, {}] * 1000])
def test_no_more_is_read_than_memory_has_room_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, lists: object
) -> None:
    monkeypatch.setattr(parsing, "MOST_READ", 100_000)
    run = record(tmp_path, with_tick(situation={"among": None, "view": lists}))
    with pytest.raises(InputError, match="all messages up to here are more than is read"):
        list(Run(run).ticks())


@pytest.mark.parametrize("text", ["[" * 100_000, "no JSON", "9" * 5000])
def test_a_fact_that_is_no_json_is_said_with_its_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str
) -> None:
    with monkeypatch.context() as odd:
        odd.setattr(json, "dumps", lambda value, **options: text)
        run = record(tmp_path / "run", with_tick())
    with pytest.raises(InputError, match=r"/bt/tick cannot be read: .* damaged at byte"):
        list(Run(run).ticks())


def test_a_detection_of_absurd_size_takes_no_memory(tmp_path: Path) -> None:
    wide = replace(detection(), box=replace(detection().box, width=10**12))
    run = record(tmp_path, [(0.0, TREE), (1.0, EventTaken(Ended(1, Saw(0, (wide,)))))])
    with pytest.raises(InputError, match="which is in no picture"):
        list(Run(run).events())


def test_a_picture_of_absurd_size_is_not_decoded(run: Path, tmp_path: Path) -> None:
    size = b"\xff\xc0\x00\x11\x08" + struct.pack(">HH", 120, 160)
    repack(run, lambda data: data.replace(size, size[:5] + struct.pack(">HH", 65000, 65000)))
    for out in ("pictures", "video.mp4"):
        assert main(["frames", str(run), "--png", "--out", str(tmp_path / out)]) == 2
    assert not (tmp_path / "video.mp4").exists()
    assert not list(tmp_path.glob("pictures/*"))


def test_pictures_that_span_days_become_no_video(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run = record(tmp_path, [(0.0, TREE), (0.0, Picture(frame())), (1e6, Picture(frame()))])
    assert main(["frames", str(run), "--out", str(tmp_path / "a.mp4")]) == 2
    assert "is longer than" in capsys.readouterr().err


def test_a_timeline_of_days_is_drawn_with_few_marks(tmp_path: Path) -> None:
    late = [*with_tick(), (2e6, replace(with_tick()[1][1], number=1))]  # type: ignore[type-var]
    out = tmp_path / "when.svg"
    assert main(["timeline", str(record(tmp_path, late)), "--svg", str(out)]) == 0
    assert out.read_text().count("<line") < 20


# --- what is kept with it ---

HOSTILE = """
llm = "http://127.0.0.1:9/v1"
runs = "{bait}/runs"
kb = ["{bait}/mine.owl", "..", "/"]
prompts = "{bait}/prompts.toml"
ycb = "{bait}/ycb"
memory = "{bait}/memory"
detector = "{bait}/x.onnx"
"""


def test_names_of_attachments_lead_nowhere(tmp_path: Path) -> None:
    names = ("../../x", "/etc/x", "..", "a/b", "line\nbreak", "x" * 300, "fine.owl")
    run = record(tmp_path, attachments={name: b"x" for name in names})
    assert list(Run(run).attachments) == ["fine.owl"]


@pytest.fixture
def touched() -> Iterator[list[str]]:
    """Files, programs and addresses that are opened meanwhile."""
    seen: list[str] = []
    listening = True

    def hear(event: str, arguments: tuple[object, ...]) -> None:
        if listening and event in ("open", "subprocess.Popen", "socket.connect", "os.listdir"):
            seen.append(f"{event} {arguments}")

    sys.addaudithook(hear)
    yield seen
    listening = False


def test_a_replay_opens_nothing_that_the_recorded_settings_name(
    tmp_path: Path, touched: list[str]
) -> None:
    from replays import recorded

    from executive.replay.replaying import replay

    original = Run(recorded(tmp_path / "runs", "Find a hammer", llm=False))
    bait = tmp_path / "bait"
    config = HOSTILE.format(bait=bait).encode() + b'knowledge = "okb+llm"\nworld = "fake"\n'
    facts = {**original.metadata, "started": STARTED.isoformat()}
    kept = {**original.attachments, "config.toml": config}
    run = record(tmp_path / "run", attachments=kept, facts=facts)
    touched.clear()
    replay(run)
    assert touched
    others = [entry for entry in touched if not entry.endswith("sim/homes',)")]  # the packaged ones
    assert not [entry for entry in others if str(bait) in entry or "open" not in entry]


@pytest.mark.parametrize("config", [b"\xff", b"a = [", b"a = " + b"[" * 10_000, b"a = 1"])
@pytest.mark.parametrize("question", ["compare", "replay", "export"])
def test_recorded_settings_that_are_none_are_refused_in_a_sentence(
    tmp_path: Path, question: str, config: bytes
) -> None:
    run = record(tmp_path / "run", attachments={"config.toml": config})
    assert ask(question, run, tmp_path / "out") in (0, 2)


# --- older recordings ---


def test_an_older_recording_reads_by_the_numbers_that_it_gives_its_fields() -> None:
    definition = build_file_descriptor_set(MESSAGES["LlmCall"])
    older = FileDescriptorSet.FromString(definition.SerializeToString())
    (file,) = (file for file in older.file if file.package == PACKAGE)
    (call,) = (message for message in file.message_type if message.name == "LlmCall")
    for field in call.field:
        field.number += 7
    kind = recorded_class("LlmCall", older.SerializeToString())
    bytes_then = kind(label="rank", kind="food").SerializeToString()
    assert kind.FromString(bytes_then).kind == "food"
    assert MESSAGES["LlmCall"].FromString(bytes_then).kind == ""
    assert recorded_class("LlmCall", definition.SerializeToString()) is MESSAGES["LlmCall"]


def test_a_definition_that_gives_two_fields_one_number_is_refused() -> None:
    definition = build_file_descriptor_set(MESSAGES["Tick"])
    for file in definition.file:
        for message in file.message_type:
            for field in message.field:
                field.number = 5
    with pytest.raises(ValueError, match="numbers fields as none can be"):
        recorded_class("Tick", definition.SerializeToString())


# --- several, and what is written ---


def break_off(run: Path) -> Path:
    file = run / "mission.mcap"
    file.write_bytes(file.read_bytes()[:300])
    return run


def test_one_unreadable_run_costs_no_other_its_export(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("a", "b", "c"):
        record(tmp_path / "runs" / name)
    break_off(tmp_path / "runs" / "b")
    assert main(["export", str(tmp_path / "runs"), "--parquet", str(tmp_path / "tables")]) == 1
    assert str(tmp_path / "runs" / "b") in capsys.readouterr().err
    for table in (tmp_path / "tables").iterdir():
        assert set(pq.read_table(table)["run"].to_pylist()) == {"a", "c"}


def test_a_run_that_ends_early_is_exported_as_far_as_it_reads_and_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    early, whole = record(tmp_path / "runs" / "a"), record(tmp_path / "runs" / "b")
    file = early / "mission.mcap"
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    assert main(["export", str(early), str(whole), "--parquet", str(tmp_path / "tables")]) == 0
    assert f"{early}: ends early" in capsys.readouterr().err
    assert pq.read_table(tmp_path / "tables" / "runs.parquet")["whole"].to_pylist() == [False, True]


def test_every_field_of_an_outcome_is_a_column() -> None:
    columns = [name for name, _ in export.TABLES["runs"][1]]
    assert {field.name for field in fields(Outcome)} <= set(columns)


@pytest.mark.parametrize("question", ["summary", "replay"])
def test_of_several_named_runs_one_that_is_unreadable_has_its_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], question: str
) -> None:
    broken, sound = break_off(record(tmp_path / "a")), record(tmp_path / "b")
    main([question, str(broken), str(sound)])
    assert "records no mission" in capsys.readouterr().out


def test_a_runs_folder_is_recovered_as_its_file_is(
    run: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = run / "mission.mcap"
    file.write_bytes(file.read_bytes()[:-3000])
    assert main(["recover", str(run)]) == 0
    assert "does not read at byte" in capsys.readouterr().out
    assert Run(run / "mission.recovered.mcap").whole


def test_what_is_recovered_is_there_whole_or_not_at_all(
    run: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(file: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(InputError, match="No space left"):
        recover(run / "mission.mcap")
    assert [file.name for file in run.iterdir()] == ["mission.mcap"]


def test_a_picture_of_the_timeline_is_not_written_over_the_recording(run: Path) -> None:
    before = (run / "mission.mcap").read_bytes()
    assert main(["timeline", str(run), "--svg", str(run / "mission.mcap")]) == 2
    assert (run / "mission.mcap").read_bytes() == before
