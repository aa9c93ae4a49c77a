"""A participant withdraws: all that there is of them is erased, and looked for afterwards."""

import hashlib
import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from executive.errors import InputError
from executive.page.study.data import StudyData, number_of
from executive.page.study.tables import read_rows, tables, write_tables

RECORDINGS = (".mcap", ".rrd")
"""Files in which a few bytes are found by chance, too."""
TABLE = ".parquet"
_PART = 1 << 20


@dataclass(frozen=True)
class Withdrawal:
    """What was erased, and what a search of the folder came to.

    Attributes:
        files: how many were erased.
        size: of these, in bytes.
        searched: how many files were read afterwards.
        found: in which of them something of the participant is; none if all is well.
    """

    code: str
    files: int
    size: int
    searched: int
    found: tuple[Path, ...]


@dataclass(frozen=True)
class _Traces:
    """By what a participant's data are known."""

    word: re.Pattern[bytes]
    """Their number, as a word of its own."""
    place: bytes
    """Where their recordings were: a part of the paths that recordings keep."""
    contents: frozenset[str]
    """What was in their files (SHA-256)."""


def withdraw(data: StudyData, code: str) -> Withdrawal:
    """Erase a participant, make the tables anew, and search the folder.

    A report of before is erased, too: it counts the participant.

    Raises:
        InputError: if there is no such participant, or they are at it, or files cannot be erased,
            or another participant's journal is damaged; then nothing is erased.
    """
    number_of(code)
    if not (data.folder / code).is_dir():
        known = ", ".join(journal.code for journal in data.journals()) or "none"
        raise InputError("--withdraw", f"there is no {code}", f"there are {known}")
    tables(data, without=code)  # those of the others can be made
    try:
        with data.one(code) as journal:
            traces = _traces(journal.folder, code)
            sizes = [path.stat().st_size for path in _files(journal.folder)]
            data.erase(journal)
        write_tables(data)
        for report in _reports(data.folder):
            report.unlink()
        searched = list(_files(data.folder))
        found = tuple(path for path in searched if _has(path, data.folder, traces))
    except OSError as error:
        what = f"cannot be erased: {error.strerror}"
        raise InputError(f"--data {data.folder}", what, "see to it, and say it again") from None
    return Withdrawal(code, len(sizes), sum(sizes), len(searched), found)


def _reports(folder: Path) -> list[Path]:
    return [*folder.glob("report.*"), *folder.glob("plots/*.svg")]


def _files(folder: Path) -> Iterator[Path]:
    for place, _, names in os.walk(folder):
        yield from (Path(place) / name for name in sorted(names))


def _traces(folder: Path, code: str) -> _Traces:
    return _Traces(
        re.compile(rb"(?<![A-Za-z0-9])" + code.encode() + rb"(?![A-Za-z0-9])", re.IGNORECASE),
        f"/{code}/".encode(),
        frozenset(_sha256(path) for path in _files(folder) if path.stat().st_size),
    )


def _sha256(file: Path) -> str:
    with file.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def _has(file: Path, folder: Path, traces: _Traces) -> bool:
    """Whether something of the participant is in a file, or in its name."""
    if traces.word.search(str(file.relative_to(folder)).encode()):
        return True
    if file.stat().st_size and _sha256(file) in traces.contents:
        return True
    if file.suffix == TABLE:
        cells = (str(value) for row in read_rows(file) for value in row.values())
        return any(traces.word.search(cell.encode()) for cell in cells)
    with file.open("rb") as stream:
        before = b""
        while part := stream.read(_PART):
            text = before + part
            if traces.place in text:
                return True
            if file.suffix not in RECORDINGS and _is_in(text, traces):
                return True
            before = text[-2 * len(traces.place) :]
    return False


def _is_in(text: bytes, traces: _Traces) -> bool:
    """Whether their number is in it; in UTF-16, as some editors save, each letter has a zero."""
    return any(traces.word.search(one) for one in (text, text.replace(b"\0", b"")))
