"""ONNX files as strangers export them: read, or refused in a sentence, and never trusted."""

import random
from collections.abc import Callable
from pathlib import Path

import numpy as np
import onnx
import pytest
from hypothesis import given
from hypothesis import strategies as st
from onnx import TensorProto, helper
from onnx_models import APPLE, MUG, NAMES, SIZE, frame, known, v5, v8, write_model

from executive.errors import InputError
from executive.perception import onnx_file, onnx_trial
from executive.perception.detector import OnnxDetector
from executive.perception.onnx_file import read_onnx
from executive.perception.yolo import Layout, layout_of, read

Change = Callable[[onnx.ModelProto], object]


def changed(path: Path, *changes: Change) -> Path:
    model = onnx.load(path)
    for change in changes:
        change(model)
    path.write_bytes(model.SerializeToString())
    return path


def said(model: onnx.ModelProto) -> onnx.TensorProto:
    """The tensor that the network always says."""
    return model.graph.initializer[0]


def says(key: str, value: str) -> Change:
    return lambda model: model.metadata_props.add(key=key, value=value)


def takes(kind: int) -> Change:
    """Another type of picture."""

    def change(model: onnx.ModelProto) -> None:
        model.graph.input[0].type.tensor_type.elem_type = kind
        cast = helper.make_node("Cast", ["images"], ["as_float"], to=TensorProto.FLOAT)
        model.graph.node[0].input[0] = "as_float"
        model.graph.node.insert(0, cast)

    return change


def takes_shape(*shape: int | str) -> Change:
    def change(model: onnx.ModelProto) -> None:
        kind = helper.make_tensor_value_info("images", TensorProto.FLOAT, shape)
        model.graph.input[0].CopyFrom(kind)

    return change


def ended(*rows: tuple[float, ...], number: int = 300) -> np.ndarray:
    """Corners, score, class: suppression of overlaps is done."""
    output = np.zeros((1, number, 6), np.float32)
    output[0, : len(rows)] = np.array(rows).reshape(-1, 6)
    return output


CORNERS = (15, 26, 25, 34, 0.9, 0)


def boxes_of(detector: OnnxDetector) -> list[tuple[str, int, int, int, int]]:
    found = detector.detect(frame())
    return [(d.label, d.box.left, d.box.top, d.box.width, d.box.height) for d in found]


AN_APPLE = [("apple", 15, 26, 10, 8)]


@pytest.mark.parametrize("names", [["apple"], ["apple", "mug"], ["apple", "mug", "b", "c"]])
def test_an_output_with_overlaps_suppressed_is_read(tmp_path: Path, names: list[str]) -> None:
    path = write_model(tmp_path, ended(CORNERS), str(names))
    assert boxes_of(OnnxDetector(path, known)) == AN_APPLE


def test_boxes_that_the_network_lets_overlap_stay(tmp_path: Path) -> None:
    again = (16, 26, 26, 34, 0.8, 0)
    path = write_model(tmp_path, ended(again, CORNERS), "['apple']")
    assert [d.confidence for d in OnnxDetector(path, known).detect(frame())] == pytest.approx(
        [0.9, 0.8]
    )


def test_one_class_of_the_older_layout_is_not_taken_for_corners(tmp_path: Path) -> None:
    path = write_model(tmp_path, v5([APPLE], classes=1), "['apple']")
    assert boxes_of(OnnxDetector(path, known)) == AN_APPLE


@pytest.mark.parametrize(("key", "value"), [("end2end", "True"), ("args", "{'nms': True}")])
def test_what_fits_two_layouts_is_read_as_its_metadata_says(key: str, value: str) -> None:
    output = ended((1, 2, 30, 40, 0.9, 0.5))
    assert layout_of([output], 1, {}, "x").kind == "objectness"
    assert layout_of([output], 1, {key: value}, "x").kind == "ended"


@pytest.mark.parametrize("kind", [TensorProto.UINT8, TensorProto.FLOAT16])
def test_pictures_may_be_taken_in_bytes_or_half_precision(tmp_path: Path, kind: int) -> None:
    path = changed(write_model(tmp_path, v8([APPLE])), takes(kind))
    assert boxes_of(OnnxDetector(path, known)) == AN_APPLE


@pytest.mark.parametrize("shape", [("batch", 3, "h", "w"), (-1, 3, -1, -1)])
def test_open_lengths_are_read_as_the_usual_ones(
    tmp_path: Path, shape: tuple[int | str, ...]
) -> None:
    path = changed(write_model(tmp_path, v8([APPLE])), takes_shape(*shape))
    about = read_onnx(path)
    assert (about.height, about.width) == (0, 0)
    OnnxDetector(path, known)


def test_a_grid_may_come_turned(tmp_path: Path) -> None:
    path = write_model(tmp_path, v8([APPLE, MUG]).transpose(0, 2, 1).copy())
    assert len(OnnxDetector(path, known).detect(frame())) == 2


@pytest.mark.parametrize("layout", [v5, v8])
def test_boxes_from_0_to_1_are_shares_of_the_picture(tmp_path: Path, layout) -> None:
    small = tuple(length / SIZE for length in APPLE[:4])
    path = write_model(tmp_path, layout([(*small, *APPLE[4:])]))
    assert boxes_of(OnnxDetector(path, known)) == AN_APPLE


def test_of_a_network_for_segmentation_the_boxes_are_read() -> None:
    masks = np.zeros((1, 32, 16, 16), np.float32)
    grid = np.concatenate((v8([APPLE]), np.full((1, 32, 20), -7, np.float32)), axis=1)
    layout = layout_of([grid, masks], 2, {}, "x")
    [box] = read(layout.rows([grid, masks], "x"), layout, 2).corners.tolist()
    assert box == [15, 26, 25, 34]
    with pytest.raises(InputError, match="its output is"):
        layout_of([grid], 2, {}, "x")


def refer_elsewhere(location: str) -> Change:
    def change(model: onnx.ModelProto) -> None:
        tensor = said(model)
        tensor.ClearField("raw_data")
        tensor.data_location = TensorProto.EXTERNAL
        tensor.external_data.add(key="location", value=location)

    return change


def refer_elsewhere_in_a_node(model: onnx.ModelProto) -> None:
    """The same of a constant within a branch of a branch."""
    tensor = onnx.TensorProto(data_location=TensorProto.EXTERNAL, dims=[1])
    constant = helper.make_node("Constant", [], ["c"], value=tensor)
    for _ in range(2):
        branch = helper.make_graph([constant], "branch", [], [])
        constant = helper.make_node("If", ["one"], ["c"], then_branch=branch, else_branch=branch)
    model.graph.node.append(constant)


def with_dims(*dims: int) -> Change:
    def change(model: onnx.ModelProto) -> None:
        said(model).ClearField("dims")
        said(model).dims.extend(dims)

    return change


def takes_more(model: onnx.ModelProto) -> None:
    model.graph.input.append(helper.make_tensor_value_info("scale", TensorProto.FLOAT, (1, 2)))


def uses_another_operation(model: onnx.ModelProto) -> None:
    model.opset_import.append(helper.make_opsetid("com.them", 1))
    model.graph.node[0].input[0] = "changed"
    model.graph.node.insert(
        0, helper.make_node("Magic", ["images"], ["changed"], domain="com.them")
    )


REFUSED = {
    "data beside it": (refer_elsewhere("w.bin"), "weights in another file, which is not read"),
    "data above it": (refer_elsewhere("../../etc/passwd"), "weights in another file"),
    "data anywhere": (refer_elsewhere("/etc/passwd"), "weights in another file"),
    "data of a node": (refer_elsewhere_in_a_node, "weights in another file"),
    "huge tensor": (with_dims(10**6, 10**6), "a tensor of 1000000 x 1000000 numbers"),
    "negative tensor": (with_dims(-1, 4), "a tensor of -1 x 4 numbers"),
    "huge pictures": (takes_shape(1, 3, 10**6, 10**6), "pictures of 1000000 x 1000000; .*4096"),
    "channels last": (takes_shape(1, SIZE, SIZE, 3), "export it with channels first"),
    "channels last, open": (takes_shape(1, "h", "w", 3), "export it with channels first"),
    "another input": (takes_more, r"inputs \(1, 3, 64, 64\), \(1, 2\); one input of .* no other"),
    "no such operation": (uses_another_operation, "OpenCV has no operation com.them.Magic; export"),
    "grey": (takes_shape(1, 1, SIZE, SIZE), r"\(1, 3, height, width\) is needed"),
    "several": (takes_shape(4, 3, SIZE, SIZE), "takes 4 pictures at once"),
    "doubles": (takes(TensorProto.DOUBLE), "type 11 .* float or uint8 or float16"),
    "pose": (says("task", "pose"), "for the task pose; export one that detects"),
}


@pytest.mark.parametrize(("change", "sentence"), REFUSED.values(), ids=REFUSED)
def test_what_cannot_be_or_reaches_elsewhere_is_refused_with_what_would_be_right(
    tmp_path: Path, change: Change, sentence: str
) -> None:
    path = changed(write_model(tmp_path, v8([APPLE])), change)
    with pytest.raises(InputError, match=f"tiny.onnx: .*{sentence}"):
        OnnxDetector(path, known)


def test_scores_that_are_no_probabilities_are_refused(tmp_path: Path) -> None:
    output = v8([APPLE])
    output[0, 4:] -= 4
    with pytest.raises(InputError, match="scores go from -4 to -3.19; export it with its sigmoid"):
        OnnxDetector(write_model(tmp_path, output), known)


def test_numbers_that_are_none_and_boxes_without_area_are_left_out(tmp_path: Path) -> None:
    rows = [(np.nan, 9, 9, 9, 0, 0.9), (np.inf, 9, 9, 9, 0, 0.9), (9, 9, -9, 9, 0, 0.9), APPLE]
    path = write_model(tmp_path, v8(rows))
    assert boxes_of(OnnxDetector(path, known)) == AN_APPLE


def test_classes_that_are_not_in_the_list_are_left_out(tmp_path: Path) -> None:
    path = write_model(tmp_path, ended((9, 9, 30, 30, 0.9, 7), CORNERS))
    assert boxes_of(OnnxDetector(path, known)) == AN_APPLE


def test_of_very_many_boxes_the_surest_are_looked_at(tmp_path: Path) -> None:
    crowd = v8([(20.0, 30.0, 10.0, 8.0, 0, 0.5)] * 50_000)
    crowd[0, 4, 40_000] = 0.9
    path = write_model(tmp_path, crowd)
    [apple] = OnnxDetector(path, known).detect(frame())
    assert apple.confidence == pytest.approx(0.9)


def test_a_file_on_which_opencv_breaks_down_takes_only_a_process_of_its_own(
    tmp_path: Path,
) -> None:
    """Some of these damaged copies end the process that runs them by a signal."""
    path = write_model(tmp_path, v8([APPLE]))
    whole = path.read_bytes()
    for seed in range(12):
        chance, damaged = random.Random(seed), bytearray(whole)
        for _ in range(3):
            damaged[chance.randrange(len(whole))] = chance.choice([0, 1, 127, 255])
        path.write_bytes(damaged)
        path.with_suffix(".names").write_text("\n".join(NAMES))
        try:
            OnnxDetector(path, known)
        except InputError as error:
            assert "tiny.onnx: " in str(error)  # noqa: PT017


@pytest.mark.parametrize(
    ("program", "longest_s", "sentence"),
    [
        (
            "import os, signal; os.kill(os.getpid(), signal.SIGSEGV)",
            180,
            "OpenCV breaks down on it",
        ),
        ("import time; time.sleep(600)", 1, "takes longer than 1 s"),
        ("print('OpenCV cannot run it: so it is', end='')", 180, "cannot run it: so it is"),
    ],
)
def test_how_a_trial_can_end_badly_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, program: str, longest_s: float, sentence: str
) -> None:
    trial = tmp_path / "trial.py"
    trial.write_text(program)
    monkeypatch.setattr(onnx_trial, "__file__", str(trial))
    monkeypatch.setattr(onnx_trial, "LONGEST_S", longest_s)
    path = write_model(tmp_path, v8([(1.0, 2.0, 3.0, 4.0, 0, len(program) / 100)]))
    with pytest.raises(InputError, match=f"tiny.onnx: .*{sentence}"):
        OnnxDetector(path, known)


def test_a_file_larger_than_any_network_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(onnx_file, "MOST_BYTES", 1 << 10)
    path = tmp_path / "big.onnx"
    path.write_bytes(bytes(2000))
    with pytest.raises(InputError, match="big.onnx: is larger than 1 kB"):
        read_onnx(path)


@given(st.binary(max_size=200))
def test_any_bytes_are_a_network_or_a_sentence(
    tmp_path_factory: pytest.TempPathFactory, content: bytes
) -> None:
    path = tmp_path_factory.getbasetemp() / "any.onnx"
    path.write_bytes(content)
    with pytest.raises(InputError, match="any.onnx: "):
        read_onnx(path)


@pytest.mark.parametrize(
    "names",
    ["[" * 5000, "{1e999: 'a'}", "['a'] * 9", str(["a"] * 10_001)]
    + ["{'apple', 'mug'}", "'ab'", "{3: 'apple', 7: 'mug'}", "{1: 'apple', 2: 'mug'}"],
)
def test_a_list_of_classes_that_is_none_is_a_sentence(tmp_path: Path, names: str) -> None:
    with pytest.raises(InputError, match="its metadata's names are"):
        OnnxDetector(write_model(tmp_path, v8([APPLE]), names), known)


def test_classes_beside_the_file_may_begin_with_a_byte_order_mark(tmp_path: Path) -> None:
    path = write_model(tmp_path, v8([APPLE]), None)
    path.with_suffix(".names").write_text("apple\nmug\n", encoding="utf-8-sig")
    assert OnnxDetector(path, known).names == NAMES


@given(
    st.lists(st.lists(st.floats(width=32), min_size=6, max_size=6), max_size=5),
    st.sampled_from([Layout(0, "ended", 6), Layout(0, "grid", 6), Layout(0, "objectness", 6)]),
)
def test_whatever_a_network_says_boxes_are_boxes(rows: list[list[float]], layout: Layout) -> None:
    classes = {"ended": 3, "grid": 2, "objectness": 1}[layout.kind]
    found = read(np.array(rows, np.float32).reshape(-1, 6), layout, classes)
    assert np.isfinite(found.corners).all()
    assert (found.corners[:, 2:] > found.corners[:, :2]).all()
    assert ((found.classes >= 0) & (found.classes < classes)).all()
