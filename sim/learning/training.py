"""Trains the detector on crops of rendered frames, and exports it as an ONNX file.

The names of the classes are in the file's metadata.
"""

import copy
import json
import time
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import onnx
import torch
from torch import Tensor, nn

from sim.learning.crops import SIDE, batches
from sim.learning.frames import class_names, shards
from sim.learning.loss import Wanted, loss
from sim.learning.network import Exported, Network, boxes_of, cells, flatten

WARM_UP = 0.02
"""Fraction of the training in which the learning rate rises; after that it falls as a cosine."""
DECAY = 0.02
SMOOTHING = 0.998
"""Decay of the moving average of the weights; the averaged weights are exported."""
SAVE_S = 120.0
SAY_STEPS = 50
HEIGHT, WIDTH = 480, 640


class Trainer:
    """The network and the state of its training."""

    def __init__(self, steps: int, rate: float) -> None:
        """Train for `steps` steps in all, with the highest learning rate `rate`."""
        self.network = Network(len(class_names())).to(memory_format=torch.channels_last)
        self.average = copy.deepcopy(self.network).eval()
        self.optimizer = torch.optim.AdamW(_groups(self.network), lr=rate)
        self.steps, self.rate, self.step = steps, rate, 0
        self._middles, self._strides = cells(SIDE, SIDE)

    def learn(self, pictures: Tensor, wanted: list[Wanted]) -> float:
        """Make one step; returns the loss."""
        for group in self.optimizer.param_groups:
            group["lr"] = self.rate * self._schedule()
        with torch.autocast("cpu", torch.bfloat16):
            maps = self.network(pictures)
        distances, logits = flatten([one.float() for one in maps])
        wrong = loss(
            boxes_of(distances, self._middles, self._strides), logits, self._middles, wanted
        )
        self.optimizer.zero_grad()
        wrong.backward()
        nn.utils.clip_grad_norm_(self.network.parameters(), 10.0)
        self.optimizer.step()
        self.step += 1
        self._follow()
        return float(wrong.detach())

    def _schedule(self) -> float:
        """The learning rate at this step, as a fraction of the highest."""
        done = self.step / self.steps
        if done < WARM_UP:
            return (done + 1e-4) / WARM_UP
        return float(0.01 + 0.99 * (1 + np.cos(np.pi * (done - WARM_UP) / (1 - WARM_UP))) / 2)

    def _follow(self) -> None:
        """Update the moving average of the weights, which is faster at the beginning."""
        keep = min(SMOOTHING, (1 + self.step) / (20 + self.step))
        trained = self.network.state_dict()
        with torch.no_grad():
            for name, value in self.average.state_dict().items():
                if value.dtype.is_floating_point:
                    value.lerp_(trained[name], 1 - keep)
                else:
                    value.copy_(trained[name])

    def save(self, path: Path) -> None:
        """Write a checkpoint atomically; if the process is killed, the old one stays."""
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
        """Load a checkpoint; with `weights_only`, begin a new training with its weights."""
        state = torch.load(path)
        self.network.load_state_dict(state["average" if weights_only else "network"])
        self.average.load_state_dict(state["average"])
        if not weights_only:
            self.optimizer.load_state_dict(state["optimizer"])
            self.step = state["step"]


def _groups(network: nn.Module) -> list[dict[str, Any]]:
    """Parameter groups: weight decay for weights of convolutions, but not for other parameters."""
    decaying = [p for p in network.parameters() if p.ndim > 1]
    others = [p for p in network.parameters() if p.ndim <= 1]
    return [
        {"params": decaying, "weight_decay": DECAY},
        {"params": others, "weight_decay": 0.0},
    ]


def export(network: Network, path: Path) -> None:
    """Write the ONNX file, with class names in its metadata as in Ultralytics' files."""
    model = Exported(copy.deepcopy(network).float(), HEIGHT, WIDTH).eval()
    picture = torch.zeros(1, 3, HEIGHT, WIDTH)
    torch.onnx.export(
        model,
        (picture,),
        str(path),
        input_names=["images"],
        output_names=["output0"],
        opset_version=18,
        external_data=False,
        verbose=False,
    )
    graph = onnx.load(path)
    names = dict(enumerate(class_names()))
    graph.metadata_props.add(key="names", value=json.dumps(names))
    forget_origins(graph.graph)
    onnx.checker.check_model(graph)
    onnx.save(graph, path)


def forget_origins(graph: onnx.GraphProto) -> None:
    """Remove the source locations of all parts: they contain paths of this machine."""
    ends = (*graph.input, *graph.output, *graph.value_info)
    for part in (graph, *graph.node, *graph.initializer, *ends):
        del part.metadata_props[:]


@dataclass(frozen=True, slots=True)
class Plan:
    """The settings of a training.

    Attributes:
        frames: the folder of the shards.
        out: the ONNX file to write.
        checkpoint: written every two minutes; if it exists, the training continues from it.
        start: a checkpoint with initial weights for a new training.
        crops: number of crops in all.
        batch: number of crops per step.
        rate: the highest learning rate.
        seed: of weights and crops.
    """

    frames: Path
    out: Path
    checkpoint: Path
    start: Path | None
    crops: int
    batch: int
    rate: float
    seed: int


def train(plan: Plan) -> Iterator[str]:
    """Train and export; yields messages about the progress.

    Raises:
        InputError: if there are no frames.
    """
    shards(plan.frames)
    torch.manual_seed(plan.seed)
    trainer = Trainer(plan.crops // plan.batch, plan.rate)
    if plan.checkpoint.exists():
        trainer.load(plan.checkpoint)
        yield f"going on from step {trainer.step} of {trainer.steps}"
    elif plan.start:
        trainer.load(plan.start, weights_only=True)
    source = batches(plan.frames, plan.batch, np.random.default_rng((plan.seed, trainer.step)))
    began = saved = time.monotonic()
    first, losses = trainer.step, deque[float](maxlen=SAY_STEPS)
    while trainer.step < trainer.steps:
        losses.append(trainer.learn(*next(source)))
        now = time.monotonic()
        if trainer.step % SAY_STEPS == 0:
            pace = (trainer.step - first) / (now - began)
            left = (trainer.steps - trainer.step) / pace / 60
            yield (
                f"step {trainer.step} of {trainer.steps}, loss {np.mean(losses):.3f}, "
                f"{pace * plan.batch:.0f} crops/s, {left:.0f} min left"
            )
        if now - saved > SAVE_S:
            trainer.save(plan.checkpoint)
            saved = now
    trainer.save(plan.checkpoint)
    export(trainer.average, plan.out)
    yield str(plan.out)
