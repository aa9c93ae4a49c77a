"""A learned detector: a network of the YOLO family in an ONNX file, run by OpenCV."""

import ast
import logging
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from executive.errors import InputError
from executive.files import read_text
from executive.perception.onnx_file import read_onnx
from executive.perception.onnx_trial import network, pictures, run, try_out
from executive.perception.segmentation import segment
from executive.perception.yolo import Boxes, Floats32, check_probabilities, layout_of, read
from executive.text import printable
from executive.types.perception import Box, Detection, Frame

log = logging.getLogger(__name__)

LEARNED = Path(__file__).parent / "assets" / "detector.onnx"
"""Our own, trained by `python -m sim.learning`; see docs/detector.md."""
LEAST_CONFIDENCE = 0.25
"""Detections below this confidence are not reported."""
MOST_OVERLAP = 0.5
"""IoU above which, of two boxes of one class, the one with less confidence is dropped."""
OPEN_SIDE = 640
"""Side of the input (pixels) for a network that takes any size."""
GREY = 114
"""The fill colour of letterboxing with which these networks were trained."""
_FEWEST_PIXELS = 2
"""A box with a shorter side is dropped."""
_MOST_BOXES = 2000
"""The largest number of boxes kept, those with the highest confidence."""
_MOST_CLASSES = 10_000
_LONGEST_LIST = 1_000_000
_LONGEST_WARNING = 2000
_UNIT = 1.5
"""If no coordinate is above this, boxes are in shares of the network's input, not pixels."""


@dataclass(frozen=True, slots=True, eq=False)
class Found:
    """A network's detections in one picture, in its pixels, the highest confidence first.

    Attributes:
        boxes: (n, 4): left, top, right, bottom.
        scores: (n,), in [0, 1].
        classes: (n,), indices in the class list.
    """

    boxes: Floats32
    scores: Floats32
    classes: NDArray[np.int64]


class OnnxDetector:
    """Implements Detector."""

    def __init__(
        self,
        path: Path,
        objects_named: Callable[[str], Sequence[str]],
        *,
        threads: int | None = None,
    ) -> None:
        """Load the network and its class list.

        The class list is in FILE.names or FILE.txt beside FILE.onnx, one name per line, or in the
        file's metadata as `names`.

        Args:
            path: the ONNX file.
            objects_named: the ontology's objects for the name of a class.
            threads: number of OpenCV's threads in this process; None: OpenCV's default.

        Raises:
            InputError: if the file or its class list is wrong, or OpenCV cannot run the network.
        """
        if threads is not None:
            cv2.setNumThreads(threads)
        about = read_onnx(path)
        self._path = path
        self._names = class_list(path, about.metadata)
        self._height, self._width = about.height or OPEN_SIDE, about.width or OPEN_SIDE
        self._takes_bytes = about.takes_bytes
        if path != LEARNED and (
            fault := try_out(about.content, self._height, self._width, self._takes_bytes)
        ):
            right = "export it for one picture, in 32 bits, with another opset"
            raise InputError(str(path), fault, right)
        self._network = network(about.content)
        self._labels = _labels(path, self._names, objects_named)
        self._learn_layout(about.metadata)

    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        """All known objects in the picture, highest confidence first, with masks from depth.

        An object is known if the ontology has exactly one for the name of its class.

        Raises:
            InputError: as `find`.
        """
        found = self.find(frame.color)
        return tuple(
            Detection(label, float(score), box, segment(frame, box))
            for edges, score, number in zip(found.boxes, found.scores, found.classes, strict=True)
            if (label := self._labels[number]) and (box := _whole_pixels(edges, frame))
        )

    def find(self, color: NDArray[np.uint8], least: float = LEAST_CONFIDENCE) -> Found:
        """All detections in a picture (h, w, 3; RGB) of at least this confidence, without masks.

        Raises:
            InputError: if OpenCV cannot run the network on it, or the output has changed its
                layout.
        """
        picture, scale, (left, top) = letterbox(color, self._height, self._width)
        rows = self._layout.rows(self._run(picture), str(self._path))
        boxes = surest(read(rows, self._layout, len(self._names)), least)
        found = boxes if self._layout.kind == "ended" else suppress(boxes, least)
        size = np.array([self._width, self._height] * 2, np.float32)
        corners = found.corners * size if found.corners.max(initial=0) <= _UNIT else found.corners
        shift = np.array([left, top, left, top], np.float32)
        return Found((corners - shift) / scale, found.scores, found.classes)

    @property
    def names(self) -> tuple[str, ...]:
        """The class list."""
        return self._names

    @property
    def labels(self) -> frozenset[str]:
        """The labels that detections may have: objects of the ontology."""
        return frozenset(label for label in self._labels if label)

    def _learn_layout(self, metadata: Mapping[str, str]) -> None:
        """Find the layout of the output by running the network on two pictures."""
        where, classes = str(self._path), len(self._names)
        for picture in reversed(pictures(self._height, self._width)):
            outputs = self._run(picture)
            self._layout = layout_of(outputs, classes, metadata, where)
            check_probabilities(self._layout.rows(outputs, where), self._layout, classes, where)

    def _run(self, picture: NDArray[np.uint8]) -> list[Floats32]:
        """Run the network; return all outputs."""
        try:
            return run(self._network, picture, self._takes_bytes)
        except cv2.error as error:
            raise InputError(
                str(self._path), f"OpenCV cannot run it: {error.err}", "export it for one picture"
            ) from None


def class_list(path: Path, metadata: Mapping[str, str]) -> tuple[str, ...]:
    """The names of the network's classes, from a file beside it or from its metadata.

    Raises:
        InputError: if there is no class list, or it is malformed.
    """
    right = f"put a name a line into {path.with_suffix('.names')}"
    for beside in (path.with_suffix(".names"), path.with_suffix(".txt")):
        if beside.exists():
            lines = read_text(beside, right=right).splitlines()
            names = tuple(line.strip() for line in lines if line.strip())
            if not 0 < len(names) <= _MOST_CLASSES:
                raise InputError(str(beside), f"names {len(names)} classes", right)
            return names
    text = metadata.get("names")
    if text is None:
        raise InputError(str(path), "says nothing of its classes", right)
    try:
        listed = ast.literal_eval(text[:_LONGEST_LIST])
        if isinstance(listed, dict):
            numbered = {int(number): name for number, name in listed.items()}
            listed = [numbered[number] for number in range(len(listed))]
        if not isinstance(listed, list | tuple) or not 0 < len(listed) <= _MOST_CLASSES:
            raise ValueError
        if not all(isinstance(name, str) for name in listed):
            raise ValueError
    except (
        ValueError,
        SyntaxError,
        TypeError,
        LookupError,
        OverflowError,
        MemoryError,
        RecursionError,
    ):
        raise InputError(str(path), f"its metadata's names are {text[:80]!r}", right) from None
    return tuple(listed)


def _labels(
    path: Path, names: Sequence[str], objects_named: Callable[[str], Sequence[str]]
) -> tuple[str | None, ...]:
    """The ontology's object for each class; None if there is none, or more than one.

    Raises:
        InputError: if the ontology knows none of the classes, or two that it knows have one name.
    """
    known = [objects_named(name) for name in names]
    labels = tuple(objects[0] if len(objects) == 1 else None for objects in known)
    unknown = [name for name, label in zip(names, labels, strict=True) if label is None]
    if len(unknown) == len(names):
        some = ", ".join(unknown[:5])
        right = "names should be objects of the ontology (python -m kb show)"
        raise InputError(str(path), f"the ontology knows none of its classes ({some}, ...)", right)
    called = Counter(name for name, label in zip(names, labels, strict=True) if label)
    if twice := [name for name, count in called.items() if count > 1]:
        right = f"give each a name of its own in {path.with_suffix('.names')}"
        raise InputError(str(path), f"has several classes that are called {twice[0]!r}", right)
    if unknown:
        told = printable(f"{path}: not in the ontology, and ignored: {', '.join(unknown)}")
        log.warning("%s", told[:_LONGEST_WARNING])
    return labels


def letterbox(
    color: NDArray[np.uint8], height: int, width: int
) -> tuple[NDArray[np.uint8], float, tuple[int, int]]:
    """Fit the picture into (height, width); return it, its scale, and its left and top offset."""
    rows, columns = color.shape[:2]
    scale = min(height / rows, width / columns)
    size = (round(columns * scale), round(rows * scale))
    fitted = color if scale == 1 else cv2.resize(color, size, interpolation=cv2.INTER_AREA)
    left, top = (width - size[0]) // 2, (height - size[1]) // 2
    filled = np.full((height, width, 3), GREY, np.uint8)
    filled[top : top + size[1], left : left + size[0]] = fitted
    return filled, scale, (left, top)


def surest(boxes: Boxes, least: float) -> Boxes:
    """The boxes of at least this confidence, highest first, at most `_MOST_BOXES`."""
    order = np.argsort(-boxes.scores, kind="stable")[:_MOST_BOXES]
    order = order[boxes.scores[order] >= least]
    scores = boxes.scores[order].clip(0.0, 1.0)
    return Boxes(boxes.corners[order], scores, boxes.classes[order])


def suppress(boxes: Boxes, least: float) -> Boxes:
    """Non-maximum suppression, class by class: the boxes that are left, highest score first."""
    sides = boxes.corners[:, 2:] - boxes.corners[:, :2]
    kept = cv2.dnn.NMSBoxesBatched(
        np.concatenate((boxes.corners[:, :2], sides), axis=1).tolist(),
        boxes.scores.tolist(),
        boxes.classes.tolist(),
        least,
        MOST_OVERLAP,
    )
    order = np.array(sorted(kept, key=lambda index: -boxes.scores[index]), np.int64)
    return Boxes(boxes.corners[order], boxes.scores[order], boxes.classes[order])


def _whole_pixels(edges: Floats32, frame: Frame) -> Box | None:
    """The box in whole pixels, clipped to the picture; None if it is too small then."""
    height, width = frame.color.shape[:2]
    left, top = np.floor(np.clip(edges[:2], 0, (width, height))).astype(int).tolist()
    right, bottom = np.ceil(np.clip(edges[2:], 0, (width, height))).astype(int).tolist()
    if min(right - left, bottom - top) < _FEWEST_PIXELS:
        return None
    return Box(left, top, right - left, bottom - top)
