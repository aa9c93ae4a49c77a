"""Ears with a model of the user's own, which sherpa-onnx runs on this machine.

A file that does not fit makes that library end the whole process. So each model is first loaded and
tried in another process.
"""

import os
import re
import subprocess
import sys
from dataclasses import asdict
from json import dumps, loads
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from executive.errors import InputError
from executive.servers.key import EARS_KEY, LLM_KEY
from executive.speech.interfaces import Reading
from executive.speech.onnx_files import Kind, OnnxFiles, onnx_files
from executive.speech.sound import RATE_HZ, Sound, is_silent
from executive.speech.transcript import said
from executive.text import printable

if TYPE_CHECKING:
    from sherpa_onnx import OfflineRecognizer

NAME = "sherpa-onnx"
MISSING = "pip install 'robot-executive[speech-onnx]'"
THREADS = 2
PATIENCE_S = 120.0
"""How long loading and trying a model may take (s)."""
LONGEST_FAULT = 300
FULL_SCALE = 32768.0
_POSITION = re.compile(r"\S+\.(?:cc|h):\S*\d+ ?")
"""The position in its own source code, in the library's error messages."""


class SherpaEars:
    """Implements `Ears`. It gives no confidence."""

    name = NAME

    def __init__(self, folder: Path, language: str = "en") -> None:
        """Load the model in a folder; some models use `language` (ISO 639-1).

        Raises:
            InputError: if the library is not installed, or the folder has no such model.
        """
        try:
            import sherpa_onnx  # noqa: F401 - of the extra `speech-onnx`
        except ImportError:
            raise InputError(NAME, "it is not installed", MISSING) from None
        files = onnx_files(folder)
        _try(folder, files, language)
        self._recognizer = recognizer(files, language)

    def hear(self, sound: Sound) -> Reading:
        """Recognise an utterance."""
        if is_silent(sound):
            return Reading(self.name, "")
        try:
            return Reading(self.name, said(heard(self._recognizer, sound)))
        except RuntimeError as error:
            problem = f"{NAME} failed: {printable(error)[:LONGEST_FAULT]}"
            return Reading(self.name, "", problem=problem)

    def close(self) -> None:
        """Do nothing: no resource stays open."""


def recognizer(files: OnnxFiles, language: str) -> "OfflineRecognizer":
    """Load a model of this kind."""
    from sherpa_onnx import OfflineRecognizer

    match files.kind:
        case Kind.TRANSDUCER:
            return OfflineRecognizer.from_transducer(**files.paths, num_threads=THREADS)
        case Kind.WHISPER:
            return OfflineRecognizer.from_whisper(
                **files.paths, num_threads=THREADS, language=language
            )
        case Kind.SENSE_VOICE:
            return OfflineRecognizer.from_sense_voice(
                **files.paths, num_threads=THREADS, language=language
            )


def heard(recognizer: "OfflineRecognizer", sound: Sound) -> str:
    """The text that the recogniser gives for a sound."""
    stream = recognizer.create_stream()
    stream.accept_waveform(RATE_HZ, sound.astype(np.float32) / FULL_SCALE)
    recognizer.decode_stream(stream)
    return str(stream.result.text)


def _try(folder: Path, files: OnnxFiles, language: str) -> None:
    """Load a model and use it once, in another process.

    Raises:
        InputError: if that fails; with the library's message.
    """
    environment = {k: v for k, v in os.environ.items() if k not in (LLM_KEY, EARS_KEY)}
    environment["PYTHONPATH"] = os.pathsep.join(part or os.getcwd() for part in sys.path)
    command = [sys.executable, "-P", "-c", "from executive.speech.sherpa import main; main()"]
    given = dumps({"files": asdict(files), "language": language})
    try:
        child = subprocess.run(
            [*command, given],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=PATIENCE_S,
            env=environment,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise _no_model(folder, files, f"it takes longer than {PATIENCE_S:.0f} s") from None
    if child.returncode:
        lines = (child.stderr or child.stdout).decode(errors="replace").strip().splitlines()
        raise _no_model(folder, files, lines[-1] if lines else "it does not say why")


def _no_model(folder: Path, files: OnnxFiles, why: str) -> InputError:
    said = _POSITION.sub("", why)[:LONGEST_FAULT]
    what = f"{NAME} cannot use its files as a {files.kind} model: {said}"
    return InputError(str(folder), what, "give a model that is not for streaming, all of one kind")


def main() -> None:
    """Load a model and recognise a second of noise; the program of `_try`."""
    given = loads(sys.argv[1])
    files = OnnxFiles(Kind(given["files"]["kind"]), given["files"]["paths"])
    noise = np.random.default_rng(0).normal(0, 300, RATE_HZ).astype(np.int16)
    try:
        heard(recognizer(files, given["language"]), noise)
    except Exception as error:  # any error becomes one line
        sys.exit(printable(error))
