"""Reads messages of older recordings, some of whose fields have other numbers."""

from functools import lru_cache
from typing import Any

from google.protobuf.descriptor_pb2 import FileDescriptorSet

from logs.recording.channels import DEFINITIONS, MESSAGES, NUMBERS
from logs.recording.schema import PACKAGE, classes, fresh_pool


@lru_cache(maxsize=64)
def recorded_class(name: str, definition: bytes) -> Any:
    """The class for a recorded message, with the field numbers of that recording.

    Only the numbers of known fields are taken from the definition in the file. Names and types are
    ours, and no class is built from its other content.

    Args:
        name: name of the message, as in `MESSAGES`.
        definition: a serialized FileDescriptorSet, as in mcap.

    Raises:
        ValueError: if the definition is invalid, or does not contain the message.
        google.protobuf.message.DecodeError: if it is not a FileDescriptorSet.
    """
    numbers = {
        (message.name, field.name): field.number
        for file in FileDescriptorSet.FromString(definition).file
        if file.package == PACKAGE
        for message in file.message_type
        for field in message.field
    }
    if not any(message == name for message, _ in numbers):
        raise ValueError(f"its definition lacks the message {name}")
    known = {key: number for key, number in numbers.items() if key in NUMBERS}
    if all(NUMBERS[key] == number for key, number in known.items()):
        return MESSAGES[name]
    return _older(tuple(sorted(known.items())))[name]


@lru_cache(maxsize=8)
def _older(numbers: tuple[tuple[tuple[str, str], int], ...]) -> dict[str, Any]:
    try:
        return classes(fresh_pool(), DEFINITIONS, dict(numbers))
    except TypeError as error:
        raise ValueError(f"its definition numbers fields as none can be: {error}") from None
