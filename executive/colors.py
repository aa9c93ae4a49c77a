"""Colours, and what they are called."""

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
"""Up to which hue (degrees) a colour has this name."""
COLORS = ("black", "grey", "white", "brown", *dict.fromkeys(name for _, name in _HUES))
OTHER_SPELLINGS = {"gray": "grey"}
_BLACK_BELOW, _WHITE_FROM = 0.2, 0.8
"""Of the brightest channel; what has no hue and is between them is grey."""
_COLORED_FROM = 0.15
"""Of saturation."""
_BROWN_BELOW, _PINK_BELOW = 0.7, 0.5
"""Dark orange is brown, pale red is pink: of the brightest channel, and of saturation."""


def color_name(red: float, green: float, blue: float) -> str:
    """The name of `COLORS` that is nearest to a colour, of channels in [0, 1]."""
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
