"""Ears by a file of the person's own: what may be in their folder, and what is told of it."""

import inspect
from pathlib import Path

import numpy as np
import pytest

from executive.config import load_settings
from executive.errors import InputError
from executive.speech.onnx_files import Kind, onnx_files
from executive.speech.sound import RATE_HZ
from executive.testing.contracts.ears import EarsContract

sherpa_onnx = pytest.importorskip("sherpa_onnx", reason="needs the extra speech-onnx")

from sherpa_models import write_sense_voice  # noqa: E402

from executive.speech.sherpa import SherpaEars, recognizer  # noqa: E402

SOUND = np.random.default_rng(0).normal(0, 3000, RATE_HZ).astype(np.int16)
ENCODER = "tiny.en-encoder.onnx"
DECODER = "tiny.en-decoder.onnx"
TRANSDUCER = ("encoder-1.onnx", "decoder-1.onnx", "joiner-1.onnx", "tokens.txt")
WHISPER = (ENCODER, DECODER, "tiny.en-tokens.txt")


def folder_of(tmp_path: Path, *names: str, content: str = "sound 0\n") -> Path:
    for name in names:
        (tmp_path / name).write_text(content)
    return tmp_path


@pytest.fixture(scope="module")
def ears(tmp_path_factory: pytest.TempPathFactory) -> SherpaEars:
    folder = tmp_path_factory.mktemp("model")
    return SherpaEars(write_sense_voice(folder, ["bring", "the", "mug"]))


class TestSherpaEars(EarsContract):
    @pytest.fixture
    def ears(self, ears: SherpaEars) -> SherpaEars:
        return ears


def test_what_the_model_hears_is_what_was_said_and_never_sure(ears: SherpaEars) -> None:
    reading = ears.hear(SOUND)
    assert (reading.text, reading.sure, reading.problem) == ("bring the mug", False, "")


@pytest.mark.parametrize(
    ("names", "kind", "paths"),
    [
        (TRANSDUCER, Kind.TRANSDUCER, TRANSDUCER),
        (WHISPER, Kind.WHISPER, WHISPER),
        (("model.onnx", "tokens.txt"), Kind.SENSE_VOICE, ("model.onnx", "tokens.txt")),
        (
            (*WHISPER, "tiny.en-encoder.int8.onnx", "README.md"),
            Kind.WHISPER,
            ("tiny.en-encoder.int8.onnx", DECODER, "tiny.en-tokens.txt"),
        ),
    ],
)
def test_the_kind_is_told_by_the_names_of_the_files(
    tmp_path: Path, names: tuple[str, ...], kind: Kind, paths: tuple[str, ...]
) -> None:
    files = onnx_files(folder_of(tmp_path, *names))
    assert files.kind == kind
    assert tuple(Path(path).name for path in files.paths.values()) == paths


@pytest.mark.parametrize(
    ("names", "told"),
    [
        ((), "there is no model in it; it should have the files of one model"),
        (("tokens.txt",), "there is no model in it"),
        ((ENCODER, "tokens.txt"), r"there is no decoder \(\*decoder\*.onnx\) beside the rest"),
        ((*TRANSDUCER[1:],), "there is no encoder .* of a transducer model"),
        ((ENCODER, DECODER), r"there is no file \*tokens.txt"),
        ((*WHISPER, "tokens.txt"), r"there are several files \*tokens.txt"),
        ((*WHISPER, "base-encoder.onnx"), "more than one encoder: base-encoder.onnx, tiny.en-"),
    ],
)
def test_what_is_missing_in_the_folder_is_told(
    tmp_path: Path, names: tuple[str, ...], told: str
) -> None:
    with pytest.raises(InputError, match=told):
        onnx_files(folder_of(tmp_path, *names))


def test_a_file_that_was_cut_off_whole_is_told(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"encoder-1.onnx: is empty; copy it again"):
        onnx_files(folder_of(tmp_path, *TRANSDUCER, content=""))


def test_a_folder_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="none: there is no such folder; give a folder with"):
        SherpaEars(tmp_path / "none")


@pytest.mark.parametrize("names", [TRANSDUCER, WHISPER, ("model.onnx", "tokens.txt")])
def test_files_that_are_no_model_are_told(tmp_path: Path, names: tuple[str, ...]) -> None:
    with pytest.raises(
        InputError, match="cannot use its files as a .* model: Load model from .*fail"
    ):
        SherpaEars(folder_of(tmp_path, *names))


def test_a_model_of_another_kind_ends_no_program(tmp_path: Path) -> None:
    folder = write_sense_voice(tmp_path, ["mug"], without="lfr_window_size")
    with pytest.raises(InputError, match="'lfr_window_size' does not exist in the metadata"):
        SherpaEars(folder)


@pytest.mark.parametrize(
    ("names", "call"), [(TRANSDUCER, "from_transducer"), (WHISPER, "from_whisper")]
)
def test_models_that_are_too_large_for_tests_are_asked_for_as_the_package_has_it(
    tmp_path: Path, names: tuple[str, ...], call: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    real, given = getattr(sherpa_onnx.OfflineRecognizer, call), {}
    monkeypatch.setattr(sherpa_onnx.OfflineRecognizer, call, lambda **kwargs: given.update(kwargs))
    files = onnx_files(folder_of(tmp_path, *names))
    recognizer(files, "en")
    assert files.paths.items() <= given.items()
    inspect.signature(real).bind(**given)


@pytest.mark.parametrize("folder", ["./models/whisper", "/models", "~/models"])
def test_a_folder_is_a_setting(folder: str) -> None:
    assert load_settings(ears=folder).ears == folder
