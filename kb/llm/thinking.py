"""Separates a model's answer from its reasoning."""

import re

_NAMES = (
    "think|thinking|thought|thoughts|reasoning|reflection|scratchpad|seed:think|analysis|reason"
)
_MARK = re.compile(
    rf"<(/?)(?:{_NAMES})(?:\s[^<>]{{0,100}})?>|\[(/?)(?:{_NAMES})\]|\u25c1(/?)think\u25b7"
    r"|<\|(?:begin_of_thought|START_THINKING)\|>|<\|((?:end_of_thought|END_THINKING))\|>",
    re.IGNORECASE,
)
_CHANNEL = re.compile(r"<\|channel\|>\s*(\w+)(?:[^<]|<\|constrain\|>){0,200}<\|message\|>")
_WITHOUT_MARKS = re.compile(r"\s*analysis(?=[A-Z])")
_FINAL_WITHOUT_MARKS = "assistantfinal"
"""The form in which some servers return the channels of gpt-oss."""
_TURN_ENDS = re.compile(r"<\|(?:end|return|start|call)\|>")


def answer_of(text: str) -> tuple[str, bool]:
    """The text without the reasoning, and whether there was any.

    Reasoning is between `<think>` and `</think>` or similar marks. Without a closing mark it goes
    on to the end; without an opening mark (the chat template may contain it) it begins at the
    start.
    """
    if channels := list(_CHANNEL.finditer(text)):
        return _final_of(text, channels), True
    if _WITHOUT_MARKS.match(text):
        return text.partition(_FINAL_WITHOUT_MARKS)[2].strip(), True
    kept: list[str] = []
    inside, at, thought = False, 0, False
    for mark in _MARK.finditer(text):
        thought = True
        if any(mark.groups()):
            if not inside:
                kept.clear()
            inside, at = False, mark.end()
        elif not inside:
            kept.append(text[at : mark.start()])
            inside = True
    if not inside:
        kept.append(text[at:])
    return ("".join(kept).strip() if thought else text), thought


def _final_of(text: str, channels: list[re.Match[str]]) -> str:
    """The text of the last channel, if that is `final` (format of gpt-oss); else empty."""
    last = channels[-1]
    if last[1].lower() != "final":
        return ""
    return _TURN_ENDS.split(text[last.end() :], maxsplit=1)[0].strip()


def used_up(tokens: int) -> str:
    """The failure message of a model that was cut off before its answer."""
    return f"it used up its {tokens} tokens while thinking; raise max_tokens"
