"""The loss wants what it should, and the ONNX file says what the network does. Needs PyTorch.

PyTorch's exporter warns of parts of PyTorch.
"""

from pathlib import Path

import numpy as np
import pytest

from executive.perception.detector import OnnxDetector

torch = pytest.importorskip("torch", reason="the train extra is not installed")

from sim.learning.crops import SIDE, crop  # noqa: E402
from sim.learning.frames import Example, class_names  # noqa: E402
from sim.learning.loss import CELLS_A_THING, Wanted, generalized_overlap, loss, overlap  # noqa: E402
from sim.learning.network import Exported, Network, Residual, boxes_of, cells, flatten  # noqa: E402
from sim.learning.training import export  # noqa: E402

BOXES = torch.tensor([[40.0, 40.0, 100.0, 80.0], [150.0, 120.0, 180.0, 200.0]])


def wanted(counts: tuple[bool, bool] = (True, True)) -> list[Wanted]:
    return [Wanted(BOXES, torch.tensor([0, 2]), torch.tensor(counts))]


def said(boxes: torch.Tensor, logit: float) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
    """The cells in the middle of a box give it and its class, this sure; others say nothing."""
    middles, _ = cells(SIDE, SIDE)
    logits = torch.full((1, len(middles), 3), -8.0)
    given = torch.zeros(1, len(middles), 4)
    for box, number in zip(boxes, (0, 2), strict=True):
        middle = (BOXES[number // 2, :2] + BOXES[number // 2, 2:]) / 2
        nearest = (middles - middle).norm(dim=1).topk(CELLS_A_THING, largest=False).indices
        given[0, nearest] = box
        logits[0, nearest, number] = logit
    return given, logits, middles


def test_overlaps_are_whole_with_itself_and_negative_far_away() -> None:
    assert overlap(BOXES, BOXES).tolist() == pytest.approx([1.0, 1.0])
    assert generalized_overlap(BOXES, BOXES).tolist() == pytest.approx([1.0, 1.0], abs=1e-4)
    assert (generalized_overlap(BOXES, BOXES.flip(0)) < 0).all()


def test_better_boxes_and_better_scores_cost_less() -> None:
    right = loss(*said(BOXES, 2.0), wanted())
    assert right < loss(*said(BOXES + torch.tensor([9.0, 0.0, 9.0, 0.0]), 2.0), wanted())
    assert right < loss(*said(BOXES, -4.0), wanted())


def test_what_does_not_count_may_be_found_or_not() -> None:
    found = loss(*said(BOXES, 2.0), wanted((True, False)))
    boxes, logits, middles = said(BOXES, 2.0)
    logits[..., 2] = -8.0
    assert loss(boxes, logits, middles, wanted((True, False))) == pytest.approx(
        float(found), rel=0.05
    )


def test_a_crop_keeps_what_is_in_it_and_asks_for_what_is_mostly_in_it() -> None:
    color = np.zeros((480, 640, 3), np.uint8)
    boxes = np.array([[110, 120, 150, 180], [340, 100, 420, 140], [500, 0, 520, 20]], np.float32)
    example = Example(color, boxes, np.arange(3), np.ones(3, np.bool_))
    one = crop(example, 100, 100, SIDE, flip=False)
    assert one.boxes.tolist() == [[10, 20, 50, 80], [240, 0, 256, 40]]
    assert one.counts.tolist() == [True, False]
    assert crop(example, 100, 100, SIDE, flip=True).boxes[0].tolist() == [206, 20, 246, 80]


def test_a_crop_of_a_larger_square_shows_things_smaller() -> None:
    color = np.zeros((480, 640, 3), np.uint8)
    example = Example(color, BOXES.numpy() + 100, np.array([0, 2]), np.ones(2, np.bool_))
    one = crop(example, 100, 100, 320, flip=False)
    assert one.color.shape == (SIDE, SIDE, 3)
    assert one.boxes == pytest.approx(BOXES.numpy() * SIDE / 320)


def test_a_deeper_network_begins_as_the_shallower_one() -> None:
    features = torch.rand(1, 8, 4, 4)
    assert torch.equal(Residual(8)(features), features)


@pytest.mark.filterwarnings("ignore::FutureWarning", "ignore::DeprecationWarning")
def test_the_exported_file_says_what_the_network_says(tmp_path: Path) -> None:
    torch.manual_seed(0)
    network = Network(len(class_names())).eval()
    export(network, tmp_path / "network.onnx")
    detector = OnnxDetector(tmp_path / "network.onnx", lambda name: (name,))
    assert detector.names == class_names()
    color = np.random.default_rng(0).integers(0, 255, (480, 640, 3), np.uint8)
    with torch.no_grad():
        picture = torch.from_numpy(color).permute(2, 0, 1)[None].float() / 255
        expected = Exported(network, 480, 640).eval()(picture)[0].numpy()
        distances, _ = flatten(network(picture))
        edges = boxes_of(distances, *cells(480, 640))[0].numpy()
    found = detector.find(color, least=0.0)
    best = expected[4:].max(axis=0).argmax()
    assert found.scores[0] == pytest.approx(expected[4:, best].max(), rel=1e-3)
    assert found.boxes[0] == pytest.approx(edges[best], abs=0.5)
    assert b"network.py" not in (tmp_path / "network.onnx").read_bytes()
