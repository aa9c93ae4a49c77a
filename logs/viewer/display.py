"""Whether a viewer can be shown on this machine."""

import os
import sys

DISPLAYS = ("DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET")
"""Variables of the environment, one of which names a display where Linux has one."""


def has_display() -> bool:
    """Whether there is a display, told at once.

    The viewer itself needs seconds to find out that there is none, and can be reached before.
    """
    return sys.platform != "linux" or any(map(os.environ.get, DISPLAYS))
