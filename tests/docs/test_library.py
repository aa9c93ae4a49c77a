"""The code of docs/library.md runs, piece after piece, and its assertions hold."""

import re
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "docs" / "library.md"


def test_the_page_runs_from_top_to_bottom(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    pieces = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(), re.MULTILINE | re.DOTALL)
    names: dict[str, object] = {"__name__": "library"}
    for piece in pieces:
        exec(compile(piece, str(PAGE), "exec"), names)
    said = capsys.readouterr().out
    for promised in re.findall(r"print\(.*?\)  +# (.*)", "".join(pieces)):
        assert promised in said
