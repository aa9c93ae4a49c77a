"""A detector of one's own: this one knows things by the colour of a tag.

A detector is one method: a picture in, what is recognised out, surest first. Where the thing is in
the home is none of its business: that is found in the depth (`CameraPerception`).

    python docs/examples/own_detector.py

It is tried here on the instant world's pictures, in which a thing is a square in a colour of its
own. With a real camera, `CameraPerception(camera, TagDetector(tags), inbox, recorder)` is the
perception of an embodiment of one's own (docs/own-robot.md). A network in an ONNX file needs no
code at all: `--detector FILE.onnx` (docs/detector.md).
"""

from collections.abc import Mapping

import numpy as np

from executive import Box, Detection, Frame, Outcome
from executive.testing.bench import run_mission

RGB = tuple[int, int, int]


class TagDetector:
    """Implements `Detector`: a thing is where the picture has the colour of its tag."""

    def __init__(self, tags: Mapping[str, RGB]) -> None:
        """Say which colour which object has; names are as in the ontology."""
        self._tags = tags

    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        """What is in the picture, surest first. It may take its time: it runs on its own thread."""
        found = [self._find(name, tag, frame) for name, tag in self._tags.items()]
        seen = [detection for detection in found if detection]
        return tuple(sorted(seen, key=lambda detection: -detection.confidence))

    def _find(self, name: str, tag: RGB, frame: Frame) -> Detection | None:
        match = (frame.color == tag).all(axis=2)
        if not match.any():
            return None
        rows, columns = np.nonzero(match)
        top, left = int(rows.min()), int(columns.min())
        height, width = int(rows.max()) - top + 1, int(columns.max()) - left + 1
        mask = match[top : top + height, left : left + width]
        return Detection(name, float(mask.mean()), Box(left, top, width, height), mask)


def find(words: str) -> Outcome:
    """One mission in which the robot sees with this detector alone."""
    tags = {name: tag(name) for name in ("apple", "hammer", "mug")}
    return run_mission(words, detector=lambda world: TagDetector(tags)).outcome


def tag(name: str) -> RGB:
    """The colour in which the instant world draws a thing: the first letters of its name."""
    red, green, blue = name.encode().ljust(3)[:3]
    return red, green, blue


if __name__ == "__main__":
    print(find("Find the hammer").reason)
    print(find("Find the pear").reason, "(a pear has no tag)")
