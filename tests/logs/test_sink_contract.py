"""Both logs keep the contract."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from mcap.exceptions import McapError
from mcap.records import Chunk, Message
from mcap.stream_reader import StreamReader, breakup_chunk
from rerun.chunk import RrdReader
from sample_mission import STARTED

from executive.testing.contracts.sink import SinkBench, SinkContract
from logs.recording.sink import McapSink
from logs.viewer.sink import RerunSink


class TestMcapSink(SinkContract):
    @pytest.fixture
    def sink_bench(self, tmp_path: Path) -> SinkBench:
        path = tmp_path / "mission.mcap"
        return SinkBench(lambda: McapSink(path, STARTED, {}, {}), lambda: len(list(messages(path))))


def messages(path: Path) -> Iterator[Message]:
    """All that can be read by others, also of a file that has no end yet."""
    with path.open("rb") as file:
        try:
            for record in StreamReader(file, emit_chunks=True).records:
                if isinstance(record, Chunk):
                    yield from (r for r in breakup_chunk(record) if isinstance(r, Message))
        except McapError:
            return


@pytest.mark.filterwarnings("ignore:RRD file has no footer")
class TestRerunSink(SinkContract):
    @pytest.fixture
    def sink_bench(self, tmp_path: Path) -> SinkBench:
        path = tmp_path / "mission.rrd"
        return SinkBench(lambda: RerunSink(path), lambda: rows(path))


def rows(path: Path) -> int:
    return sum(chunk.to_record_batch().num_rows for chunk in RrdReader(path).stream())
