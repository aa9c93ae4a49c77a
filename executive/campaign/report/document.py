"""The parts of a report, and two formats for it: Markdown with picture files, and HTML."""

from base64 import b64encode
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from urllib.parse import quote

from executive.files import write_whole
from executive.text import printable


@dataclass(frozen=True, slots=True)
class Link:
    """A link to a file or folder, relative to the report."""

    text: str
    target: str


SAFE = "/ "
"""Characters that are not escaped in a link; a colon is, as it would mark a URL scheme."""

Cell = str | Sequence[Link]


@dataclass(frozen=True, slots=True)
class Heading:
    """The title (level 1) or the heading of a section."""

    text: str
    level: int = 2


@dataclass(frozen=True, slots=True)
class Text:
    """A paragraph of plain text."""

    text: str


@dataclass(frozen=True, slots=True)
class Table:
    """A table: column headings, and rows with as many cells."""

    heads: Sequence[str]
    rows: Sequence[Sequence[Cell]]


@dataclass(frozen=True, slots=True)
class Figure:
    """A drawing (SVG), with file name and caption."""

    name: str
    caption: str
    svg: str


Part = Heading | Text | Table | Figure

PICTURES = "plots"
"""Folder of the pictures, beside the report."""
NO_PLOTS = (
    "There are no plots: matplotlib is not installed (pip install 'robot-executive[campaign]')."
)
STYLE = """
body { font: 15px/1.5 sans-serif; max-width: 62em; margin: 2em auto; padding: 0 1em; color: #111 }
table { border-collapse: collapse; margin: 1em 0; font-size: 13px }
table { display: block; overflow-x: auto }
th, td { border-bottom: 1px solid #bbb; padding: 3px 9px; text-align: left; vertical-align: top }
th { border-bottom: 2px solid #555 }
figure { margin: 1.5em 0; break-inside: avoid } figure img { max-width: 100%; height: auto }
figcaption { font-size: 13px; color: #333 }
"""


def to_markdown(parts: Iterable[Part], pictures: str) -> str:
    """The report in Markdown (GitHub's tables); figures are files in the folder `pictures`."""
    return "\n\n".join(_markdown(part, pictures) for part in parts) + "\n"


def to_html(parts: Sequence[Part]) -> str:
    """The report as one self-contained HTML file."""
    title = next((part.text for part in parts if isinstance(part, Heading)), "")
    body = "\n".join(_html(part) for part in parts)
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f"<title>{escape(title)}</title>\n<style>{STYLE}</style>\n</head>\n"
        f"<body>\n{body}\n</body>\n</html>\n"
    )


def write_document(parts: Sequence[Part], folder: Path) -> None:
    """Write `report.md` with picture files, and the self-contained `report.html`.

    Raises:
        OSError: if they cannot be written; each file is then complete, or unchanged.
    """
    for part in parts:
        if isinstance(part, Figure):
            (folder / PICTURES).mkdir(exist_ok=True)
            write_whole(folder / PICTURES / f"{part.name}.svg", part.svg.encode())
    write_whole(folder / "report.md", to_markdown(parts, PICTURES).encode())
    write_whole(folder / "report.html", to_html(parts).encode())


def _markdown(part: Part, pictures: str) -> str:
    match part:
        case Heading(text, level):
            return f"{'#' * level} {text}"
        case Text(text):
            return _escaped(text)
        case Figure(name, caption, _):
            return f"![{caption}]({pictures}/{name}.svg)\n\n*{caption}*"
        case Table(heads, rows):
            lines = [heads, ["---"] * len(heads), *rows]
            return "\n".join(f"| {' | '.join(map(_markdown_cell, line))} |" for line in lines)


def _markdown_cell(cell: Cell) -> str:
    if isinstance(cell, str):
        return _escaped(cell).replace("|", "\\|")
    return " ".join(f"[{_escaped(link.text)}](<{quote(link.target, safe=SAFE)}>)" for link in cell)


def _escaped(text: str) -> str:
    """Escape Markdown, HTML tags, links and control characters."""
    plain = printable(text.replace("\n", " "))
    return plain.replace("*", "\\*").replace("<", "&lt;").replace("](", "]\\(")


def _html(part: Part) -> str:
    match part:
        case Heading(text, level):
            return f"<h{level}>{escape(text)}</h{level}>"
        case Text(text):
            return f"<p>{escape(text)}</p>"
        case Figure(_, caption, svg):
            data = b64encode(svg.encode()).decode()
            drawing = f'<img alt="{escape(caption)}" src="data:image/svg+xml;base64,{data}">'
            return f"<figure>{drawing}<figcaption>{escape(caption)}</figcaption></figure>"
        case Table(heads, rows):
            head = "".join(f"<th>{escape(cell)}</th>" for cell in heads)
            lines = ("".join(f"<td>{_html_cell(c)}</td>" for c in row) for row in rows)
            body = "\n".join(f"<tr>{line}</tr>" for line in lines)
            return f"<table>\n<tr>{head}</tr>\n{body}\n</table>"


def _html_cell(cell: Cell) -> str:
    if isinstance(cell, str):
        return escape(printable(cell.replace("\n", " ")))
    return " ".join(
        f'<a href="{quote(link.target, safe=SAFE)}">{escape(printable(link.text))}</a>'
        for link in cell
    )
