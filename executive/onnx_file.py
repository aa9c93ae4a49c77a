"""What an ONNX file says about itself: the size of pictures it takes, and its metadata.

Only the fields needed are declared, after onnx.proto; protobuf steps over all others.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from google.protobuf.message import DecodeError

from executive.errors import InputError

_FIELDS: dict[str, tuple[tuple[str, int, str, bool], ...]] = {
    "Model": (("graph", 7, "Graph", False), ("metadata_props", 14, "Entry", True)),
    "Entry": (("key", 1, "string", False), ("value", 2, "string", False)),
    "Graph": (("node", 1, "bytes", True), ("input", 11, "Value", True)),
    "Value": (("name", 1, "string", False), ("type", 2, "Type", False)),
    "Type": (("tensor_type", 1, "Tensor", False),),
    "Tensor": (("shape", 2, "Shape", False),),
    "Shape": (("dim", 1, "Dimension", True),),
    "Dimension": (("dim_value", 1, "int64", False),),
}
"""Message -> its fields: name, number, type, and whether there may be several."""


@dataclass(frozen=True, slots=True)
class OnnxFile:
    """What the file says.

    Attributes:
        input: lengths of the first four-dimensional input (b, c, h, w); 0 where left open.
        metadata: its own words, such as `names` of Ultralytics' exports.
    """

    input: tuple[int, int, int, int]
    metadata: Mapping[str, str]


def read_onnx(path: Path) -> OnnxFile:
    """Read what the file says about itself.

    Raises:
        InputError: if it cannot be read, is no ONNX file, or takes no pictures.
    """
    model = _message("Model")()
    try:
        model.ParseFromString(path.read_bytes())
    except OSError as error:
        right = "give a detector's FILE.onnx, learned or simulated"
        raise InputError(str(path), f"cannot be read: {error.strerror}", right) from None
    except DecodeError:
        model = _message("Model")()
    if not model.graph.node:
        raise InputError(str(path), "is not an ONNX file", "export the detector's network to ONNX")
    shapes = [[d.dim_value for d in i.type.tensor_type.shape.dim] for i in model.graph.input]
    for shape in shapes:
        if len(shape) == 4:
            batch, channels, height, width = shape
            metadata = {entry.key: entry.value for entry in model.metadata_props}
            return OnnxFile((batch, channels, height, width), metadata)
    raise InputError(str(path), f"has inputs {shapes}", "one of (1, 3, height, width) is needed")


@cache
def _message(name: str) -> Any:
    """The class of one of our messages."""
    kinds = descriptor_pb2.FieldDescriptorProto
    scalars = {"string": kinds.TYPE_STRING, "bytes": kinds.TYPE_BYTES, "int64": kinds.TYPE_INT64}
    file = descriptor_pb2.FileDescriptorProto(name="onnx_part.proto", package="onnx_part")
    file.syntax = "proto3"
    for message, fields in _FIELDS.items():
        described = file.message_type.add(name=message)
        for field, number, kind, several in fields:
            label = kinds.LABEL_REPEATED if several else kinds.LABEL_OPTIONAL
            added = described.field.add(name=field, number=number, label=label)
            if kind in scalars:
                added.type = scalars[kind]
            else:
                added.type_name = f".onnx_part.{kind}"
    pool = descriptor_pool.DescriptorPool()
    pool.Add(file)
    return message_factory.GetMessageClass(pool.FindMessageTypeByName(f"onnx_part.{name}"))
