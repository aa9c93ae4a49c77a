"""The contract of every PlaceSource. An adapter's tests subclass `PlaceSourceContract`.

Provide a fixture `source_bench` that yields a `SourceBench`.
"""

from dataclasses import dataclass

import pytest

from executive.interfaces.knowledge import PlaceSource


@dataclass
class SourceBench:
    """A source, a thing that it knows, and the thing's place according to it."""

    source: PlaceSource
    knows: str
    places: tuple[str, ...]


class PlaceSourceContract:
    """Each method tests one requirement of `PlaceSource`."""

    def test_its_name_is_a_word(self, source_bench: SourceBench) -> None:
        assert source_bench.source.name.isidentifier()

    def test_it_is_told_of_in_a_clause(self, source_bench: SourceBench) -> None:
        says = source_bench.source.says
        assert says.strip() == says != ""
        assert not says.endswith(".")

    def test_it_says_where_a_thing_is_and_says_it_again(self, source_bench: SourceBench) -> None:
        for _ in range(2):
            assert tuple(source_bench.source.places_of(source_bench.knows)) == source_bench.places

    @pytest.mark.parametrize("name", ["no_such_thing", "", "\udcff\n", "word " * 1000])
    def test_of_what_it_does_not_know_it_says_nothing(
        self, source_bench: SourceBench, name: str
    ) -> None:
        assert not source_bench.source.places_of(name)
