"""Evaluates a detector in scenes that it was not trained on: `python -m sim.learning evaluate`.

Renders scenes from seeds that training must not use, and prints a report in Markdown; `--picture`
draws the confusion matrix. `--validation` uses other seeds, for choosing between networks, so that
the test scenes have no influence on the choice.
"""

import argparse
import os
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import islice
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from executive.errors import InputError
from executive.perception.detector import LEARNED, LEAST_CONFIDENCE, Found, OnnxDetector
from executive.perception.pipeline import locate
from executive.perception.segmentation import segment
from executive.terminal import show_over
from executive.text import printable
from executive.types.perception import Box, Detection, Frame
from sim.learning.frames import EVALUATION_SEED, VALIDATION_SEED, class_names
from sim.learning.metrics import ClassReport, Ints, Judged, by_class, confusion, match
from sim.learning.scenes import Scene, SceneMaker
from sim.manipulation.registration import fit_pose
from sim.objects.objects import load_objects

LEAST_REPORTED = 0.02
"""Least confidence of boxes for average precision."""
LOCATED = 1
"""Number of objects in each scene, the most confident ones, whose position error is measured."""
TIMED = 40
"""Number of pictures over which the time per picture is measured."""


@dataclass(frozen=True, slots=True)
class Judgement:
    """The result of one scene: detections and truth, and position errors of some objects (mm)."""

    picture: Judged
    errors_mm: tuple[float, ...]


def judge(detector: OnnxDetector, scene: Scene) -> Judgement:
    """Run the detector on a scene."""
    color = scene.photograph()
    found = detector.find(color, LEAST_REPORTED)
    picture = _judged(found, detector.names, scene)
    frame = Frame(scene.seed, color, scene.frame.depth, scene.frame.intrinsics, scene.frame.pose)
    return Judgement(picture, tuple(islice(_errors(picture, frame, scene), LOCATED)))


def _judged(found: Found, names: Sequence[str], scene: Scene) -> Judged:
    """Detections and truth with our class indices; detections of other classes are left out."""
    numbers = {name: number for number, name in enumerate(class_names())}
    ours = np.array([numbers.get(name, -1) for name in names], np.int64)[found.classes]
    truths = scene.truths
    edges = [(b.left, b.top, b.left + b.width, b.top + b.height) for b in (t.box for t in truths)]
    return Judged(
        found.boxes[ours >= 0].astype(np.float64),
        found.scores[ours >= 0].astype(np.float64),
        ours[ours >= 0],
        np.array(edges, np.float64).reshape(-1, 4),
        np.array([numbers[truth.name] for truth in truths], np.int64),
        np.array([truth.counts for truth in truths], np.bool_),
    )


def _errors(picture: Judged, frame: Frame, scene: Scene) -> Iterator[float]:
    """The horizontal position error (mm) of each object found, located by the depth in its box."""
    height, width = frame.depth.shape
    for edges, score, thing in zip(picture.boxes, picture.scores, match(picture), strict=True):
        if thing < 0 or score < LEAST_CONFIDENCE or not picture.counts[thing]:
            continue
        left, top = np.floor(edges[:2].clip(0, (width, height))).astype(int).tolist()
        right, bottom = np.ceil(edges[2:].clip(0, (width, height))).astype(int).tolist()
        box = Box(left, top, right - left, bottom - top)
        truth = scene.truths[thing]
        seen = locate(Detection(truth.name, score, box, segment(frame, box)), frame)
        points, eye = np.asarray(seen.points, np.float64), np.asarray(frame.pose.position)
        pose = fit_pose(load_objects()[truth.name], points, eye)
        off = np.subtract(pose.position, truth.pose.position)
        yield 1000 * float(np.hypot(off[0], off[1]))


# --- the scenes, in processes of their own ---


def judge_all(path: Path, seeds: range, workers: int) -> Iterator[Judgement]:
    """Judge the scenes of these seeds, in their order, in worker processes."""
    with get_context("spawn").Pool(workers) as pool:
        yield from pool.imap(_judge_seed, ((path, seed) for seed in seeds), chunksize=2)


def _judge_seed(job: tuple[Path, int]) -> Judgement:
    path, seed = job
    return judge(_detector(path), _maker()[0].make(seed))


@cache
def _detector(path: Path) -> OnnxDetector:
    """This process' detector, on one thread, because other processes use the other cores."""
    return OnnxDetector(path, lambda name: (name,), threads=1)


@cache
def _maker() -> tuple[SceneMaker, tempfile.TemporaryDirectory[str]]:
    """This process' simulator, and the folder of its patterns."""
    folder = tempfile.TemporaryDirectory()
    return SceneMaker(load_objects(), Path(folder.name)), folder


# --- the report ---


def report(judgements: Sequence[Judgement], milliseconds: float, about: str) -> str:
    """The report, in Markdown."""
    pictures = [judgement.picture for judgement in judgements]
    classes = by_class(pictures, len(class_names()), LEAST_CONFIDENCE)
    errors = np.array([error for one in judgements for error in one.errors_mm])
    asked = [one for one in classes if one.asked]
    recalls = np.array([one.recall for one in asked])
    lines = [
        f"{about}: {len(pictures)} scenes, {sum(one.asked for one in classes)} things",
        "",
        "| what | figure |",
        "|---|---|",
        f"| mAP at IoU 0.5 | {np.mean([one.average_precision for one in asked]):.3f} |",
        f"| recall, all things, at confidence {LEAST_CONFIDENCE} | {_recall(classes):.3f} |",
        f"| recall of the worst class | {recalls.min():.3f} |",
        f"| classes with a recall of at least 0.9 | {(recalls >= 0.9).sum()} of {len(asked)} |",
        f"| a 640 x 480 picture | {milliseconds:.0f} ms |",
        f"| position by depth, error: median | {np.median(errors):.1f} mm |",
        f"| 90 of 100 within | {np.quantile(errors, 0.9):.1f} mm |",
        "",
        "| class | asked | AP | recall | precision |",
        "|---|---|---|---|---|",
        *(
            f"| {name} | {one.asked} | {one.average_precision:.3f} | {one.recall:.3f} "
            f"| {one.precision:.3f} |"
            for name, one in zip(class_names(), classes, strict=True)
        ),
    ]
    return "\n".join(lines) + "\n"


def _recall(classes: Sequence[ClassReport]) -> float:
    asked = [one for one in classes if one.asked]
    return sum(one.recall * one.asked for one in asked) / sum(one.asked for one in asked)


def time_of_one(detector: OnnxDetector) -> float:
    """Median time (ms) of detection in a 640 x 480 picture, with all cores."""
    picture = np.random.default_rng(0).integers(0, 255, (480, 640, 3), np.uint8)
    times = []
    for _ in range(TIMED):
        began = time.perf_counter()
        detector.find(picture)
        times.append(time.perf_counter() - began)
    return 1000 * float(np.median(times))


def draw_confusion(table: Ints, names: Sequence[str]) -> str:
    """The confusion matrix as an SVG: rows are true classes, columns are predicted ones.

    Shades are fractions of the row.
    """
    labels = [*names, "nothing"]
    side, left, top = 24, 150, 150
    width = left + side * len(labels) + 10
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {width}" '
        'font-family="sans-serif" font-size="11">',
        f'<rect width="{width}" height="{width}" fill="white"/>',
    ]
    for row, name in enumerate(labels):
        y = top + row * side
        parts.append(f'<text x="{left - 6}" y="{y + 16}" text-anchor="end">{name}</text>')
        place = f"translate({left + row * side + 16} {top - 6}) rotate(-60)"
        parts.append(f'<text transform="{place}">{name}</text>')
        total = max(1, int(table[row].sum()))
        for column, count in enumerate(table[row]):
            share = float(count) / total
            blue = f"rgb({255 - round(225 * share)},{255 - round(160 * share)},255)"
            x = left + column * side
            parts.append(
                f'<rect x="{x}" y="{y}" width="{side}" height="{side}" '
                f'fill="{blue if count else "white"}" stroke="#ddd"/>'
            )
            if count:
                ink = "white" if share > 0.6 else "black"
                parts.append(
                    f'<text x="{x + side / 2}" y="{y + 16}" text-anchor="middle" '
                    f'font-size="9" fill="{ink}">{count}</text>'
                )
    return "\n".join([*parts, "</svg>"]) + "\n"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of `python -m sim.learning evaluate`."""
    parser.add_argument("--detector", default="learned", help="learned (default), or a FILE.onnx")
    parser.add_argument("--scenes", type=int, default=500, metavar="N", help="default: 500")
    parser.add_argument("--validation", action="store_true", help="scenes to choose a network by")
    parser.add_argument(
        "--workers",
        type=int,
        default=os.cpu_count(),
        metavar="N",
        help="default: one for each core",
    )
    parser.add_argument("--picture", type=Path, metavar="FILE.svg", help="draw confusions")


def evaluate(options: argparse.Namespace) -> None:
    """Judge a detector, and print the report.

    Raises:
        InputError: if the detector's file cannot be read, or the picture cannot be written.
    """
    path = LEARNED if options.detector == "learned" else Path(options.detector)
    milliseconds = time_of_one(OnnxDetector(path, lambda name: (name,)))
    first = VALIDATION_SEED if options.validation else EVALUATION_SEED
    seeds, judgements = range(first, first + options.scenes), []
    for judgement in judge_all(path, seeds, options.workers):
        judgements.append(judgement)
        show_over(f"{len(judgements)} of {options.scenes} scenes")
    print(file=sys.stderr)
    print(report(judgements, milliseconds, printable(path.name)), end="")
    if options.picture:
        pictures = [one.picture for one in judgements]
        table = confusion(pictures, len(class_names()), LEAST_CONFIDENCE)
        _write(options.picture, draw_confusion(table, class_names()))


def _write(path: Path, text: str) -> None:
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        right = "give a file in a folder that exists"
        raise InputError(f"--picture {path}", f"cannot write: {error.strerror}", right) from None
