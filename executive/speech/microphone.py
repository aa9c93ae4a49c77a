"""Where sound comes from: a WAV file, a folder of them, a pipe, or a program that records.

It comes in blocks of a tenth of a second. After each file there is silence, as after a sentence.
"""

import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import IO

import numpy as np

from executive.errors import InputError
from executive.speech.sound import RATE_HZ, Sound, read_wav

RECORDER = "arecord"
BLOCK = RATE_HZ // 10
PAUSE_S = 1.0
RIGHT = f"give a FILE.wav, a folder of them, - for a pipe, or {RECORDER} for a microphone"


def microphone(name: str) -> Iterator[Sound]:
    """The blocks of this microphone, as they come; files are tried before the first block.

    Raises:
        InputError: if there is no such file or program, or a file is no WAV that can be read.
    """
    if name == "-":
        return blocks(sys.stdin.buffer)
    if name == RECORDER:
        return recorded()
    path = Path(name)
    files = sorted(path.glob("*.wav")) if path.is_dir() else [path]
    if path.is_dir() and not files:
        raise InputError(name, "there is no .wav file in this folder", RIGHT)
    return from_files([read_wav(file) for file in files])


def from_files(sounds: list[Sound], wait: Callable[[float], None] = time.sleep) -> Iterator[Sound]:
    """One file after the other, as slowly as they were spoken."""
    pause = np.zeros(int(PAUSE_S * RATE_HZ), dtype=np.int16)
    for sound in sounds:
        whole = np.concatenate([sound, pause])
        for at in range(0, len(whole), BLOCK):
            wait(BLOCK / RATE_HZ)
            yield whole[at : at + BLOCK]


def recorded() -> Iterator[Sound]:
    """What the default microphone of ALSA hears."""
    program = shutil.which(RECORDER)
    if program is None:
        raise InputError(f"--microphone {RECORDER}", "there is no such program", RIGHT)
    command = [program, "-q", "-t", "raw", "-f", "S16_LE", "-r", str(RATE_HZ), "-c", "1"]
    return _recorded(command)


def _recorded(command: list[str]) -> Iterator[Sound]:
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE) as process:
        assert process.stdout
        try:
            yield from blocks(process.stdout)
        finally:
            process.kill()


def blocks(source: IO[bytes]) -> Iterator[Sound]:
    """Raw samples: 16 kHz, 16 bits, little-endian, one channel."""
    while content := source.read(2 * BLOCK):
        yield np.frombuffer(content[: len(content) // 2 * 2], "<i2").astype(np.int16)
