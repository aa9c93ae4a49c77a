"""Finds the kind of a recogniser in a folder by its files' names, as sherpa-onnx ships them."""

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from executive.errors import InputError

LAYOUTS = """the files of one model of sherpa-onnx: encoder, decoder and joiner (a transducer), \
encoder and decoder (Whisper) or model (SenseVoice), each .onnx, and tokens.txt"""
PARTS = ("encoder", "decoder", "joiner", "model")


class Kind(StrEnum):
    """The supported families of models."""

    TRANSDUCER = "transducer"
    WHISPER = "Whisper"
    SENSE_VOICE = "SenseVoice"


@dataclass(frozen=True, slots=True)
class OnnxFiles:
    """The files of a model by their role, `tokens` among them, and its kind."""

    kind: Kind
    paths: dict[str, str]


NEEDED = {
    Kind.TRANSDUCER: ("encoder", "decoder", "joiner"),
    Kind.WHISPER: ("encoder", "decoder"),
    Kind.SENSE_VOICE: ("model",),
}


def onnx_files(folder: Path) -> OnnxFiles:
    """Find the model in a folder.

    Raises:
        InputError: if it is not a folder, or a file in it is missing, empty or there twice.
    """
    where = str(folder)
    if not folder.is_dir():
        raise InputError(where, "there is no such folder", f"give a folder with {LAYOUTS}")
    try:
        names = sorted(path.name for path in folder.iterdir() if path.is_file())
    except OSError as error:
        raise InputError(where, error.strerror or "cannot be read") from None
    found = {part: _file_of(where, part, names) for part in PARTS}
    kind = _kind(where, found)
    tokens = [name for name in names if name.endswith("tokens.txt")]
    if len(tokens) != 1:
        number = "are several files" if tokens else "is no file"
        raise InputError(where, f"there {number} *tokens.txt", f"it should have {LAYOUTS}")
    chosen = {part: found[part] for part in NEEDED[kind]} | {"tokens": tokens[0]}
    for name in chosen.values():
        if not (folder / name).stat().st_size:
            raise InputError(str(folder / name), "is empty", "copy it again")
    return OnnxFiles(kind, {part: str(folder / name) for part, name in chosen.items()})


def _file_of(where: str, part: str, names: list[str]) -> str:
    """The file for a role; of several precisions the smallest (int8); empty if there is none."""
    fitting = [name for name in names if name.endswith(".onnx") and part in name.lower()]
    small = [name for name in fitting if ".int8." in name]
    fitting = small or fitting
    if len(fitting) > 1:
        said = ", ".join(fitting)
        raise InputError(where, f"there is more than one {part}: {said}", "leave one of them there")
    return fitting[0] if fitting else ""


def _kind(where: str, found: dict[str, str]) -> Kind:
    if found["joiner"]:
        kind = Kind.TRANSDUCER
    elif found["encoder"] or found["decoder"]:
        kind = Kind.WHISPER
    elif found["model"]:
        kind = Kind.SENSE_VOICE
    else:
        raise InputError(where, "there is no model in it", f"it should have {LAYOUTS}")
    for part in NEEDED[kind]:
        if not found[part]:
            what = f"there is no {part} (*{part}*.onnx) beside the rest of a {kind} model"
            raise InputError(where, what, f"it should have {LAYOUTS}")
    return kind
