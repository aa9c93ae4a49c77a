"""The contract of every Perception. An adapter's tests subclass `PerceptionContract`.

Provide a fixture `perception_bench` that yields a `PerceptionBench`: a perception on a robot at
rest that looks at something it should recognise.
"""

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from executive.events import Inbox
from executive.interfaces.perception import Perception
from executive.testing.contracts.requests import end_of, is_silent
from executive.types.results import Saw


@dataclass
class PerceptionBench:
    """A perception, the inbox where its requests end, and the labels that it should find."""

    perception: Perception
    inbox: Inbox
    shows: Collection[str]

    def look(self) -> Saw:
        """Take a picture, and wait for the result."""
        result = end_of(self.inbox, self.perception.see())
        assert isinstance(result, Saw), result
        return result


class PerceptionContract:
    """Each method tests one requirement of `Perception` and of `Saw`."""

    def test_it_sees_what_is_there(self, perception_bench: PerceptionBench) -> None:
        labels = {detection.label for detection in perception_bench.look().detections}
        assert labels >= set(perception_bench.shows)

    def test_it_says_where_things_are_in_space(self, perception_bench: PerceptionBench) -> None:
        for detection in perception_bench.look().detections:
            assert detection.points.ndim == 2
            assert detection.points.shape[1] == 3
            assert np.isfinite(detection.points).all()
            assert detection.position is not None

    def test_the_surest_comes_first(self, perception_bench: PerceptionBench) -> None:
        confidences = [d.confidence for d in perception_bench.look().detections]
        assert confidences == sorted(confidences, reverse=True)

    def test_pictures_are_numbered_upwards(self, perception_bench: PerceptionBench) -> None:
        numbers = [perception_bench.look().frame_number for _ in range(3)]
        assert numbers[0] >= 0
        assert numbers == sorted(set(numbers))

    def test_every_request_has_its_own_number_and_ends_once(
        self, perception_bench: PerceptionBench
    ) -> None:
        first = perception_bench.perception.see()
        end_of(perception_bench.inbox, first)
        second = perception_bench.perception.see()
        end_of(perception_bench.inbox, second)
        assert first != second
        assert is_silent(perception_bench.inbox)

    def test_the_end_of_a_cancelled_picture_is_not_delivered(
        self, perception_bench: PerceptionBench
    ) -> None:
        perception_bench.perception.cancel(perception_bench.perception.see())
        assert is_silent(perception_bench.inbox)

    def test_after_a_cancelled_picture_it_sees_on(self, perception_bench: PerceptionBench) -> None:
        perception_bench.perception.cancel(perception_bench.perception.see())
        assert perception_bench.look().frame_number >= 0

    def test_cancelling_what_has_ended_or_never_was_does_nothing(
        self, perception_bench: PerceptionBench
    ) -> None:
        request = perception_bench.perception.see()
        end_of(perception_bench.inbox, request)
        perception_bench.perception.cancel(request)
        perception_bench.perception.cancel(request + 1000)
        assert perception_bench.look().frame_number >= 0
