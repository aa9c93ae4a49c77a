"""A network from outside is run in a process of its own first.

One on which OpenCV breaks down would take the robot's process with it. This file is the program of
that process, too: it reads the network from standard input, runs it on two pictures, and says on
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
LONGEST_S = 60.0
MOST_NUMBERS = 50_000_000
"""In the outputs for one picture."""
_LACKS = re.compile(r"""Can't create layer .* of type "([^"]+)\"""")
"""How OpenCV says that it does not know an operation."""

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
    """Whether a variable of the environment is a setting of ours, such as a key: not for others."""
    return name.startswith("EXECUTIVE_")


def network(content: bytes) -> cv2.dnn.Net:
    """The network of a file.

    Raises:
        cv2.error: if OpenCV cannot read it.
    """
    return cv2.dnn.readNetFromONNX(np.frombuffer(content, np.uint8))


def run(
    net: cv2.dnn.Net, picture: NDArray[np.uint8], takes_bytes: bool
) -> list[NDArray[np.float32]]:
    """The outputs for a picture (h, w, 3).

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
    """One black, one of noise: what a network is tried with."""
    noise = np.random.default_rng(0).integers(0, 256, (height, width, 3), np.uint8)
    return np.zeros_like(noise), noise


def main() -> None:
    """Try the network."""
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
