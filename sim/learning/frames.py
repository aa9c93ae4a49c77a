"""Renders pictures for training, and stores them in shards.

A shard is a Parquet file. If a run is stopped, its finished shards stay, and the next run into the
same folder makes the missing ones.
"""

import os
import tempfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from executive.errors import InputError
from executive.shell import leave_stopping_to_the_parent
from sim.learning.scenes import Scene, SceneMaker
from sim.objects.objects import ObjectModel, load_objects
from sim.objects.ycb import with_scans

SHARD = 50
"""Number of pictures in a shard."""
SHAPE = (480, 640, 3)
VALIDATION_SEED = 9_000_000
"""Seeds from here on are for choosing between networks; they are not for training."""
EVALUATION_SEED = 10_000_000
"""Seeds from here on are only for evaluating the chosen network."""


@dataclass(frozen=True, slots=True, eq=False)
class Example:
    """A picture and its boxes.

    Attributes:
        color: (480, 640, 3) uint8, RGB, without the camera's flaws.
        boxes: (n, 4) float32: left, top, right, bottom (pixels).
        classes: (n,) int64, indices into `class_names()`.
        counts: (n,) bool, whether a detector should find each object.
    """

    color: NDArray[np.uint8]
    boxes: NDArray[np.float32]
    classes: NDArray[np.int64]
    counts: NDArray[np.bool_]


def class_names() -> tuple[str, ...]:
    """The names of the classes, in the order of the network's outputs."""
    return tuple(sorted(load_objects()))


def make_shards(
    folder: Path, frames: int, seed: int, workers: int, ycb: Path | None = None
) -> Iterator[Path]:
    """Make the missing shards; yields the path of each when it is done.

    Args:
        folder: of the shards.
        frames: number of pictures.
        seed: of the first picture; the others have the following seeds.
        workers: number of processes.
        ycb: folder of YCB scans to draw instead of our meshes.

    Raises:
        InputError: if the folder cannot be written, or the seeds are not for training.
    """
    if seed < 0 or seed + frames > VALIDATION_SEED:
        right = f"give seeds below {VALIDATION_SEED}: the others are for judging"
        raise InputError("--seed", f"cannot train on seeds {seed} to {seed + frames - 1}", right)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(str(folder), f"cannot be made: {error.strerror}", "name another") from None
    starts = range(seed, seed + frames, SHARD)
    models = with_scans(load_objects(), ycb) if ycb else load_objects()
    jobs = [
        (folder / f"{start:08d}.parquet", start, min(SHARD, seed + frames - start), models)
        for start in starts
    ]
    missing = [job for job in jobs if not job[0].exists()]
    with get_context("spawn").Pool(workers, leave_stopping_to_the_parent) as pool:
        yield from pool.imap_unordered(_make_shard, missing)


def _make_shard(job: tuple[Path, int, int, Mapping[str, ObjectModel]]) -> Path:
    path, start, count, models = job
    with tempfile.TemporaryDirectory() as directory:
        maker = SceneMaker(models, Path(directory))
        rows = [_row(maker.make(seed)) for seed in range(start, start + count)]
        maker.close()
    beside = path.with_suffix(f".{os.getpid()}")
    pq.write_table(pa.Table.from_pylist(rows), beside, compression="zstd", compression_level=6)
    beside.rename(path)
    return path


def _row(scene: Scene) -> dict[str, object]:
    numbers = {name: number for number, name in enumerate(class_names())}
    return {
        "seed": scene.seed,
        "color": scene.frame.color.tobytes(),
        "classes": [numbers[truth.name] for truth in scene.truths],
        "boxes": [
            float(edge)
            for b in (truth.box for truth in scene.truths)
            for edge in (b.left, b.top, b.left + b.width, b.top + b.height)
        ],
        "counts": [truth.counts for truth in scene.truths],
    }


def shards(folder: Path) -> tuple[Path, ...]:
    """The shards in a folder, in order of seeds.

    Raises:
        InputError: if there are none.
    """
    found = tuple(sorted(folder.glob("*.parquet")))
    if not found:
        raise InputError(
            str(folder), "there are no frames", f"run python -m sim.learning frames {folder}"
        )
    return found


def read_shard(path: Path) -> list[Example]:
    """The pictures of a shard."""
    return [
        Example(
            np.frombuffer(row["color"], np.uint8).reshape(SHAPE),
            np.array(row["boxes"], np.float32).reshape(-1, 4),
            np.array(row["classes"], np.int64),
            np.array(row["counts"], np.bool_),
        )
        for row in pq.read_table(path).to_pylist()
    ]
