"""What to say about unknown things, and about things that have another colour than was said."""

from collections.abc import Sequence

from executive.language.wording import beginning, either
from executive.types.home import OtherColor
from trees.context import MissionContext


def unknown(context: MissionContext, words: str) -> str:
    """That the thing is unknown, as a sentence without the full stop."""
    return beginning(unresolved(context, words, ()))


def unresolved(context: MissionContext, words: str, offered: Sequence[str]) -> str:
    """The same as the reason of a failure, with the nearest known names."""
    if other := context.knowledge.other_color(words):
        return _not_so(context, other)
    if context.knowledge.is_place(words):
        return f"the {context.as_said(words)} is a place, and I find, take and bring only things"
    near = f"; the nearest that I know is {context.say.any_of(offered)}" if offered else ""
    return f"I know no '{context.as_said(words)}'{near}"


def nearest(context: MissionContext, words: str) -> tuple[str, ...]:
    """The objects most like the words: of another colour, or with a similar name."""
    if other := context.knowledge.other_color(words):
        return tuple(name for name, _ in other.actual)
    return () if context.knowledge.is_place(words) else context.knowledge.nearest_names(words)


def _not_so(context: MissionContext, other: OtherColor) -> str:
    say, wanted = context.say, " and ".join(other.wanted)
    match other.actual:
        case [(name, colors)]:
            return f"{say.are(name)} {' and '.join(colors)}, not {wanted}"
        case [(one, _), (another, _)]:
            return f"neither {say.the(one)} nor {say.the(another)} is {wanted}"
        case several:
            names = either([say.words(name) for name, _ in several])
            return f"none of {names} is {wanted}"
