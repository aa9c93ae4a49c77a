"""What README and docs point to is there: links, headings, files, folders, modules."""

import re
from importlib.util import find_spec
from pathlib import Path
from pkgutil import resolve_name
from urllib.parse import unquote

import pytest

ROOT = Path(__file__).parents[2]
PAGES = sorted(p.relative_to(ROOT) for p in (*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")))
EXAMPLES = sorted(p.relative_to(ROOT) for p in (ROOT / "docs" / "examples").glob("*.[pt]*"))
PACKAGES = "executive|trees|kb|sim|logs"
LINK = re.compile(r"\]\((?!\w+:)([^)\s]+)\)")
FILE = re.compile(rf"(?<![\w/.-])(?:{PACKAGES}|tests|docs)/[\w/.-]*\w/?")
MODULE = re.compile(rf"\b(?:python -m|from|import) ((?:{PACKAGES})(?:\.\w+)*)\b")
NAME = re.compile(rf"`((?:{PACKAGES})(?:\.\w+)+)")
TO_BE_WRITTEN = {
    "trees/deeds/show.py",
}
"""What a page has its reader write."""


def text_of(page: Path) -> str:
    return (ROOT / page).read_text(encoding="utf-8")


def anchors(page: Path) -> set[str]:
    """The headings of a page as links name them: lower case, hyphens, punctuation left out."""
    headings = re.findall(r"^#+ (.+)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def test_there_are_pages() -> None:
    assert {"README.md", "CONTRIBUTING.md", "docs/architecture.md"} <= set(map(str, PAGES))


@pytest.mark.parametrize("page", PAGES, ids=str)
def test_every_link_leads_somewhere(page: Path) -> None:
    for link in LINK.findall(text_of(page)):
        path, _, anchor = unquote(link).partition("#")
        target = (ROOT / page).parent / path if path else ROOT / page
        assert target.exists(), f"{page}: {link}"
        assert not anchor or anchor in anchors(target), f"{page}: no heading for {link}"


@pytest.mark.parametrize("page", [*PAGES, *EXAMPLES], ids=str)
def test_every_file_that_is_named_exists(page: Path) -> None:
    named = {name.rstrip("/").replace("NAME", "*") for name in FILE.findall(text_of(page))}
    assert [name for name in named - TO_BE_WRITTEN if not any(ROOT.glob(name))] == []


@pytest.mark.parametrize("page", PAGES, ids=str)
def test_every_module_that_is_named_exists(page: Path) -> None:
    named = set(MODULE.findall(text_of(page)))
    assert [name for name in named if find_spec(name) is None] == []


@pytest.mark.parametrize("page", PAGES, ids=str)
def test_every_python_name_that_is_quoted_exists(page: Path) -> None:
    for name in NAME.findall(text_of(page)):
        resolve_name(name)
