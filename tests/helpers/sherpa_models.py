"""A model of the kind SenseVoice that hears the same in every sound."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

FEATURES = 560
SPECIAL = ["<blank>", "<|en|>", "<|NEUTRAL|>", "<|Speech|>", "<|woitn|>"]
ITS_METADATA = {
    "lfr_window_size": 7,
    "lfr_window_shift": 6,
    "normalize_samples": 0,
    "with_itn": 14,
    "without_itn": 15,
    "lang_auto": 0,
    "lang_zh": 3,
    "lang_en": 4,
    "lang_ja": 11,
    "lang_ko": 12,
    "lang_yue": 7,
    "neg_mean": ",".join(["0"] * FEATURES),
    "inv_stddev": ",".join(["1"] * FEATURES),
}


def write_sense_voice(folder: Path, words: Sequence[str], without: str = "") -> Path:
    """Write it, if wanted without one entry of its metadata."""
    folder.mkdir(parents=True, exist_ok=True)
    tokens = [*SPECIAL, *(f"\u2581{word}" for word in words)]
    said = "".join(f"{token} {number}\n" for number, token in enumerate(tokens))
    (folder / "tokens.txt").write_text(said, "utf-8")
    path = [1, 2, 3, 4, *(n for word in range(5, len(tokens)) for n in (word, 0)), 0]
    model = helper.make_model(
        _graph(20.0 * np.eye(len(tokens), dtype=np.float32)[path] - 10.0),
        opset_imports=[helper.make_opsetid("", 13)],
        ir_version=8,
    )
    for name, value in {**ITS_METADATA, "vocab_size": len(tokens)}.items():
        if name != without:
            model.metadata_props.add(key=name, value=str(value))
    onnx.save(model, folder / "model.onnx")
    return folder


def _graph(rows: np.ndarray) -> onnx.GraphProto:
    """Says these rows, one a frame (four more frames than it is given), and the last for ever."""
    constants = {"one": 1, "zero": 0, "four": 4, "last": len(rows) - 1, "first": [0]}
    kept = [numpy_helper.from_array(np.array(value), name) for name, value in constants.items()]
    nodes = [
        helper.make_node("Shape", ["x"], ["shape"]),
        helper.make_node("Gather", ["shape", "one"], ["given"]),
        helper.make_node("Add", ["given", "four"], ["frames"]),
        helper.make_node("Range", ["zero", "frames", "one"], ["each"]),
        helper.make_node("Min", ["each", "last"], ["row"]),
        helper.make_node("Gather", ["rows", "row"], ["said"]),
        helper.make_node("Unsqueeze", ["said", "first"], ["logits"]),
    ]
    sound = helper.make_tensor_value_info("x", TensorProto.FLOAT, ["N", "T", FEATURES])
    numbers = [
        helper.make_tensor_value_info(name, TensorProto.INT32, ["N"])
        for name in ("x_length", "language", "text_norm")
    ]
    out = helper.make_tensor_value_info("logits", TensorProto.FLOAT, ["N", "L", rows.shape[1]])
    rows_kept = numpy_helper.from_array(rows.astype(np.float32), "rows")
    return helper.make_graph(nodes, "tiny", [sound, *numbers], [out], [*kept, rows_kept])
