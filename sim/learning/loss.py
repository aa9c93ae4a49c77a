"""The loss of the detector, and the assignment of its cells to objects.

Cells are assigned to objects by task alignment (Feng et al., TOOD, ICCV 2021): the cells with the
best scores and boxes for an object are trained to detect it.
"""

from dataclasses import dataclass

import torch
from torch import Tensor
from torch.nn import functional

CELLS_A_THING = 8
SCORE_POWER, OVERLAP_POWER = 0.5, 4.0
BOX_WEIGHT = 3.0


@dataclass(frozen=True, slots=True)
class Wanted:
    """The objects in one crop: boxes (n, 4; pixels), classes (n,), and whether they count (n,)."""

    boxes: Tensor
    classes: Tensor
    counts: Tensor


def overlap(one: Tensor, other: Tensor) -> Tensor:
    """Intersection over union of boxes (..., 4) that broadcast."""
    low = torch.maximum(one[..., :2], other[..., :2])
    high = torch.minimum(one[..., 2:], other[..., 2:])
    common = (high - low).clamp(min=0).prod(-1)
    areas = (one[..., 2:] - one[..., :2]).prod(-1) + (other[..., 2:] - other[..., :2]).prod(-1)
    return common / (areas - common + 1e-6)


def generalized_overlap(one: Tensor, other: Tensor) -> Tensor:
    """GIoU (Rezatofighi et al., CVPR 2019): negative where boxes are apart."""
    low = torch.maximum(one[..., :2], other[..., :2])
    high = torch.minimum(one[..., 2:], other[..., 2:])
    common = (high - low).clamp(min=0).prod(-1)
    areas = (one[..., 2:] - one[..., :2]).prod(-1) + (other[..., 2:] - other[..., :2]).prod(-1)
    both = areas - common
    hull = torch.maximum(one[..., 2:], other[..., 2:]) - torch.minimum(one[..., :2], other[..., :2])
    around = hull.prod(-1)
    return common / (both + 1e-6) - (around - both) / (around + 1e-6)


def loss(boxes: Tensor, logits: Tensor, middles: Tensor, wanted: list[Wanted]) -> Tensor:
    """The loss of boxes (b, n, 4; pixels) and logits (b, n, classes).

    Args:
        boxes: of all cells.
        logits: of all cells.
        middles: (n, 2) centres of the cells (pixels).
        wanted: the objects in each of the b crops.
    """
    targets = torch.zeros_like(logits)
    weights = torch.ones(logits.shape[:2])
    box_loss = torch.zeros(())
    for index, things in enumerate(wanted):
        if not len(things.boxes):
            continue
        inside = _inside(middles, things.boxes)
        weights[index][inside[~things.counts].any(0)] = 0.0
        cells, chosen, quality = _assign(
            boxes[index].detach(), logits[index].detach(), inside, things
        )
        weights[index][cells] = 1.0
        targets[index, cells, things.classes[chosen]] = quality
        wrong = 1 - generalized_overlap(boxes[index, cells], things.boxes[chosen])
        box_loss = box_loss + (wrong * quality).sum()
    wrong = functional.binary_cross_entropy_with_logits(logits, targets, reduction="none")
    total = targets.sum().clamp(min=1.0)
    return ((wrong.sum(-1) * weights).sum() + BOX_WEIGHT * box_loss) / total


def _inside(middles: Tensor, boxes: Tensor) -> Tensor:
    """(objects, n) whether the centre of each cell is in each box."""
    low = middles[None] - boxes[:, None, :2]
    high = boxes[:, None, 2:] - middles[None]
    return torch.cat((low, high), -1).amin(-1) > 0


def _assign(
    boxes: Tensor, logits: Tensor, inside: Tensor, things: Wanted
) -> tuple[Tensor, Tensor, Tensor]:
    """Indices of the cells that have an object, of these objects, and their target scores."""
    overlaps = overlap(boxes[None], things.boxes[:, None]) * inside
    scores = logits[:, things.classes].sigmoid().T
    alignment = scores**SCORE_POWER * overlaps**OVERLAP_POWER
    alignment = torch.where(inside & things.counts[:, None], alignment + 1e-9, 0.0)
    best = alignment.topk(min(CELLS_A_THING, alignment.shape[1]), 1)
    taken = torch.zeros_like(alignment).scatter_(1, best.indices, best.values)
    thing = torch.where(taken > 0, overlaps + 1e-9, 0.0).argmax(0)
    cells = (taken > 0).any(0).nonzero()[:, 0]
    chosen = thing[cells]
    most = taken.amax(1).clamp(min=1e-12)
    reach = torch.where(taken > 0, overlaps, 0.0).amax(1)
    quality = taken[chosen, cells] / most[chosen] * reach[chosen]
    return cells, chosen, quality
