"""What a recording holds never reaches a terminal as more than text, and forges no line."""

import json
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import Any

import pytest
from recordings import record
from sample_mission import TREE, mission

from executive.records import Finished, Picture, Record, Scene, Tick, TreeShape
from logs.__main__ import main
from logs.questions import report
from logs.recording.reader import Run
from logs.viewer import markdown

EVIL = "\x1b[2J\x07\n    9.999  done\r\x85\u2028\u202e\u200f"
QUESTIONS = ("why", "summary", "ticks", "timeline", "llm", "dialog", "compare", "replay")
FIXED = {"path", "parent", "kind", "class_name", "status", "source", "level"}
"""What is not text from outside, or must fit together."""


def evil(value: Any) -> Any:
    """The same record in which every text ends as no text should."""
    match value:
        case str():
            return f"{value}{EVIL}"
        case tuple():
            return tuple(map(evil, value))
        case dict():
            return {key: evil(inner) for key, inner in value.items()}
        case list():
            return list(map(evil, value))
        case Scene() | Picture():
            return value
        case _ if is_dataclass(value) and not isinstance(value, type):
            texts = {f.name: getattr(value, f.name) for f in fields(value) if f.name not in FIXED}
            return replace(value, **{name: evil(inner) for name, inner in texts.items()})
    return value


def evil_mission() -> Iterator[tuple[float, Record]]:
    shape = TreeShape(
        tuple(
            replace(evil(n), path=n.path + EVIL, parent=n.parent and n.parent + EVIL)
            for n in TREE.nodes
        )
    )
    for time, entry in mission():
        match entry:
            case TreeShape():
                yield time, shape
            case Tick():
                states = [replace(evil(node), path=node.path + EVIL) for node in entry.nodes]
                yield time, replace(evil(entry), nodes=tuple(states))
            case Finished(outcome):
                yield time, Finished(replace(evil(outcome), kind=outcome.kind))
            case _:
                yield time, evil(entry)


@pytest.fixture
def run(tmp_path: Path) -> Path:
    config = f"home = {json.dumps(EVIL)}\n".encode()
    return record(tmp_path / f"run{EVIL}", evil_mission(), {"config.toml": config})


@pytest.mark.parametrize("question", QUESTIONS)
def test_no_question_lets_a_recording_write_to_the_terminal(
    run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], question: str
) -> None:
    others = [str(record(tmp_path / "other"))] if question == "compare" else []
    main([question, str(run), *others])
    out = capsys.readouterr().out
    assert all(line.isprintable() for line in out.split("\n"))
    assert "\n    9.999  done" not in out
    if question != "replay":
        assert "\\x1b[2J" in out


def test_many_runs_are_one_line_each(run: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["summary", str(run), str(run)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 3
    assert all(line.isprintable() for line in lines)


@pytest.mark.parametrize("options", [["frames", "--out"], ["export", "--parquet"], ["recover"]])
def test_what_was_written_where_is_said_on_one_line(
    run: Path, capsys: pytest.CaptureFixture[str], options: list[str]
) -> None:
    question, *where = options
    assert main([question, str(run), *where, *([str(run / EVIL[-2:])] if where else [])]) == 0
    assert all(line.isprintable() for line in capsys.readouterr().out.split("\n"))


@pytest.mark.parametrize("question", QUESTIONS)
def test_json_is_ascii(run: Path, capsys: pytest.CaptureFixture[str], question: str) -> None:
    main([question, str(run), *([str(run)] if question == "compare" else []), "--json"])
    out = capsys.readouterr().out
    assert out.isascii()
    assert out.rstrip("\n").isprintable()


def test_further_lines_of_a_reply_stand_behind_a_bar(tmp_path: Path) -> None:
    (row, _) = report.llm(Run(record(tmp_path)))
    row["messages"][-1]["content"] = "one\n\n0.000 s  rank  model"
    _, *asked = report.llm_text([row]).split("\n")[:4]
    assert asked == [
        "  asked     one",
        "          | ",
        "          | 0.000 s  rank  model",
    ]


def test_text_from_outside_fetches_no_picture_and_draws_no_table_in_the_viewer() -> None:
    text = markdown.plain("![a](http://x/y.png) <img src=x> a|b [r]: http://x\x1b \\")
    assert text == r"!\[a]\(http://x/y.png) \<img src=x> a\|b [r]\: http://x\\x1b \\"
