"""All that says where things are keeps the contract of a source."""

import pytest

from executive.app.sources import read
from executive.records import SourceAnswer
from executive.testing.contracts.place_source import PlaceSourceContract, SourceBench
from kb.facts import FactStore
from trees.recall import Memory


class TestMemory(PlaceSourceContract):
    @pytest.fixture
    def source_bench(self) -> SourceBench:
        facts = FactStore.believing({"mug": ["desk", "sofa"]}, learns=True)
        return SourceBench(Memory(facts), "mug", ("desk", "sofa"))


class TestWhatARecordingKept(PlaceSourceContract):
    @pytest.fixture
    def source_bench(self) -> SourceBench:
        text = b'[{"name": "calendar", "says": "your calendar says so"}]'
        (source,) = read("a run", text, [SourceAnswer("calendar", "mug", ("desk",))])
        return SourceBench(source, "mug", ("desk",))
