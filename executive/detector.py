"""A learned detector: an ONNX file with the output of YOLOv5, v7 or v8, run by OpenCV."""

import ast
import logging
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from executive.errors import InputError
from executive.onnx_file import read_onnx
from executive.segmentation import segment
from executive.types import Box, Detection, Frame

log = logging.getLogger(__name__)

LEARNED = Path(__file__).parent / "assets" / "detector.onnx"
"""Our own, trained by `python -m sim.learning`; see docs/detector.md."""
LEAST_CONFIDENCE = 0.25
"""Below this, nothing is reported at all."""
MOST_OVERLAP = 0.5
"""Of two boxes of one class that overlap more (IoU), the less sure one goes."""
OPEN_SIDE = 640
"""Side of the pictures for a network that takes any."""
GREY = 114
"""What letterboxing fills up with, as these networks were trained with."""
_FEWEST_PIXELS = 2

Floats = NDArray[np.float32]


@dataclass(frozen=True, slots=True, eq=False)
class Found:
    """What a network says of one picture, in its pixels, surest first.

    Attributes:
        boxes: (n, 4): left, top, right, bottom.
        scores: (n,), in [0, 1].
        classes: (n,), indices.
    """

    boxes: Floats
    scores: Floats
    classes: NDArray[np.int64]


class OnnxDetector:
    """Implements Detector."""

    def __init__(self, path: Path, objects_named: Callable[[str], Sequence[str]]) -> None:
        """Load the network and its class list.

        The class list is in FILE.names or FILE.txt beside FILE.onnx, a name a line, or in the
        file's metadata as `names`.

        Args:
            path: the ONNX file.
            objects_named: what the ontology calls a class of the list, if it knows it.

        Raises:
            InputError: if the file or its class list is not what it should be.
        """
        about = read_onnx(path)
        self._path = path
        self._names = class_list(path, about.metadata)
        _, _, height, width = about.input
        self._height, self._width = height or OPEN_SIDE, width or OPEN_SIDE
        try:
            self._network = cv2.dnn.readNetFromONNX(str(path))
        except cv2.error as error:
            raise InputError(
                str(path), f"OpenCV cannot run it: {error.err}", "export it with a lower opset"
            ) from None
        self._labels = _labels(path, self._names, objects_named)
        self._run(np.zeros((self._height, self._width, 3), np.uint8))

    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        """All things in the picture that the ontology knows, surest first, masked by depth."""
        found = self.find(frame.color)
        return tuple(
            Detection(label, float(score), box, segment(frame, box))
            for edges, score, number in zip(found.boxes, found.scores, found.classes, strict=True)
            if (label := self._labels[number]) and (box := _whole_pixels(edges, frame))
        )

    def find(self, color: NDArray[np.uint8], least: float = LEAST_CONFIDENCE) -> Found:
        """Everything in a picture (h, w, 3; RGB) of at least this confidence, without masks."""
        picture, scale, (left, top) = letterbox(color, self._height, self._width)
        found = suppress(*decode(self._run(picture), len(self._names), str(self._path)), least)
        shift = np.array([left, top, left, top], np.float32)
        return Found((found.boxes - shift) / scale, found.scores, found.classes)

    @property
    def names(self) -> tuple[str, ...]:
        """The class list."""
        return self._names

    def _run(self, picture: NDArray[np.uint8]) -> Floats:
        """The output that is laid out as those of YOLO are."""
        self._network.setInput(cv2.dnn.blobFromImage(picture, 1 / 255))
        try:
            outputs = self._network.forward(self._network.getUnconnectedOutLayersNames())
        except cv2.error as error:
            raise InputError(
                str(self._path), f"OpenCV cannot run it: {error.err}", "export it for one picture"
            ) from None
        return fitting([np.asarray(o) for o in outputs], len(self._names), str(self._path))


def class_list(path: Path, metadata: Mapping[str, str]) -> tuple[str, ...]:
    """The names of the network's classes, from a file beside it or from its metadata.

    Raises:
        InputError: if there is no class list, or it is not a list of names.
    """
    right = f"put a name a line into {path.with_suffix('.names')}"
    for beside in (path.with_suffix(".names"), path.with_suffix(".txt")):
        if beside.exists():
            try:
                lines = beside.read_text(encoding="utf-8").splitlines()
            except (OSError, UnicodeDecodeError):
                raise InputError(str(beside), "is not a text file", "write UTF-8") from None
            names = tuple(line.strip() for line in lines if line.strip())
            if not names:
                raise InputError(str(beside), "names no class", right)
            return names
    text = metadata.get("names")
    if text is None:
        raise InputError(str(path), "says nothing of its classes", right)
    try:
        listed = ast.literal_eval(text)
        if isinstance(listed, dict):
            listed = [listed[number] for number in sorted(listed, key=int)]
        if not listed or not all(isinstance(name, str) for name in listed):
            raise ValueError
    except (ValueError, SyntaxError, TypeError):
        raise InputError(str(path), f"its metadata's names are {text[:80]!r}", right) from None
    return tuple(listed)


def _labels(
    path: Path, names: Sequence[str], objects_named: Callable[[str], Sequence[str]]
) -> tuple[str | None, ...]:
    """What the ontology calls each class; None for those that it does not know as one object."""
    known = [objects_named(name) for name in names]
    labels = tuple(objects[0] if len(objects) == 1 else None for objects in known)
    unknown = [name for name, label in zip(names, labels, strict=True) if label is None]
    if len(unknown) == len(names):
        some = ", ".join(unknown[:5])
        right = "names should be objects of the ontology (python -m kb show)"
        raise InputError(str(path), f"the ontology knows none of its classes ({some}, ...)", right)
    if unknown:
        log.warning("%s: not in the ontology, and ignored: %s", path, ", ".join(unknown))
    return labels


def letterbox(
    color: NDArray[np.uint8], height: int, width: int
) -> tuple[NDArray[np.uint8], float, tuple[int, int]]:
    """The picture fitted into (height, width), its scale, and its left and top edge there."""
    rows, columns = color.shape[:2]
    scale = min(height / rows, width / columns)
    size = (round(columns * scale), round(rows * scale))
    fitted = color if scale == 1 else cv2.resize(color, size, interpolation=cv2.INTER_AREA)
    left, top = (width - size[0]) // 2, (height - size[1]) // 2
    filled = np.full((height, width, 3), GREY, np.uint8)
    filled[top : top + size[1], left : left + size[0]] = fitted
    return filled, scale, (left, top)


def fitting(outputs: Sequence[Floats], classes: int, where: str) -> Floats:
    """The one of a network's outputs that has YOLO's layout for so many classes.

    Raises:
        InputError: if none has.
    """
    for output in outputs:
        if output.ndim == 3 and output.shape[0] == 1:
            _, rows, columns = output.shape
            if rows == 4 + classes or columns == 5 + classes:
                return output
    shapes = ", ".join(str(output.shape) for output in outputs)
    raise InputError(
        where,
        f"its output is {shapes} and its class list has {classes} names",
        f"(1, {4 + classes}, n) or (1, n, {5 + classes}) goes with them; "
        "export without suppression of overlaps",
    )


def decode(output: Floats, classes: int, where: str) -> tuple[Floats, Floats]:
    """Boxes (n, 4: left, top, right, bottom) and scores (n, classes) of an output.

    YOLOv8 and later: (1, 4 + classes, n). YOLOv5 and v7: (1, n, 5 + classes), the fifth being how
    sure it is that anything is there.
    """
    [rows] = fitting([output], classes, where)
    if len(rows) == 4 + classes:
        rows = rows.T
        scores = rows[:, 4:]
    else:
        scores = rows[:, 4:5] * rows[:, 5:]
    half = rows[:, 2:4] / 2
    return np.concatenate((rows[:, :2] - half, rows[:, :2] + half), axis=1), scores


def suppress(boxes: Floats, scores: Floats, least: float) -> Found:
    """Each cell's best class, without those that overlap a surer one of the same class."""
    classes = scores.argmax(axis=1)
    best = scores[np.arange(len(scores)), classes]
    sure = best >= least
    boxes, best, classes = boxes[sure], best[sure], classes[sure]
    corners = np.concatenate((boxes[:, :2], boxes[:, 2:] - boxes[:, :2]), axis=1)
    kept = cv2.dnn.NMSBoxesBatched(
        corners.tolist(), best.tolist(), classes.tolist(), least, MOST_OVERLAP
    )
    order = np.array(sorted(kept, key=lambda index: -best[index]), np.int64)
    return Found(boxes[order], best[order], classes[order].astype(np.int64))


def _whole_pixels(edges: Floats, frame: Frame) -> Box | None:
    """The box in whole pixels within the picture; None if nothing is left of it."""
    height, width = frame.color.shape[:2]
    left, top = np.floor(np.clip(edges[:2], 0, (width, height))).astype(int).tolist()
    right, bottom = np.ceil(np.clip(edges[2:], 0, (width, height))).astype(int).tolist()
    if min(right - left, bottom - top) < _FEWEST_PIXELS:
        return None
    return Box(left, top, right - left, bottom - top)
