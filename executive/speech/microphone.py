"""Sources of sound: a WAV file, a folder of them, a pipe, or a program that records.

Sound comes in blocks of a tenth of a second. After each file there is silence, as after a sentence.
"""

import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import IO

import numpy as np

from executive.errors import InputError
from executive.speech.sound import RATE_HZ, Sound, read_wav

RECORDER = "arecord"
BLOCK = RATE_HZ // 10
PAUSE_S = 1.0
START_S = 0.3
"""A recorder that finds no device, or a busy one, ends within this time (s)."""
MOST_SAID = 1 << 16
NO_DEVICE = f"see what {RECORDER} -l lists, and that no other program records; or give a FILE.wav"
_POSITION = re.compile(r"^\w+: (?:\w+:\d+: )?")
"""The position in its own source code, in the recorder's error messages."""
RIGHT = f"give a FILE.wav, a folder of them, - for a pipe, or {RECORDER} for a microphone"


def microphone(name: str) -> Iterator[Sound]:
    """The blocks from this microphone, as they come; files are checked before the first block.

    Raises:
        InputError: if a file or program does not exist, or a file is not a readable WAV.
    """
    if name == "-":
        if sys.stdin is None or sys.stdin.closed:
            raise InputError("--microphone -", "standard input is closed", RIGHT)
        return blocks(sys.stdin.buffer)
    if name == RECORDER:
        return recorded()
    path = Path(name)
    files = sorted(path.glob("*.wav")) if path.is_dir() else [path]
    if path.is_dir() and not files:
        raise InputError(name, "there is no .wav file in this folder", RIGHT)
    return from_files([read_wav(file) for file in files])


def is_live(name: str) -> bool:
    """Whether sound goes on during recognition; files wait for it."""
    return name in ("-", RECORDER)


def from_files(sounds: list[Sound], wait: Callable[[float], None] = time.sleep) -> Iterator[Sound]:
    """The blocks of the files, in real time."""
    pause = np.zeros(int(PAUSE_S * RATE_HZ), dtype=np.int16)
    for sound in sounds:
        whole = np.concatenate([sound, pause])
        for at in range(0, len(whole), BLOCK):
            wait(BLOCK / RATE_HZ)
            yield whole[at : at + BLOCK]


def recorded() -> Iterator[Sound]:
    """The blocks from the default microphone of ALSA.

    Raises:
        InputError: if the program is missing, or ends, at once or later.
    """
    program = shutil.which(RECORDER)
    if program is None:
        raise InputError(f"--microphone {RECORDER}", "there is no such program", RIGHT)
    found = _recorded([program, "-q", "-t", "raw", "-f", "S16_LE", "-r", str(RATE_HZ), "-c", "1"])
    next(found)
    return found


def _recorded(command: list[str]) -> Iterator[Sound]:
    """An empty block when recording has begun; then the recorded ones."""
    quiet, out = subprocess.DEVNULL, subprocess.PIPE
    with (
        tempfile.TemporaryFile() as said,
        subprocess.Popen(command, stdin=quiet, stdout=out, stderr=said) as process,
    ):
        assert process.stdout
        try:
            with suppress(subprocess.TimeoutExpired):
                process.wait(START_S)
                raise _ended(process, said)
            yield np.zeros(0, np.int16)
            yield from blocks(process.stdout)
            process.wait()
            raise _ended(process, said)
        finally:
            process.kill()


def _ended(process: subprocess.Popen[bytes], said: IO[bytes]) -> InputError:
    """The error of a recorder that has ended, with its last message."""
    said.seek(0)
    lines = said.read(MOST_SAID).decode(errors="replace").strip().splitlines()
    why = _POSITION.sub("", lines[-1]) if lines else f"it ended with {process.returncode}"
    return InputError(f"--microphone {RECORDER}", f"nothing is recorded: {why}", NO_DEVICE)


def blocks(source: IO[bytes]) -> Iterator[Sound]:
    """The blocks of raw samples: 16 kHz, 16 bits, little-endian, one channel."""
    while content := source.read(2 * BLOCK):
        yield np.frombuffer(content[: len(content) // 2 * 2], "<i2").astype(np.int16)
