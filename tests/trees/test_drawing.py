"""`python -m trees show`: the tree as a picture."""

import re
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree

import pytest

from trees.__main__ import build, main
from trees.drawing import svg

SVG = "{http://www.w3.org/2000/svg}"


def texts(picture: str) -> list[str]:
    return [element.text or "" for element in ElementTree.fromstring(picture).iter(f"{SVG}text")]


def test_every_behaviour_is_drawn_once_beside_its_parent() -> None:
    tree = build("okb+llm+mem", "generate")
    drawn = svg(tree)
    nodes = list(tree.iterate())
    assert drawn.count("<path") == len(nodes) - 1
    names = [re.sub(r"^\W ", "", text) for text in texts(drawn)]
    assert all(node.name in names for node in nodes)


def test_boxes_do_not_overlap() -> None:
    picture = ElementTree.fromstring(svg(build("okb+llm+mem", "generate")))
    boxes = [
        tuple(float(rect.attrib[name]) for name in ("x", "y", "width", "height"))
        for rect in picture.iter(f"{SVG}rect")
        if "x" in rect.attrib
    ]
    assert len(boxes) > 100
    for (x, y, w, h), (x2, y2, w2, h2) in combinations(boxes, 2):
        assert x2 >= x + w or x >= x2 + w2 or y2 >= y + h or y >= y2 + h2


@pytest.mark.parametrize(
    ("options", "has", "lacks"),
    [
        (["--knowledge", "okb"], "ask where", "llm"),
        (["--elicit", "rank"], "llm ranks places", "inquire"),
        (["--elicit", "generate"], "existence check", "ranks"),
    ],
)
def test_the_tree_is_as_built_for_the_settings(
    options: list[str], has: str, lacks: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["show", *options]) == 0
    printed = capsys.readouterr().out
    assert has in printed
    assert lacks not in printed


def test_the_picture_is_written_to_a_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["show", "--svg", str(tmp_path / "tree.svg")]) == 0
    assert ElementTree.parse(tmp_path / "tree.svg").getroot().tag == f"{SVG}svg"
    assert main(["show", "--svg", str(tmp_path / "nowhere" / "tree.svg")]) == 2
    assert "cannot be written" in capsys.readouterr().err
