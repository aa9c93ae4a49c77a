"""Tells whether this machine can show a viewer."""

import os
import sys

DISPLAYS = ("DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET")
"""Environment variables of Linux; one of them names the display if there is one."""


def has_display() -> bool:
    """Whether there is a display; returns at once.

    The viewer itself needs seconds to notice that there is none, and accepts connections before.
    """
    return sys.platform != "linux" or any(map(os.environ.get, DISPLAYS))
