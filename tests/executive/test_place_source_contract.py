"""A list of places keeps the contract of a source."""

import pytest

from executive.testing.contracts.place_source import PlaceSourceContract, SourceBench


class Shelves:
    name = "shelves"

    def places_of(self, name: str) -> tuple[str, ...]:
        return ("cabinet_kitchen",) if name == "mug" else ()


class TestShelves(PlaceSourceContract):
    @pytest.fixture
    def source_bench(self) -> SourceBench:
        return SourceBench(Shelves(), "mug", ("cabinet_kitchen",))
