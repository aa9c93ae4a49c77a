"""Names of colours."""

from colorsys import rgb_to_hsv

Color = tuple[float, float, float, float]
"""Red, green, blue, opacity in [0, 1]."""

_HUES = (
    (15, "red"),
    (45, "orange"),
    (70, "yellow"),
    (165, "green"),
    (260, "blue"),
    (310, "purple"),
    (345, "pink"),
    (360, "red"),
)
"""The largest hue (degrees) of each name."""
COLORS = ("black", "grey", "white", "brown", *dict.fromkeys(name for _, name in _HUES))
OTHER_SPELLINGS = {"gray": "grey"}
_BLACK_BELOW, _WHITE_FROM = 0.2, 0.8
"""Limits of brightness, the largest channel; a colour without hue between them is grey."""
_COLORED_FROM = 0.15
"""The smallest saturation at which a colour has a hue."""
_BROWN_BELOW, _PINK_BELOW = 0.7, 0.5
"""Orange below this brightness is brown; bright red below this saturation is pink."""


def color_name(red: float, green: float, blue: float) -> str:
    """The name in `COLORS` for a colour with channels in [0, 1]."""
    hue, saturation, brightness = rgb_to_hsv(red, green, blue)
    if brightness < _BLACK_BELOW:
        return "black"
    if saturation < _COLORED_FROM:
        return "white" if brightness >= _WHITE_FROM else "grey"
    name = next(name for end, name in _HUES if hue * 360 <= end)
    if name == "orange" and brightness < _BROWN_BELOW:
        return "brown"
    if name == "red" and saturation < _PINK_BELOW and brightness >= _BROWN_BELOW:
        return "pink"
    return name
