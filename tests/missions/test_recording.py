"""What a whole mission leaves behind, read with readers that are not ours."""

import io
import json
from collections import Counter
from pathlib import Path

import pytest
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory
from rerun.chunk import RrdReader

from executive.app.session import Session
from executive.config import load_settings
from executive.types.outcome import Outcome

pytestmark = [pytest.mark.physics, pytest.mark.llm]


@pytest.fixture(scope="module")
def mission(tmp_path_factory: pytest.TempPathFactory) -> tuple[Outcome, int]:
    settings = load_settings(user="oracle", runs=tmp_path_factory.mktemp("runs"), seed=3)
    session = Session(settings, out=io.StringIO())
    outcome = session.run("Bring a sugar_box.")
    session.close()
    return outcome, session.ticks


def test_the_mcap_has_every_tick_call_and_frame(mission: tuple[Outcome, int]) -> None:
    outcome, ticks = mission
    with (Path(outcome.run_dir or "") / "mission.mcap").open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        messages = list(reader.iter_decoded_messages())
        attachments = {a.name for a in reader.iter_attachments()}
        metadata = {m.name: m.metadata for m in reader.iter_metadata()}
    counts = Counter(channel.topic for _, channel, _, _ in messages)
    assert counts["/bt/tick"] == ticks
    assert counts["/bt/tree"] == counts["/outcome"] == 1
    assert counts["/llm/call"] == outcome.llm_calls == 1
    assert counts["/camera/image/compressed"] > len(outcome.visited)
    assert counts["/camera/annotations"] == len(outcome.visited)
    assert {"/event", "/dialog", "/tf", "/scene", "/camera/camera_info", "/log"} <= set(counts)
    assert {"config.toml", "household.owl", "defaults.owl"} <= attachments
    assert any(entry.get("seed") == "3" for entry in metadata.values())
    first, last = messages[0][2].log_time, messages[-1][2].log_time
    assert (last - first) / 1e9 == pytest.approx(outcome.mission_time_s, abs=0.5)


def test_every_tick_in_the_mcap_has_the_whole_tree(mission: tuple[Outcome, int]) -> None:
    with (Path(mission[0].run_dir or "") / "mission.mcap").open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        [tree] = [m for _, _, _, m in reader.iter_decoded_messages(topics=["/bt/tree"])]
        ticks = [m for _, _, _, m in reader.iter_decoded_messages(topics=["/bt/tick"])]
    assert {len(tick.behaviours) for tick in ticks} == {len(tree.behaviours)}


def test_the_rrd_reads_and_shows_home_robot_camera_and_tree(mission: tuple[Outcome, int]) -> None:
    reader = RrdReader(Path(mission[0].run_dir or "") / "mission.rrd")
    rows: Counter[str] = Counter()
    for chunk in reader.stream():
        rows[str(chunk.entity_path)] += chunk.num_rows
    paths = " ".join(rows)
    for part in ("camera", "counter_wagon", "sugar_box", "panda", "tree", "llm"):
        assert part in paths, sorted(rows)


def test_outcome_json_agrees(mission: tuple[Outcome, int]) -> None:
    kept = json.loads((Path(mission[0].run_dir or "") / "outcome.json").read_text())
    assert kept["status"] == mission[0].status
    assert tuple(kept["visited"]) == mission[0].visited
