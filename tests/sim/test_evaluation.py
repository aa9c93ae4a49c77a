"""The report of an evaluation, and its picture."""

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from sim.learning.__main__ import main
from sim.learning.evaluation import Judgement, draw_confusion, report
from sim.learning.frames import class_names
from sim.learning.metrics import Judged


def perfect(classes: int) -> Judgement:
    boxes = np.array([(50 * n, 0, 50 * n + 20, 30) for n in range(classes)], np.float64)
    numbers = np.arange(classes)
    counts = np.ones(classes, np.bool_)
    return Judgement(Judged(boxes, np.full(classes, 0.9), numbers, boxes, numbers, counts), (2.0,))


def test_the_report_has_every_class_and_the_figures_asked_for() -> None:
    count = len(class_names())
    text = report([perfect(count)] * 2, milliseconds=31.4, about="our.onnx")
    assert f"our.onnx: 2 scenes, {2 * count} things" in text
    assert "| mAP at IoU 0.5 | 1.000 |" in text
    assert f"| classes with a recall of at least 0.9 | {count} of {count} |" in text
    assert "| a 640 x 480 picture | 31 ms |" in text
    assert "| position by depth, error: median | 2.0 mm |" in text
    assert all(f"| {name} | 2 | 1.000 | 1.000 | 1.000 |" in text for name in class_names())


def test_classes_of_which_there_is_none_are_left_out_of_the_mean() -> None:
    assert "| mAP at IoU 0.5 | 1.000 |" in report([perfect(3)], 1.0, "x")


def test_the_confusions_are_drawn_with_their_numbers() -> None:
    table = np.array([[7, 1, 0], [0, 5, 2], [3, 0, 0]])
    svg = ElementTree.fromstring(draw_confusion(table, ("mug", "apple")))
    words = [element.text for element in svg.iter("{http://www.w3.org/2000/svg}text")]
    assert words.count("mug") == words.count("apple") == words.count("nothing") == 2
    assert {"7", "1", "5", "2", "3"} <= set(words)


def test_a_missing_detector_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["evaluate", "--detector", str(tmp_path / "none.onnx"), "--scenes", "1"]) == 2
    assert "none.onnx: cannot be read" in capsys.readouterr().err


@pytest.mark.physics
def test_a_scene_is_rendered_judged_and_its_things_are_placed_by_depth(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["evaluate", "--scenes", "1", "--validation", "--workers", "1"]) == 0
    said = capsys.readouterr().out
    assert "detector.onnx: 1 scenes" in said
    error_mm = float(said.split("error: median | ")[1].split(" mm")[0])
    assert error_mm < 20
