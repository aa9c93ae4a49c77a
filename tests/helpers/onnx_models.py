from collections.abc import Sequence
from pathlib import Path

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

from executive.types.geometry import Pose
from executive.types.perception import Frame, Intrinsics

NAMES = ("apple", "mug")


SIZE = 64


Row = tuple[float, float, float, float, int, float]
"""Middle x and y, width, height, class, confidence."""


def v8(rows: Sequence[Row], classes: int = 2) -> np.ndarray:
    output = np.zeros((1, 4 + classes, max(20, len(rows))), np.float32)
    for index, (*box, number, confidence) in enumerate(rows):
        output[0, :4, index] = box
        output[0, 4 + number, index] = confidence
    return output


def v5(rows: Sequence[Row], classes: int = 2) -> np.ndarray:
    output = np.zeros((1, max(20, len(rows)), 5 + classes), np.float32)
    for index, (*box, number, confidence) in enumerate(rows):
        output[0, index, :4] = box
        output[0, index, 4], output[0, index, 5 + number] = 0.9, confidence / 0.9
    return output


def write_model(
    folder: Path, output: np.ndarray, names: str | None = str(list(NAMES)), size: int = SIZE
) -> Path:
    """A network that always says the same."""
    said = numpy_helper.from_array(output, "said")
    zero = numpy_helper.from_array(np.zeros(1, np.float32), "zero")
    flat = numpy_helper.from_array(np.array([1, 1, 1]), "flat")
    nodes = [
        helper.make_node("ReduceMean", ["images"], ["mean"], keepdims=1),
        helper.make_node("Reshape", ["mean", "flat"], ["one"]),
        helper.make_node("Mul", ["one", "zero"], ["nothing"]),
        helper.make_node("Add", ["nothing", "said"], ["output0"]),
    ]
    picture = helper.make_tensor_value_info("images", TensorProto.FLOAT, (1, 3, size, size))
    out = helper.make_tensor_value_info("output0", TensorProto.FLOAT, output.shape)
    graph = helper.make_graph(nodes, "tiny", [picture], [out], [said, zero, flat])
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 13)], ir_version=8)
    if names is not None:
        model.metadata_props.add(key="names", value=names)
    path = folder / "tiny.onnx"
    onnx.save(model, path)
    return path


def known(name: str) -> tuple[str, ...]:
    return (name,) if name in NAMES else ()


def frame(height: int = SIZE, width: int = SIZE) -> Frame:
    """A blank picture taken from 0.7 m above a floor."""
    lens = Intrinsics(width, height, 60.0, 60.0, (width - 1) / 2, (height - 1) / 2)
    depth = np.full((height, width), 0.7, np.float32)
    color = np.zeros((height, width, 3), np.uint8)
    return Frame(0, color, depth, lens, Pose((0.0, 0.0, 0.7), (1.0, 0.0, 0.0, 0.0)))


APPLE: Row = (20.0, 30.0, 10.0, 8.0, 0, 0.81)


MUG: Row = (50.0, 12.0, 8.0, 12.0, 1, 0.54)
