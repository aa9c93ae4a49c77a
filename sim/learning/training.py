"""Training the detector: `python -m sim.train FRAMES` (needs the `train` extra).

Reads the frames of `python -m sim.frames`, writes checkpoints and, at the end, an ONNX file with the
class names in its metadata. The same command goes on from the last checkpoint.
"""

import argparse
import copy
import json
import sys
import time
from pathlib import Path

import numpy as np
import onnx
import torch
from torch import Tensor, nn

from executive.errors import ExecutiveError, InputError
from sim.learning.crops import SIDE, batches
from sim.learning.frames import class_names, shards
from sim.learning.loss import loss
from sim.learning.network import Exported, Network, boxes_of, cells, flatten

WARM_UP = 0.02
"""Share of the training in which the rate of learning rises; then it falls as a cosine."""
DECAY = 0.02
SMOOTHING = 0.998
"""Share that a step leaves of the averaged weights, which are what is exported."""
SAVE_S = 120.0
SAY_STEPS = 50
HEIGHT, WIDTH = 480, 640


class Trainer:
    """The network with all that is needed to go on training it."""

    def __init__(self, steps: int, rate: float) -> None:
        """Plan for so many steps in all, the highest rate of learning being `rate`."""
        self.network = Network(len(class_names())).to(memory_format=torch.channels_last)
        self.average = copy.deepcopy(self.network).eval()
        self.optimizer = torch.optim.AdamW(_groups(self.network), lr=rate)
        self.steps, self.rate, self.step = steps, rate, 0
        self._middles, self._strides = cells(SIDE, SIDE)

    def learn(self, pictures: Tensor, wanted: list) -> float:
        """Make one step; returns the loss."""
        for group in self.optimizer.param_groups:
            group["lr"] = self.rate * self._schedule()
        with torch.autocast("cpu", torch.bfloat16):
            maps = self.network(pictures)
        distances, logits = flatten([one.float() for one in maps])
        wrong = loss(boxes_of(distances, self._middles, self._strides), logits, self._middles, wanted)
        self.optimizer.zero_grad()
        wrong.backward()
        nn.utils.clip_grad_norm_(self.network.parameters(), 10.0)
        self.optimizer.step()
        self.step += 1
        self._follow()
        return float(wrong.detach())

    def _schedule(self) -> float:
        """Share of the highest rate at this step."""
        done = self.step / self.steps
        if done < WARM_UP:
            return (done + 1e-4) / WARM_UP
        return float(0.01 + 0.99 * (1 + np.cos(np.pi * (done - WARM_UP) / (1 - WARM_UP))) / 2)

    @torch.no_grad()
    def _follow(self) -> None:
        """Let the averaged weights follow the trained ones, faster at the beginning."""
        keep = min(SMOOTHING, (1 + self.step) / (20 + self.step))
        trained = self.network.state_dict()
        for name, value in self.average.state_dict().items():
            if value.dtype.is_floating_point:
                value.lerp_(trained[name], 1 - keep)
            else:
                value.copy_(trained[name])

    def save(self, path: Path) -> None:
        """Write a checkpoint; a killed run leaves the one before."""
        beside = path.with_suffix(".new")
        state = {
            "step": self.step,
            "network": self.network.state_dict(),
            "average": self.average.state_dict(),
            "optimizer": self.optimizer.state_dict(),
        }
        torch.save(state, beside)
        beside.rename(path)

    def load(self, path: Path, weights_only: bool = False) -> None:
        """Go on from a checkpoint, or only start with its weights."""
        state = torch.load(path)
        self.network.load_state_dict(state["average" if weights_only else "network"])
        self.average.load_state_dict(state["average"])
        if not weights_only:
            self.optimizer.load_state_dict(state["optimizer"])
            self.step = state["step"]


def _groups(network: nn.Module) -> list[dict]:
    """Weights of convolutions decay, biases and normalisations do not."""
    decaying = [p for p in network.parameters() if p.ndim > 1]
    others = [p for p in network.parameters() if p.ndim <= 1]
    return [
        {"params": decaying, "weight_decay": DECAY},
        {"params": others, "weight_decay": 0.0},
    ]


def export(network: Network, path: Path) -> None:
    """Write the ONNX file, its class names in the metadata as Ultralytics' files have them."""
    model = Exported(copy.deepcopy(network).float(), HEIGHT, WIDTH).eval()
    picture = torch.zeros(1, 3, HEIGHT, WIDTH)
    torch.onnx.export(
        model, (picture,), str(path), input_names=["images"], output_names=["output0"], dynamo=False
    )
    graph = onnx.load(path)
    names = dict(enumerate(class_names()))
    graph.metadata_props.add(key="names", value=json.dumps(names))
    onnx.checker.check_model(graph)
    onnx.save(graph, path)


def train(options: argparse.Namespace) -> None:
    """Train, say how it goes, and export."""
    shards(options.folder)
    steps = options.crops // options.batch
    trainer = Trainer(steps, options.rate)
    if options.checkpoint.exists():
        trainer.load(options.checkpoint)
        print(f"going on from step {trainer.step} of {steps}", flush=True)
    elif options.start:
        trainer.load(options.start, weights_only=True)
    chance = np.random.default_rng((options.seed, trainer.step))
    torch.manual_seed(options.seed)
    began = saved = time.monotonic()
    losses: list[float] = []
    first = trainer.step
    source = batches(options.folder, options.batch, chance)
    while trainer.step < steps:
        losses.append(trainer.learn(*next(source)))
        if trainer.step % SAY_STEPS == 0:
            pace = (trainer.step - first) * options.batch / (time.monotonic() - began)
            print(
                f"step {trainer.step} of {steps}, loss {np.mean(losses[-SAY_STEPS:]):.3f}, "
                f"{pace:.0f} crops/s, {(steps - trainer.step) * options.batch / pace / 60:.0f} min left",
                flush=True,
            )
        if time.monotonic() - saved > SAVE_S:
            trainer.save(options.checkpoint)
            saved = time.monotonic()
    trainer.save(options.checkpoint)
    export(trainer.average, options.out)
    print(options.out)


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns its exit status."""
    parser = argparse.ArgumentParser(prog="python -m sim.train", description=__doc__)
    parser.add_argument("folder", type=Path, help="the frames of python -m sim.frames")
    parser.add_argument("--out", type=Path, default=Path("detector.onnx"))
    parser.add_argument("--checkpoint", type=Path, default=Path("detector.pt"))
    parser.add_argument("--start", type=Path, help="checkpoint whose weights to start with")
    parser.add_argument("--crops", type=int, default=600_000, help="to learn from, in all")
    parser.add_argument("--batch", type=int, default=32)
    parser.add_argument("--rate", type=float, default=2e-3)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--threads", type=int, default=torch.get_num_threads())
    options = parser.parse_args(arguments)
    torch.set_num_threads(options.threads)
    try:
        train(options)
    except ExecutiveError as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("stopped; the same command goes on from the last checkpoint", file=sys.stderr)
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
