"""Where a study's data lie: one folder, and in it one for each participant.

A participant's folder holds all that there is of them: recordings, and a journal with a line for
each thing that is over, on the disk before the next one begins. The tables beside are made of the
journals, and can be made again at any time.
"""

import fcntl
import json
import os
import re
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from executive.campaign.appending import append_line
from executive.campaign.claim import LOCK, lock_folder
from executive.errors import InputError
from executive.files import read_text, write_whole
from executive.page.study.file import Study

STUDY = "study.json"
JOURNAL = "journal.jsonl"
RUNS = "runs"
MOST = 9999
"""Participants of one study."""
TAKEN = "a participant of this number is at it"
NOT_TAKEN = "wait until they have come to the end, or name another participant"
_CODE = re.compile(r"P(\d{2,4})", re.ASCII)
_ERASED = ".erased-"
"""How the folder is called of which a part is gone already."""

Entry = dict[str, Any]


def code_of(number: int) -> str:
    """What stands for a participant's name."""
    return f"P{number:02}"


def number_of(code: str) -> int:
    """The number of a participant.

    Raises:
        InputError: if it is no such code.
    """
    found = _CODE.fullmatch(code)
    if not found or code_of(int(found[1])) != code or code == code_of(0):
        raise InputError("participant", f"{code} is no number of one", "write it as in P07")
    return int(found[1])


class Journal:
    """What is over, of one participant."""

    def __init__(self, folder: Path) -> None:
        """Of the participant with this folder."""
        self.folder = folder
        self.code = folder.name
        self.file = folder / JOURNAL

    def append(self, kind: str, **values: Any) -> None:
        """Write down, on the disk when this returns.

        Raises:
            InputError: if that is not possible.
        """
        at = datetime.now(UTC).isoformat(timespec="milliseconds")
        line = json.dumps({"kind": kind, "participant": self.code, "at": at, **values}) + "\n"
        try:
            append_line(self.file, line.encode())
        except OSError as error:
            what = f"cannot be written: {error.strerror}"
            raise InputError(
                str(self.file), what, f"make room, and go on with --participant {self.code}"
            ) from None

    def entries(self) -> list[Entry]:
        """All that was written down; half a line at the end is none.

        Raises:
            InputError: if something else is in it.
        """
        if not self.file.exists():
            return []
        lines = read_text(self.file, most=2**30).split("\n")[:-1]
        return [self._entry(number, line) for number, line in enumerate(lines, 1)]

    def _entry(self, number: int, line: str) -> Entry:
        try:
            entry = json.loads(line)
            assert isinstance(entry["kind"], str)
        except (ValueError, TypeError, KeyError, AssertionError, RecursionError):
            where = f"{self.file}, line {number}"
            right = "mend it by hand, or take it out"
            raise InputError(where, "is damaged", right) from None
        return dict(entry)

    def done(self) -> set[str]:
        """The keys of the steps that are over."""
        return {str(entry["done"]) for entry in self.entries() if "done" in entry}


class StudyData:
    """The folder of a study."""

    def __init__(self, folder: Path, study: Study) -> None:
        """Make the folder if there is none.

        Raises:
            InputError: if it cannot be used, or is of another study or another version of it.
        """
        self.folder, self.study = folder, study
        try:
            folder.mkdir(parents=True, exist_ok=True)
            with self.alone():
                self._claim()
                for left in folder.glob(f"{_ERASED}*"):
                    shutil.rmtree(left)
        except (OSError, ValueError) as error:
            why = error.strerror if isinstance(error, OSError) else error
            right = "name a folder to write to"
            raise InputError(f"--data {folder}", f"cannot be used: {why}", right) from None

    def _claim(self) -> None:
        file, mine = self.folder / STUDY, self.study.canonical()
        if not file.exists():
            write_whole(file, mine.encode())
            return
        try:
            theirs = json.loads(read_text(file))
            fields = type(self.study).model_fields  # what was unknown then is as by default
            said = json.loads(mine).items()
            differs = [k for k, v in said if theirs.get(k, fields[k].default) != v]
        except (ValueError, AttributeError, RecursionError):
            right = "name another folder"
            raise InputError(f"--data {self.folder}", f"{file.name} is damaged", right) from None
        if differs and not self.journals():  # nobody has begun: it may still be changed
            write_whole(file, mine.encode())
        elif differs:
            what = f"the study has changed since its data began: {', '.join(differs)}"
            right = "put the file back as it was, or name another folder with --data"
            raise InputError(f"--data {self.folder}", what, right)

    @contextmanager
    def alone(self) -> Iterator[None]:
        """No other process reads the journals and writes the tables meanwhile."""
        lock = os.open(self.folder / LOCK, os.O_RDWR | os.O_CREAT | os.O_NONBLOCK, 0o666)
        try:
            fcntl.flock(lock, fcntl.LOCK_EX)
            yield
        finally:
            os.close(lock)

    def journals(self) -> list[Journal]:
        """Of all participants there are, by number."""
        found = [path for path in self.folder.iterdir() if _CODE.fullmatch(path.name)]
        return [Journal(path) for path in sorted(found, key=lambda p: (len(p.name), p.name))]

    def unfinished(self) -> list[str]:
        """Who has begun and not come to the end."""
        journals = self.journals()
        return [one.code for one in journals if not any(map(is_last, one.entries()))]

    def next(self) -> str:
        """The lowest number that is free, so that no order of the conditions stays empty."""
        taken = {journal.code for journal in self.journals()}
        return next(code for code in map(code_of, range(1, MOST + 1)) if code not in taken)

    @contextmanager
    def one(self, code: str) -> Iterator[Journal]:
        """A participant's journal, for this process alone; made if there is none.

        Raises:
            InputError: if another process has it, or it cannot be made.
        """
        number_of(code)
        folder = self.folder / code
        try:
            folder.mkdir(exist_ok=True)
        except OSError as error:
            right = "name a folder to write to"
            raise InputError(
                f"--data {folder}", f"cannot be made: {error.strerror}", right
            ) from None
        with lock_folder(folder, "participant", TAKEN, NOT_TAKEN):
            yield Journal(folder)

    @contextmanager
    def if_only_begun(self, journal: Journal) -> Iterator[None]:
        """Whoever has agreed to nothing leaves nothing, however it ends; their number is free."""
        try:
            yield
        finally:
            if not (journal.folder / RUNS).exists() and not journal.entries():
                self.erase(journal)

    def erase(self, journal: Journal) -> None:
        """Remove a participant's folder; what is left of it if that fails is removed next time.

        Raises:
            OSError: if it cannot be removed.
        """
        gone = self.folder / f"{_ERASED}{secrets.token_hex(4)}"
        journal.folder.rename(gone)
        shutil.rmtree(gone)


def is_last(entry: Entry) -> bool:
    """Whether nothing comes after it."""
    return bool(entry["kind"] == "finished")
