"""`python -m executive --page`: what the program prints and how it ends."""

import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from paging import heard, post
from patience import PATIENCE_S


@contextmanager
def begun(runs: Path, *words: str) -> Iterator[tuple["subprocess.Popen[str]", Any, dict[str, Any]]]:
    """The program, its page, and the token to use it with."""
    paper = ["--world", "fake", "--llm", "none", "--search", "paper"]
    options = [*paper, "--runs", str(runs), "--page", "0"]
    with subprocess.Popen(
        [sys.executable, "-m", "executive", *words, *options],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        assert process.stderr is not None
        found = re.fullmatch(r"Open (http://[^?]+)\?token=(\S+)\n", process.stderr.readline())
        assert found
        try:
            yield process, SimpleNamespace(url=found[1]), {"token": found[2]}
        finally:
            process.kill()


def test_a_conversation_by_page_ends_as_one_at_the_terminal(tmp_path: Path) -> None:
    with begun(tmp_path, "Find", "the", "peach") as (process, page, token):
        heard(page, "question", kind="where_is", **token)
        post(page, "/say", {"words": "high_table"}, **token)
        heard(page, "doing", state="ready", **token)
        post(page, "/say", {"words": "quit"}, **token)
        printed, _ = process.communicate(timeout=PATIENCE_S)
    assert printed.startswith("done: The peach is on the high table in the kitchen.")
    assert process.returncode == 0


def test_a_signal_stops_what_runs_and_tells_the_pages(tmp_path: Path) -> None:
    with begun(tmp_path, "Find", "the", "peach") as (process, page, token):
        heard(page, "question", kind="where_is", **token)
        process.send_signal(signal.SIGTERM)
        assert process.wait(PATIENCE_S) == 130


def test_the_page_is_the_person_and_nobody_else(tmp_path: Path) -> None:
    ended = subprocess.run(
        [sys.executable, "-m", "executive", "--page", "0", "--user", "oracle", "--world", "fake"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert ended.returncode == 2
    assert "--page: it is the person, and the settings name another" in ended.stderr
