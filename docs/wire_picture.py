"""Makes docs/served-robot.png: `python docs/wire_picture.py`. Both windows, as they are printed.

The robot is served, driven over the wire, and stopped again.
"""

import signal
import subprocess
import sys
import tempfile
import textwrap
from pathlib import Path

from matplotlib import get_data_path
from PIL import Image, ImageDraw, ImageFont

HERE = Path(__file__).parent
SERVE = "python -m sim serve --home four_rooms"
DRIVE = 'python -m executive --robot ws://127.0.0.1:9090 --profile served "Bring a sugar_box"'
WIDTH, SIZE, PAD, COLUMNS = 1180, 18, 18, 104
DARK, BAR, TEXT, TYPED = "#1d2229", "#323a45", "#d7dde5", "#8fd18f"


def windows() -> tuple[list[str], list[str]]:
    """What both print."""
    with tempfile.TemporaryDirectory() as runs:
        serve = [sys.executable, *SERVE.split()[1:]]
        with subprocess.Popen(serve, stdout=subprocess.PIPE, text=True) as served:
            assert served.stdout is not None
            first = served.stdout.readline()
            words = [*DRIVE.partition(' "')[0].split()[1:], "Bring a sugar_box"]
            quiet = ("--user", "none", "--runs", runs)
            driven = subprocess.run(
                [sys.executable, "-u", *words, *quiet],
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,  # there the robot speaks
                text=True,
                check=True,
            )
            served.send_signal(signal.SIGINT)
    shown = driven.stdout.replace(runs, "runs")
    return first.splitlines(), shown.splitlines()


def draw(panes: list[tuple[str, str, list[str]]], into: Path) -> None:
    """The windows, one below the other: title, what was typed, what was printed."""
    font = ImageFont.truetype(f"{get_data_path()}/fonts/ttf/DejaVuSansMono.ttf", SIZE)
    step = SIZE + 8
    texts = [(title, typed, _wrapped(lines)) for title, typed, lines in panes]
    heights = [step * (2 + len(lines)) + 3 * PAD for _, _, lines in texts]
    picture = Image.new("RGB", (WIDTH, sum(heights) + PAD * (len(texts) - 1)), "white")
    pen, top = ImageDraw.Draw(picture), 0
    for (title, typed, lines), height in zip(texts, heights, strict=True):
        pen.rounded_rectangle((0, top, WIDTH - 1, top + height), 12, fill=DARK)
        pen.rounded_rectangle((0, top, WIDTH - 1, top + step + PAD), 12, fill=BAR)
        pen.text((PAD, top + PAD / 2), title, TEXT, font)
        pen.text((PAD, top + step + 1.5 * PAD), f"$ {typed}", TYPED, font)
        for number, line in enumerate(lines):
            pen.text((PAD, top + step * (number + 2) + 1.5 * PAD), line, TEXT, font)
        top += height + PAD
    picture.quantize(32).save(into, optimize=True)


def _wrapped(lines: list[str]) -> list[str]:
    return [part for line in lines for part in textwrap.wrap(line, COLUMNS) or [""]]


if __name__ == "__main__":
    served, driven = windows()
    one = ("the robot, simulated and served", SERVE, served)
    other = ("the executive, over the wire", DRIVE, driven)
    draw([one, other], HERE / "served-robot.png")
