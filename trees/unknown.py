"""What is said of things that nobody knows, or that have another colour than was said."""

from collections.abc import Sequence

from executive.interfaces import Knowledge
from executive.types import OtherColor


def unknown(knowledge: Knowledge, words: str) -> str:
    """That nothing is what was asked for, as a sentence without its full stop."""
    other = knowledge.other_color(words)
    said = _not_so(other) if other else f"I know no '{words}'"
    return said[:1].upper() + said[1:]


def unresolved(knowledge: Knowledge, words: str, offered: Sequence[str]) -> str:
    """The same as a reason why nothing was done, with what is nearest to it."""
    if other := knowledge.other_color(words):
        return _not_so(other)
    return f"I know no '{words}'" + (
        f"; the nearest that I know is {either(offered)}" * bool(offered)
    )


def nearest(knowledge: Knowledge, words: str) -> tuple[str, ...]:
    """What is most like what was asked for: of another colour, or called nearly so."""
    if other := knowledge.other_color(words):
        return tuple(name for name, _ in other.actual)
    return knowledge.nearest_names(words)


def either(names: Sequence[str]) -> str:
    """One of the names: "apple, pear or mug"."""
    return " or ".join((", ".join(names[:-1]), names[-1])) if len(names) > 1 else "".join(names)


def _not_so(other: OtherColor) -> str:
    wanted = " and ".join(other.wanted)
    match other.actual:
        case [(name, colors)]:
            return f"the {name} is {' and '.join(colors)}, not {wanted}"
        case [(one, _), (another, _)]:
            return f"neither {one} nor {another} is {wanted}"
        case several:
            return f"none of {either([name for name, _ in several])} is {wanted}"
