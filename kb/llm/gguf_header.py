"""Reads and validates the header of a GGUF file before llama.cpp loads it.

The format: https://github.com/ggml-org/ggml/blob/master/docs/gguf.md. All counts and lengths are
bounded, so that reading a malformed file takes no more time and memory than a valid one.
"""

import mmap
import stat
import struct
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from executive.errors import ModelError
from executive.text import printable

MAGIC = b"GGUF"
VERSIONS = (2, 3)
MOST_VALUES = 10_000
MOST_TENSORS = 100_000
MOST_ENTRIES = 1 << 24
"""Entries of a list, such as the vocabulary."""
LONGEST_NAME = 256
LONGEST_TEXT = 1 << 20
LONGEST_TEMPLATE = 1 << 16
MOST_NUMBERS = 1 << 44
"""Elements of a tensor."""

WRITES, RANKS = "writes", "ranks"
"""What a model can do."""

TEMPLATE = "tokenizer.chat_template"
ENCODERS = ("bert", "embedding", "t5encoder", "clip", "wavtokenizer")
"""Architectures whose name contains one of these generate no text."""

_NUMBERS = {0: "B", 1: "b", 2: "<H", 3: "<h", 4: "<I", 5: "<i", 6: "<f", 7: "?"}
_NUMBERS |= {10: "<Q", 11: "<q", 12: "<d"}
_TEXT, _LIST = 8, 9

Value = int | float | str | None
"""The value of a list is not kept."""


def check_file(path: Path) -> None:
    """Check that this may be a model file.

    Raises:
        ModelError: if it is missing, or not a GGUF file.
    """
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            raise ModelError(f"model {printable(path)} cannot be read: it is no file")
        with path.open("rb") as file:
            begins = file.read(len(MAGIC))
    except OSError as error:
        raise ModelError(f"model {printable(path)} cannot be read: {error.strerror}") from None
    if begins != MAGIC:
        where = printable(path)
        raise ModelError(f"model {where} is no GGUF file: it does not begin with the letters GGUF")


@dataclass(frozen=True, slots=True)
class Header:
    """The values that are not lists, and the number of tensors."""

    values: Mapping[str, Value]
    tensors: int

    @property
    def architecture(self) -> str:
        """The architecture, as llama.cpp calls it."""
        return str(self.values.get("general.architecture", ""))


def read_header(path: Path) -> Header:
    """Read the header of a file.

    Raises:
        ModelError: if it is not a valid GGUF file; the message says why.
    """
    try:
        with (
            path.open("rb") as file,
            mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data,
        ):
            return _Reader(path, data).header()
    except (OSError, ValueError) as error:
        raise ModelError(f"model {printable(path)} cannot be read: {error}") from None


def refuse_what_does_not_chat(path: Path, header: Header) -> None:
    """Check that the model can chat.

    Raises:
        ModelError: if it has another purpose, or no chat template.
    """
    kind, where = header.architecture, printable(path)
    pooling = header.values.get(f"{kind}.pooling_type")
    if any(part in kind for part in ENCODERS) or pooling:
        raise ModelError(
            f"model {where} only embeds or compares texts ({printable(kind)}): take one that chats"
        )
    if (made_as := header.values.get("general.type", "model")) != "model":
        raise ModelError(f"file {where} is no whole model but a part ({printable(made_as)})")
    if not header.tensors:
        raise ModelError(f"model {where} has a vocabulary but no weights")
    if not str(header.values.get(TEMPLATE) or "").strip():
        raise ModelError(f"model {where} has no chat template: take an instruction-tuned model")


class _Reader:
    """Reads the bytes of a file once, in order."""

    def __init__(self, path: Path, data: mmap.mmap) -> None:
        self._path, self._data, self._at = path, data, 0

    def header(self) -> Header:
        if self._take(4) != b"GGUF":
            self._refuse("does not begin with the letters GGUF")
        version = int(self._number("<I"))
        if int.from_bytes(version.to_bytes(4, "little"), "big") in VERSIONS:
            self._refuse("is made for big-endian machines: take the one for all others")
        if version not in VERSIONS:
            self._refuse(f"is of version {version}; known are 2 and 3")
        tensors = self._count("tensors", MOST_TENSORS)
        values: dict[str, Value] = {}
        for _ in range(self._count("values", MOST_VALUES)):
            name = self._text("name of a value", LONGEST_NAME)
            if name in values:
                self._refuse(f"has {name!r} twice")
            values[name] = self._value(name)
        self._tensors(tensors, values)
        return Header(values, tensors)

    def _value(self, name: str) -> Value:
        kind = self._number("<I")
        if kind == _TEXT:
            return self._text(name, LONGEST_TEMPLATE if name == TEMPLATE else LONGEST_TEXT)
        if kind == _LIST:
            self._pass_over_list(name)
            return None
        if kind not in _NUMBERS:
            self._refuse(f"has {name!r} of the unknown kind {kind}")
        return self._number(_NUMBERS[int(kind)])

    def _pass_over_list(self, name: str) -> None:
        kind = int(self._number("<I"))
        count = self._count(f"entries in {name!r}", MOST_ENTRIES)
        if kind in _NUMBERS:
            self._pass_over(count * struct.calcsize(_NUMBERS[kind]))
        elif kind == _TEXT:
            for _ in range(count):
                self._pass_over(self._count(f"characters in {name!r}", LONGEST_TEXT))
        else:
            self._refuse(f"has lists in the list {name!r}")

    def _tensors(self, count: int, values: Mapping[str, Value]) -> None:
        """Skip the descriptions of the tensors; check that the data of each begins in the file."""
        alignment = values.get("general.alignment", 32)
        if not isinstance(alignment, int) or not 0 < alignment <= 1 << 20:
            self._refuse(f"has an impossible alignment, {alignment}")
        names, offsets = set[str](), [0]
        for _ in range(count):
            name = self._text("name of a tensor", LONGEST_NAME)
            if name in names:
                self._refuse(f"has the tensor {name!r} twice")
            names.add(name)
            numbers = 1
            for _ in range(self._count("dimensions", 4, "<I")):
                numbers *= self._count(f"numbers in {name!r}", MOST_NUMBERS)
            if not 0 < numbers <= MOST_NUMBERS:
                self._refuse(f"has the tensor {name!r} with {numbers} numbers")
            self._number("<I")
            offsets.append(int(self._number("<Q")))
        begins = -(-self._at // alignment) * alignment
        if begins + max(offsets) > len(self._data) or (count and begins >= len(self._data)):
            self._refuse("ends before its weights do: was it copied whole?")

    def _text(self, what: str, most: int) -> str:
        return bytes(self._take(self._count(f"characters in {what}", most))).decode(
            errors="replace"
        )

    def _count(self, what: str, most: int, form: str = "<Q") -> int:
        count = int(self._number(form))
        if count > most:
            self._refuse(f"claims {count} {what}, more than {most}")
        return count

    def _number(self, form: str) -> int | float:
        number: int | float = struct.unpack(form, self._take(struct.calcsize(form)))[0]
        return number

    def _take(self, count: int) -> bytes:
        begins = self._at
        self._pass_over(count)
        return self._data[begins : self._at]

    def _pass_over(self, count: int) -> None:
        self._at += count
        if self._at > len(self._data):
            self._refuse("ends in the middle of its header")

    def _refuse(self, why: str) -> NoReturn:
        raise ModelError(
            f"model {printable(self._path)} is no sound GGUF file: it {printable(why)}"
        )
