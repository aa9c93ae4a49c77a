"""Tries out a network from outside in a process of its own.

A network that crashes OpenCV would crash the robot's process, too. This file is also the program of
the other process: it reads the network from standard input, runs it on two pictures, and writes to
standard output what went wrong.
"""

import os
import re
import resource
import subprocess
import sys
from hashlib import sha256
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

MOST_MEMORY = 8 * 2**30
"""Limit for the memory of the other process (bytes)."""
LONGEST_S = 60.0
"""Time limit for the other process (s)."""
MOST_NUMBERS = 50_000_000
"""The largest number of elements in the outputs for one picture."""
_LACKS = re.compile(r"""Can't create layer .* of type "([^"]+)\"""")
"""OpenCV's message about an unknown operation."""

_tried: dict[tuple[bytes, int, int, bool], str] = {}


def try_out(content: bytes, height: int, width: int, takes_bytes: bool) -> str:
    """Why a network cannot be run on pictures of this size; empty if it can."""
    key = (sha256(content).digest(), height, width, takes_bytes)
    if key not in _tried:
        _tried[key] = _run_elsewhere(content, height, width, takes_bytes)
    return _tried[key]


def _run_elsewhere(content: bytes, height: int, width: int, takes_bytes: bool) -> str:
    command = [sys.executable, "-P", str(Path(__file__)), str(height), str(width)]
    try:
        ended = subprocess.run(
            [*command, "uint8" if takes_bytes else "float32"],
            input=content,
            capture_output=True,
            env={name: value for name, value in os.environ.items() if not _is_ours(name)},
            timeout=LONGEST_S,
        )
    except subprocess.TimeoutExpired:
        return f"it takes longer than {LONGEST_S:g} s for two pictures"
    if ended.returncode:
        return "OpenCV breaks down on it"
    return ended.stdout.decode(errors="replace")


def _is_ours(name: str) -> bool:
    """Whether an environment variable is ours: it may be a secret, and is not passed on."""
    return name.startswith("EXECUTIVE_")


def network(content: bytes) -> cv2.dnn.Net:
    """Load a network from the content of a file.

    Raises:
        cv2.error: if OpenCV cannot read it.
    """
    return cv2.dnn.readNetFromONNX(np.frombuffer(content, np.uint8))


def run(
    net: cv2.dnn.Net, picture: NDArray[np.uint8], takes_bytes: bool
) -> list[NDArray[np.float32]]:
    """Run a network on a picture (h, w, 3); return all outputs.

    Raises:
        cv2.error: if OpenCV cannot run it.
    """
    if takes_bytes:
        net.setInput(cv2.dnn.blobFromImage(picture, ddepth=cv2.CV_8U))
    else:
        net.setInput(cv2.dnn.blobFromImage(picture, 1 / 255))
    outputs = net.forward(net.getUnconnectedOutLayersNames())
    return [np.asarray(output, np.float32) for output in outputs]


def pictures(height: int, width: int) -> tuple[NDArray[np.uint8], ...]:
    """The pictures (height, width, 3) to try a network with: one black, one of noise."""
    noise = np.random.default_rng(0).integers(0, 256, (height, width, 3), np.uint8)
    return np.zeros_like(noise), noise


def main() -> None:
    """Try the network on standard input."""
    height, width, kind = sys.argv[1:]
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        net = network(sys.stdin.buffer.read())
        for picture in pictures(int(height), int(width)):
            if sum(output.size for output in run(net, picture, kind == "uint8")) > MOST_NUMBERS:
                print("its output is absurdly large", end="")
                return
    except cv2.error as error:
        lacks = _LACKS.search(error.err)
        why = f"has no operation {lacks[1]}" if lacks else f"cannot run it: {error.err}"
        print(f"OpenCV {why}", end="")
    except MemoryError:
        print("it takes too much memory", end="")


if __name__ == "__main__":
    main()
