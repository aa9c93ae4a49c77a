"""All that says where things are keeps the contract of a source."""

import pytest

from executive.app.sources import WrittenSource
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
        source = WrittenSource("calendar", "your calendar says so", {"mug": ("desk",)})
        return SourceBench(source, "mug", ("desk",))
