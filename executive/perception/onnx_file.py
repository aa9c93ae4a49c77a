"""Reads and validates the header of an ONNX file: its input, its metadata, its weights' location.

Only the needed fields are declared, after onnx.proto; protobuf skips all others.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from math import prod
from pathlib import Path
from typing import Any

from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from google.protobuf.message import DecodeError

from executive.errors import InputError
from executive.files import read_bytes

MOST_BYTES = 512 * 2**20
"""The largest file (bytes): the largest networks of this kind have half of that."""
LONGEST_SIDE = 4096
"""The longest side of a network's input (pixels)."""
MOST_WEIGHTS = 2**28
"""The largest number of elements in one tensor of a file."""
_EXTERNAL = 1
"""The `data_location` of weights in another file."""

_FIELDS: dict[str, tuple[tuple[str, int, str, bool], ...]] = {
    "Model": (
        ("graph", 7, "Graph", False),
        ("metadata_props", 14, "Entry", True),
        ("functions", 25, "Function", True),
    ),
    "Entry": (("key", 1, "string", False), ("value", 2, "string", False)),
    "Graph": (
        ("node", 1, "Node", True),
        ("initializer", 5, "Weights", True),
        ("input", 11, "Value", True),
        ("sparse_initializer", 15, "Sparse", True),
    ),
    "Function": (("node", 7, "Node", True),),
    "Node": (("attribute", 5, "Attribute", True),),
    "Attribute": (
        ("t", 5, "Weights", False),
        ("g", 6, "Graph", False),
        ("tensors", 10, "Weights", True),
        ("graphs", 11, "Graph", True),
        ("sparse_tensor", 22, "Sparse", False),
        ("sparse_tensors", 23, "Sparse", True),
    ),
    "Sparse": (("values", 1, "Weights", False), ("indices", 2, "Weights", False)),
    "Weights": (
        ("dims", 1, "int64", True),
        ("name", 8, "string", False),
        ("external_data", 13, "Entry", True),
        ("data_location", 14, "int64", False),
    ),
    "Value": (("name", 1, "string", False), ("type", 2, "Type", False)),
    "Type": (("tensor_type", 1, "Tensor", False),),
    "Tensor": (("elem_type", 1, "int64", False), ("shape", 2, "Shape", False)),
    "Shape": (("dim", 1, "Dimension", True),),
    "Dimension": (("dim_value", 1, "int64", False),),
}
"""Message -> its fields: name, number, type, and whether it is repeated."""

FLOAT, UINT8, FLOAT16 = 1, 2, 10
_KINDS = {FLOAT: "float", UINT8: "uint8", FLOAT16: "float16"}


@dataclass(frozen=True, slots=True)
class OnnxFile:
    """The header of an ONNX file.

    Attributes:
        height: of its input (pixels); 0 if it takes any height.
        width: of its input (pixels); 0 if it takes any width.
        takes_bytes: whether its input has colours from 0 to 255, not from 0 to 1.
        metadata: its metadata, such as `names` in exports of Ultralytics.
        content: the whole file.
    """

    height: int
    width: int
    takes_bytes: bool
    metadata: Mapping[str, str]
    content: bytes = field(repr=False)


def read_onnx(path: Path) -> OnnxFile:
    """Read and validate the header of an ONNX file.

    Raises:
        InputError: if it cannot be read, is not an ONNX file, does not take one picture of three
            colours, is too large, or refers to another file.
    """
    where = str(path)
    content = read_bytes(
        path, MOST_BYTES, right="give a detector's FILE.onnx, learned or simulated"
    )
    model = _message("Model")()
    try:
        model.ParseFromString(content)
    except DecodeError:
        model = _message("Model")()
    if not model.graph.node:
        raise InputError(where, "is not an ONNX file", "export the detector's network to ONNX")
    for weights in _all_weights(model):
        if weights.data_location == _EXTERNAL or weights.external_data:
            right = "save it in one file (onnx.save with save_as_external_data=False)"
            raise InputError(where, "has weights in another file, which is not read", right)
        if min(weights.dims, default=1) < 0 or prod(weights.dims) > MOST_WEIGHTS:
            raise InputError(where, f"has a tensor of {_times(weights.dims)} numbers")
    picture = _picture(where, model.graph)
    height, width = _size(where, _lengths(picture))
    if picture.elem_type not in _KINDS:
        right = f"export it with inputs of type {' or '.join(_KINDS.values())}"
        raise InputError(where, f"takes pictures of type {picture.elem_type} of ONNX", right)
    metadata = {entry.key: entry.value for entry in model.metadata_props}
    return OnnxFile(height, width, picture.elem_type == UINT8, metadata, content)


def _picture(where: str, graph: Any) -> Any:
    """The type of the only input that is not a weight."""
    weights = {tensor.name for tensor in graph.initializer}
    inputs = [value.type.tensor_type for value in graph.input if value.name not in weights]
    shapes = [_lengths(one) for one in inputs]
    if [len(shape) for shape in shapes] != [4]:
        told = ", ".join(f"({_times(shape, ', ')})" for shape in shapes[:8]) or "none"
        right = "one input of (1, 3, height, width), and no other, is needed"
        raise InputError(where, f"has inputs {told}", right)
    return inputs[0]


def _lengths(tensor: Any) -> list[int]:
    """The shape of an input; 0 for any length, which some exporters write as -1."""
    return [0 if d.dim_value == -1 else d.dim_value for d in tensor.shape.dim]


def _size(where: str, shape: list[int]) -> tuple[int, int]:
    """Height and width of pictures of this shape; 0 stands for any."""
    batch, channels, height, width = shape
    if batch not in (0, 1):
        raise InputError(where, f"takes {batch} pictures at once", "export it for one picture")
    if channels not in (0, 3) or (channels == 0 and width == 3):
        right = "(1, 3, height, width) is needed: export it with channels first"
        raise InputError(where, f"takes pictures of shape ({_times(shape, ', ')})", right)
    if not 0 <= min(height, width) <= max(height, width) <= LONGEST_SIDE:
        right = f"export it for sides of up to {LONGEST_SIDE}, such as 640"
        raise InputError(where, f"takes pictures of {height} x {width}", right)
    return height, width


def _all_weights(model: Any) -> Iterator[Any]:
    """Every tensor that the file holds or refers to, at whatever depth."""
    nodes = [node for function in model.functions for node in function.node]
    graphs = [model.graph]
    while graphs or nodes:
        if graphs:
            graph = graphs.pop()
            nodes += graph.node
            yield from graph.initializer
            yield from _of_sparse(graph.sparse_initializer)
        else:
            for attribute in nodes.pop().attribute:
                yield from (attribute.t, *attribute.tensors)
                yield from _of_sparse([attribute.sparse_tensor, *attribute.sparse_tensors])
                graphs += [one for one in (attribute.g, *attribute.graphs) if one.node]


def _of_sparse(tensors: Any) -> Iterator[Any]:
    for tensor in tensors:
        yield from (tensor.values, tensor.indices)


def _times(lengths: Any, sign: str = " x ") -> str:
    return sign.join(map(str, list(lengths)[:8]))


@cache
def _message(name: str) -> Any:
    """The class of one of our messages."""
    kinds = descriptor_pb2.FieldDescriptorProto
    scalars = {"string": kinds.TYPE_STRING, "int64": kinds.TYPE_INT64}
    file = descriptor_pb2.FileDescriptorProto(name="onnx_part.proto", package="onnx_part")
    file.syntax = "proto3"
    for message, fields in _FIELDS.items():
        described = file.message_type.add(name=message)
        for name_of_field, number, kind, several in fields:
            label = kinds.LABEL_REPEATED if several else kinds.LABEL_OPTIONAL
            added = described.field.add(name=name_of_field, number=number, label=label)
            if kind in scalars:
                added.type = scalars[kind]
            else:
                added.type_name = f".onnx_part.{kind}"
    pool = descriptor_pool.DescriptorPool()
    pool.Add(file)
    return message_factory.GetMessageClass(pool.FindMessageTypeByName(f"onnx_part.{name}"))
