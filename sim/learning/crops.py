"""Crops of pictures for training: cheaper than whole pictures, which are mostly furniture."""

from collections.abc import Iterator
from pathlib import Path
from queue import Queue
from threading import Thread

import numpy as np
import torch
from numpy.random import Generator
from numpy.typing import NDArray
from torch import Tensor
from torch.nn import functional

from sim.learning.frames import Example, class_names, read_shard, shards
from sim.learning.loss import Wanted

SIDE = 256
"""Side of a crop (pixels)."""
SHARDS_AT_ONCE = 6
LEAST_LEFT = 0.5
"""An object counts only if at least this fraction of its box is in the crop."""
LEAST_SIDE = 3
HARD = {"adjustable_wrench": 4.0, "hammer": 3.0, "scissors": 2.0, "spatula": 3.0}
"""Long thin objects are learned slowest: crops show them this many times as often as others."""
_AT_RANDOM = 0.15
ZOOM = (0.8, 1.35)
"""Range of the random scale of half of the crops, so that fewer frames show more sizes."""
_NOISES = 24

Batch = tuple[Tensor, list[Wanted]]


def batches(folder: Path, size: int, chance: Generator) -> Iterator[Batch]:
    """Endless batches, made on a thread of their own."""
    ready: Queue[Batch | Exception] = Queue(maxsize=6)

    def make() -> None:
        try:
            for batch in _batches(folder, size, chance):
                ready.put(batch)
        except Exception as error:
            ready.put(error)

    Thread(target=make, daemon=True).start()
    while True:
        batch = ready.get()
        if isinstance(batch, Exception):
            raise batch
        yield batch


def _batches(folder: Path, size: int, chance: Generator) -> Iterator[Batch]:
    noise = torch.from_numpy(chance.normal(0.0, 1.0, (_NOISES, SIDE, SIDE, 3)).astype(np.float32))
    crops: list[Example] = []
    while True:
        order = chance.permutation(np.array(shards(folder), dtype=object))
        for start in range(0, len(order), SHARDS_AT_ONCE):
            for path in order[start : start + SHARDS_AT_ONCE]:
                for example in read_shard(path):
                    crops += _crops(example, chance)
            for index in chance.permutation(len(crops) // size * size).reshape(-1, size):
                yield _batch([crops[i] for i in index], noise, chance)
            crops = []


def _crops(example: Example, chance: Generator) -> list[Example]:
    """Random crops of a picture: most of them around objects, some from anywhere."""
    asked = np.flatnonzero(example.counts)
    weights = np.array([HARD.get(class_names()[i], 1.0) for i in example.classes[asked]])
    number = 1 + round(weights.sum() / 2)
    found = []
    for _ in range(number):
        zoom = float(np.exp(chance.uniform(*np.log(ZOOM)))) if chance.random() < 0.5 else 1.0
        side = round(SIDE / zoom)
        if len(asked) and chance.random() > _AT_RANDOM:
            box = example.boxes[chance.choice(asked, p=weights / weights.sum())]
            middle = (box[:2] + box[2:]) / 2 + chance.uniform(-0.4, 0.4, 2) * side
        else:
            middle = chance.uniform((0, 0), (640, 480))
        left, top = np.clip(middle - side / 2, 0, (640 - side, 480 - side)).astype(int)
        found.append(crop(example, int(left), int(top), side, flip=bool(chance.random() < 0.5)))
    return found


def crop(example: Example, left: int, top: int, side: int, flip: bool) -> Example:
    """A square crop with its clipped boxes, resized to SIDE pixels.

    Args:
        example: the picture.
        left: first column.
        top: first row.
        side: of the square in the picture (pixels).
        flip: whether to mirror it horizontally.
    """
    color = example.color[top : top + side, left : left + side]
    edges = example.boxes - np.array([left, top, left, top], np.float32)
    if side != SIDE:
        color = _resized(color)
        edges *= SIDE / side
    if flip:
        color = color[:, ::-1]
        edges[:, [0, 2]] = SIDE - edges[:, [2, 0]]
    boxes = edges.clip(0, SIDE)
    size, before = boxes[:, 2:] - boxes[:, :2], edges[:, 2:] - edges[:, :2]
    in_it = (size >= LEAST_SIDE).all(1)
    counts = example.counts & (size.prod(1) >= LEAST_LEFT * before.prod(1))
    return Example(color, boxes[in_it], example.classes[in_it], counts[in_it])


def _resized(color: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """The picture, resized to SIDE x SIDE pixels."""
    channels = torch.from_numpy(np.ascontiguousarray(color)).permute(2, 0, 1)[None].float()
    fitted = functional.interpolate(channels, (SIDE, SIDE), mode="bilinear")[0]
    return np.asarray(fitted.permute(1, 2, 0).round().numpy(), np.uint8)


def _batch(crops: list[Example], noise: Tensor, chance: Generator) -> Batch:
    """A batch of crops with random exposure, white balance and noise.

    The distribution is that of `sim.learning.decor.through_the_lens`.
    """
    size = len(crops)
    colors = torch.from_numpy(np.stack([one.color for one in crops]))
    gain = chance.uniform(0.72, 1.22, (size, 1)) * chance.uniform(0.94, 1.06, (size, 3)) / 255
    sigma = torch.from_numpy(chance.uniform(0.0, 6.5 / 255, size)).to(torch.float32)
    pictures = colors.float().mul_(torch.from_numpy(gain).float()[:, None, None])
    for picture, strength, which in zip(
        pictures, sigma, chance.integers(_NOISES, size=size), strict=True
    ):
        picture.add_(noise[which], alpha=float(strength))
    pictures = pictures.clamp_(0, 1).permute(0, 3, 1, 2)
    wanted = [
        Wanted(*(torch.from_numpy(a) for a in (one.boxes, one.classes, one.counts)))
        for one in crops
    ]
    return pictures, wanted
