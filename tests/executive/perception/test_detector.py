"""ONNX files of the YOLO family are read, and what is wrong with one is said."""

import logging
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from onnx_models import APPLE, MUG, NAMES, frame, known, v5, v8, write_model

from executive.config import load_settings
from executive.errors import InputError
from executive.perception.detector import LEARNED, OnnxDetector, letterbox


@pytest.mark.parametrize("layout", [v5, v8])
def test_both_layouts_of_output_are_read(tmp_path: Path, layout) -> None:
    detector = OnnxDetector(write_model(tmp_path, layout([MUG, APPLE])), known)
    apple, mug = detector.detect(frame())
    assert (apple.label, mug.label) == NAMES
    assert (apple.confidence, mug.confidence) == pytest.approx((0.81, 0.54), abs=1e-3)
    assert (apple.box.left, apple.box.top) == (15, 26)
    assert (apple.box.width, apple.box.height) == (10, 8) == apple.mask.shape[::-1]


def test_of_boxes_of_one_class_that_overlap_the_surest_stays(tmp_path: Path) -> None:
    again = (21.0, 30.0, 10.0, 8.0, 0, 0.6)
    as_mug = (20.0, 30.0, 10.0, 8.0, 1, 0.5)
    detector = OnnxDetector(write_model(tmp_path, v8([again, APPLE, as_mug])), known)
    found = detector.detect(frame())
    assert [d.label for d in found] == ["apple", "mug"]
    assert found[0].confidence == pytest.approx(0.81)


def test_what_is_hardly_anything_is_not_reported(tmp_path: Path) -> None:
    detector = OnnxDetector(write_model(tmp_path, v8([(20.0, 30.0, 10.0, 8.0, 0, 0.2)])), known)
    assert detector.detect(frame()) == ()


def test_a_wide_picture_is_letterboxed_and_boxes_come_back_to_it(tmp_path: Path) -> None:
    detector = OnnxDetector(write_model(tmp_path, v8([(32.0, 32.0, 16.0, 8.0, 0, 0.9)])), known)
    [apple] = detector.detect(frame(height=96, width=192))
    assert (apple.box.left, apple.box.top) == (72, 36)
    assert (apple.box.width, apple.box.height) == (48, 24)


@given(st.integers(8, 90), st.integers(8, 90), st.integers(16, 64), st.integers(16, 64))
def test_letterboxing_keeps_all_of_the_picture_and_its_proportions(
    rows: int, columns: int, height: int, width: int
) -> None:
    color = np.full((rows, columns, 3), 7, np.uint8)
    fitted, scale, (left, top) = letterbox(color, height, width)
    assert fitted.shape == (height, width, 3)
    inside = (fitted == 7).all(axis=-1)
    assert inside.sum() == round(rows * scale) * round(columns * scale)
    assert inside[top, left]
    assert (columns * scale > width - 1) or (rows * scale > height - 1)


def test_a_box_that_sticks_out_is_cut_at_the_edge(tmp_path: Path) -> None:
    detector = OnnxDetector(write_model(tmp_path, v8([(0.0, 0.0, 20.0, 20.0, 0, 0.9)])), known)
    [apple] = detector.detect(frame())
    assert (apple.box.left, apple.box.top, apple.box.width, apple.box.height) == (0, 0, 10, 10)


@pytest.mark.parametrize(
    "names", ["['apple', 'mug']", "{0: 'apple', 1: 'mug'}", '{"0": "apple", "1": "mug"}']
)
def test_the_class_list_may_be_in_the_metadata(tmp_path: Path, names: str) -> None:
    assert OnnxDetector(write_model(tmp_path, v8([]), names), known).names == NAMES


def test_the_class_list_beside_the_file_beats_the_metadata(tmp_path: Path) -> None:
    path = write_model(tmp_path, v8([]), "['a', 'b']")
    path.with_suffix(".names").write_text("apple\nmug\n")
    assert OnnxDetector(path, known).names == NAMES


def test_classes_that_the_ontology_does_not_know_are_ignored_and_named(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    rows = [APPLE, (50.0, 12.0, 8.0, 12.0, 1, 0.99)]
    with caplog.at_level(logging.WARNING):
        detector = OnnxDetector(write_model(tmp_path, v8(rows), "['apple', 'zebra']"), known)
    assert "ignored: zebra" in caplog.text
    assert [d.label for d in detector.detect(frame())] == ["apple"]


@pytest.mark.parametrize(
    ("output", "names", "sentence"),
    [
        (v8([], classes=3), str(list(NAMES)), r"output is \(1, 7, 20\).* 2 names; \(1, 6, n\)"),
        (np.zeros((1, 9)), str(list(NAMES)), r"output is \(1, 1, 9\) and"),
        (v8([]), None, "says nothing of its classes; put a name a line into .*tiny.names"),
        (v8([]), "5 +", "its metadata's names are '5 \\+'"),
        (v8([]), "['zebra', 'yak']", r"knows none of its classes \(zebra, yak"),
        (v8([]), "['mug', 'mug']", "has several classes that are called 'mug'; give each a name"),
    ],
)
def test_what_is_wrong_with_a_model_is_said_with_what_would_be_right(
    tmp_path: Path, output: np.ndarray, names: str | None, sentence: str
) -> None:
    path = write_model(tmp_path, output.astype(np.float32), names)
    with pytest.raises(InputError, match=sentence):
        OnnxDetector(path, known)


@pytest.mark.parametrize("content", [b"", b"not a network", b"\x08\x07", bytes(range(256))])
def test_what_is_no_onnx_file_is_called_so(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "my.onnx"
    path.write_bytes(content)
    with pytest.raises(InputError, match="my.onnx: is not an ONNX file"):
        OnnxDetector(path, known)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="none.onnx: cannot be read: No such file"):
        OnnxDetector(tmp_path / "none.onnx", known)


def test_the_setting_takes_learned_simulated_or_an_onnx_file() -> None:
    assert load_settings(detector="my.onnx").detector == "my.onnx"
    with pytest.raises(InputError, match="learned, simulated or a FILE.onnx"):
        load_settings(detector="yolo")


def test_our_network_names_no_path_of_the_machine_that_trained_it() -> None:
    assert b"/python3" not in LEARNED.read_bytes()
    assert b"network.py" not in LEARNED.read_bytes()
