"""Teaching the detector: `frames` renders what it learns from, `train` makes an ONNX file of it.

`evaluate` says how good a detector is in scenes that it never learned from.
"""

from executive.start import begin

if __name__ == "__main__":
    begin()

import argparse
import os
import sys
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path

from executive.errors import InputError
from executive.shell import DONE, entry_point
from executive.terminal import show_over
from executive.usage import Parser
from sim.learning import evaluation
from sim.learning.frames import SHARD, make_shards


@entry_point
def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit status (0 done, 2 bad input, 130 stopped)."""
    options = parser().parse_args(arguments)
    try:
        options.run(options)
    except KeyboardInterrupt:
        print("\nstopped; the same command goes on from here", file=sys.stderr)
        raise
    return DONE


def parser() -> argparse.ArgumentParser:
    """Build the parser of the command line."""
    p = Parser(prog="python -m sim.learning", description=__doc__)
    commands = p.add_subparsers(required=True, metavar="command")
    _add_frames(commands.add_parser("frames", help="render scenes drawn by chance"))
    _add_train(commands.add_parser("train", help="train on them (needs the train extra)"))
    judged = commands.add_parser("evaluate", help="judge a detector in scenes that are new to it")
    evaluation.add_options(judged)
    judged.set_defaults(run=evaluation.evaluate)
    return p


def _add_frames(frames: argparse.ArgumentParser) -> None:
    frames.add_argument("folder", type=Path, help="where the shards go, or some are already")
    frames.add_argument("--frames", type=int, default=3000, metavar="N", help="default: 3000")
    frames.add_argument("--seed", type=int, default=0, help="of the first frame (default: 0)")
    frames.add_argument(
        "--workers",
        type=int,
        default=os.cpu_count(),
        metavar="N",
        help="default: one for each core",
    )
    frames.add_argument("--ycb", type=Path, metavar="DIR", help="scans to show instead of ours")
    frames.set_defaults(run=_frames)


def _add_train(train: argparse.ArgumentParser) -> None:
    train.add_argument("folder", type=Path, help="the frames")
    train.add_argument(
        "--out", type=Path, default=Path("detector.onnx"), help="default: %(default)s"
    )
    train.add_argument(
        "--checkpoint",
        type=Path,
        default=Path("detector.pt"),
        help="where it goes on from when stopped (default: %(default)s)",
    )
    train.add_argument("--start", type=Path, help="checkpoint whose weights to start with")
    train.add_argument(
        "--crops", type=int, default=160_000, help="to learn from, in all (default: %(default)s)"
    )
    train.add_argument("--batch", type=int, default=32, help="crops a step (default: %(default)s)")
    train.add_argument(
        "--rate", type=float, default=2e-3, help="of learning, at most (default: %(default)s)"
    )
    train.add_argument("--seed", type=int, default=0)
    train.add_argument("--threads", type=int, help="default: one for each core")
    train.set_defaults(run=_train)


def _frames(options: argparse.Namespace) -> None:
    total = -(-options.frames // SHARD)
    folder, workers = options.folder, options.workers
    for path in make_shards(folder, options.frames, options.seed, workers, options.ycb):
        done = len(list(folder.glob("*.parquet")))
        show_over(f"{done} of {total} shards, the last {path.name}")
    print(file=sys.stderr)


def _train(options: argparse.Namespace) -> None:
    if find_spec("torch") is None or find_spec("onnx") is None:
        raise InputError("train", "PyTorch and onnx are not installed", "pip install '.[train]'")
    import torch

    from sim.learning.training import Plan, train

    if options.threads:
        torch.set_num_threads(options.threads)
    plan = Plan(
        frames=options.folder,
        out=options.out,
        checkpoint=options.checkpoint,
        start=options.start,
        crops=options.crops,
        batch=options.batch,
        rate=options.rate,
        seed=options.seed,
    )
    for line in train(plan):
        print(line, flush=True)


if __name__ == "__main__":
    sys.exit(main())
