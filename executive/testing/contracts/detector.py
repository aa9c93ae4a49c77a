"""The contract of every Detector. An adapter's tests subclass `DetectorContract`.

Provide a fixture `detector_bench` that yields a `DetectorBench`: the detector, and a picture in
which it should recognise something.
"""

from collections.abc import Collection
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
import pytest

from executive.interfaces.perception import Detector
from executive.types.perception import Detection, Frame


@dataclass
class DetectorBench:
    """A detector, a picture, and the expected labels.

    Attributes:
        detector: the detector under test.
        frame: a picture with some object.
        shows: labels that the detector should find in it, at least.
        objects: the ontology's names, to which all labels belong.
    """

    detector: Detector
    frame: Frame
    shows: Collection[str]
    objects: Collection[str]


class DetectorContract:
    """Each method tests one requirement of `Detector` and of `Detection`."""

    @pytest.fixture
    def found(self, detector_bench: DetectorBench) -> tuple[Detection, ...]:
        return detector_bench.detector.detect(detector_bench.frame)

    def test_it_recognises_what_the_picture_shows(
        self, detector_bench: DetectorBench, found: tuple[Detection, ...]
    ) -> None:
        assert {detection.label for detection in found} >= set(detector_bench.shows)

    def test_labels_are_the_ontologys(
        self, detector_bench: DetectorBench, found: tuple[Detection, ...]
    ) -> None:
        assert {detection.label for detection in found} <= set(detector_bench.objects)

    def test_the_surest_comes_first(self, found: tuple[Detection, ...]) -> None:
        confidences = [detection.confidence for detection in found]
        assert confidences == sorted(confidences, reverse=True)
        assert all(0.0 <= confidence <= 1.0 for confidence in confidences)

    def test_boxes_lie_in_the_picture(
        self, detector_bench: DetectorBench, found: tuple[Detection, ...]
    ) -> None:
        height, width = detector_bench.frame.color.shape[:2]
        for box in (detection.box for detection in found):
            assert box.width > 0
            assert box.height > 0
            assert 0 <= box.left <= width - box.width
            assert 0 <= box.top <= height - box.height

    def test_a_mask_fills_its_box_and_covers_something(self, found: tuple[Detection, ...]) -> None:
        for detection in found:
            assert detection.mask.dtype == np.bool_
            assert detection.mask.shape == (detection.box.height, detection.box.width)
            assert detection.mask.any()

    def test_the_picture_is_only_read(self, detector_bench: DetectorBench) -> None:
        color, depth = detector_bench.frame.color.copy(), detector_bench.frame.depth.copy()
        detector_bench.detector.detect(detector_bench.frame)
        assert np.array_equal(detector_bench.frame.color, color)
        assert np.array_equal(detector_bench.frame.depth, depth)

    def test_the_same_picture_shows_the_same_on_whatever_thread(
        self, detector_bench: DetectorBench, found: tuple[Detection, ...]
    ) -> None:
        with ThreadPoolExecutor(1) as other:
            again = other.submit(detector_bench.detector.detect, detector_bench.frame).result()
        assert [(d.label, d.box) for d in again] == [(d.label, d.box) for d in found]
