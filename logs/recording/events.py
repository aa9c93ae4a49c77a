"""Converts events to the fields of `/event` messages and back, as far as behaviours read them."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, TypeVar, assert_never, get_args

import numpy as np

from executive.events import (
    BodyTold,
    Broke,
    DeadlinePassed,
    Ended,
    Event,
    HandFelt,
    Heard,
    Intervened,
    Listened,
    Started,
    StopRequested,
)
from executive.records import EventTaken, LlmCall
from executive.types.perception import Box, Detection
from executive.types.results import Answered, Failed, Replied, Result, Saw, Scored, Succeeded
from logs.recording.messages import llm_call_from_message, llm_call_to_fields
from logs.recording.sound import finite, whole

T = TypeVar("T")

MOST_PIXELS = 100_000
"""Limit for the position and the size of a detection's box (pixels)."""


def event_to_fields(taken: EventTaken) -> dict[str, Any]:
    """`/event`: everything that a behaviour may read, and a summary in words."""
    event = taken.event
    return {"name": type(event).__name__, "text": gist(event), **_other_fields(event)}


def _other_fields(event: Event) -> dict[str, Any]:
    match event:
        case DeadlinePassed(time):
            return {"deadline_s": time}
        case HandFelt(holding):
            return {"holding": bool(holding), "numb": holding is None}
        case Ended(request, result):
            return {"request": request, "result": type(result).__name__, **_result_fields(result)}
        case Intervened(by, deed, was):
            return {"by": by, "deed": deed, "was": was}
        case Listened(by, _, confidence, became):
            return {"by": by, "deed": became, "confidence": confidence}
        case Started() | StopRequested() | Heard() | Broke() | BodyTold():
            return {}
        case _:
            assert_never(event)


def _result_fields(result: Result) -> dict[str, Any]:
    match result:
        case Failed(lost=lost, unreachable=unreachable):
            return {"lost": lost, "unreachable": unreachable}
        case Saw(number, detections):
            return {"frame_number": number, "detections": [_to_fields(d) for d in detections]}
        case Replied() | Scored():
            return {"llm_call": llm_call_to_fields(LlmCall(result))}
        case Succeeded() | Answered():
            return {}
        case _:
            assert_never(result)


_EVENTS: dict[type, Callable[[Any], Event]] = {
    Started: lambda message: Started(message.text),
    Ended: lambda message: Ended(whole(message.request), _result(message)),
    DeadlinePassed: lambda message: DeadlinePassed(finite(message.deadline_s)),
    StopRequested: lambda message: StopRequested(message.text),
    Heard: lambda message: Heard(message.text),
    HandFelt: lambda message: HandFelt(None if message.numb else message.holding),
    Broke: lambda message: Broke(message.text),
    Intervened: lambda m: Intervened(m.by, m.deed, m.was, m.text),
    Listened: lambda m: Listened(m.by, m.text, finite(m.confidence), m.deed),
    BodyTold: lambda message: BodyTold(message.text),
}
_RESULTS: dict[type, Callable[[Any], Result]] = {
    Succeeded: lambda _: Succeeded(),
    Failed: lambda message: Failed(message.text, message.lost, message.unreachable),
    Answered: lambda message: Answered(message.text),
    Saw: lambda message: Saw(message.frame_number, tuple(map(_detection, message.detections))),
    Replied: lambda message: llm_call_from_message(message.llm_call).result,
    Scored: lambda message: llm_call_from_message(message.llm_call).result,
}


def by_name(read: Mapping[type, Callable[[Any], T]], union: Any) -> dict[str, Callable[[Any], T]]:
    """A decoder for each type of a union, by its name, which recordings contain.

    Raises:
        TypeError: if a type has no decoder.
    """
    if unread := [kind.__name__ for kind in get_args(union) if kind not in read]:
        what = f"{', '.join(unread)} could be recorded, but not be read"
        raise TypeError(f"{what}: say how in logs/recording/events.py")
    return {kind.__name__: how for kind, how in read.items()}


_EVENT_NAMED = by_name(_EVENTS, Event)
_RESULT_NAMED = by_name(_RESULTS, Result)


def event_from_message(message: Any) -> EventTaken:
    """The event of an `/event` message; its detections have their position as only point, no mask.

    Raises:
        ValueError: if the event or its result is unknown, or a value in it is invalid.
    """
    if message.name not in _EVENT_NAMED:
        raise ValueError(f"unknown event {message.name!r}")
    return EventTaken(_EVENT_NAMED[message.name](message))


def _result(message: Any) -> Result:
    if message.result not in _RESULT_NAMED:
        raise ValueError(f"unknown result {message.result!r}")
    return _RESULT_NAMED[message.result](message)


def _to_fields(detection: Detection) -> dict[str, Any]:
    box, at = detection.box, detection.position
    return {
        "label": detection.label,
        "confidence": detection.confidence,
        "left": box.left,
        "top": box.top,
        "width": box.width,
        "height": box.height,
        "cut_off": detection.cut_off,
        "position": None if at is None else dict(zip("xyz", at, strict=True)),
    }


def _detection(message: Any) -> Detection:
    box = Box(message.left, message.top, message.width, message.height)
    if not all(abs(edge) <= MOST_PIXELS for edge in (box.left, box.top, box.width, box.height)):
        raise ValueError(f"a detection in {box}, which is in no picture")
    mask = np.broadcast_to(np.bool_(False), (box.height, box.width))
    detection = Detection(message.label, message.confidence, box, mask, cut_off=message.cut_off)
    if not message.HasField("position"):
        return detection
    at = message.position
    return replace(detection, points=np.array([[at.x, at.y, at.z]], np.float32))


def in_words(event: Event) -> str:
    """An event on one line: its name, the name of its result, its summary."""
    result = type(event.result).__name__ if isinstance(event, Ended) else ""
    if isinstance(event, Intervened):
        result = f"{event.by}: {event.deed}:"
    if isinstance(event, Listened):
        result = f"{event.by} ({event.confidence:.2f}, {event.became}):"
    return " ".join(filter(None, (type(event).__name__, result, gist(event))))


def gist(event: Event) -> str:
    """A summary of an event, in addition to its name."""
    match event:
        case Started(words) | Heard(words) | BodyTold(words):
            return words
        case Ended(_, result):
            return _gist_of_result(result)
        case DeadlinePassed(time):
            return f"{time:.3f} s"
        case StopRequested(by):
            return by
        case HandFelt(holding):
            return "I cannot tell" if holding is None else "something" if holding else "nothing"
        case Broke(reason):
            return reason
        case Intervened(became=became):
            return became
        case Listened(text=text):
            return text


def _gist_of_result(result: Result) -> str:
    match result:
        case Failed(reason):
            return reason
        case Answered(text):
            return text
        case Saw(number, detections):
            labels = ", ".join(detection.label for detection in detections)
            return f"frame {number}: {labels or 'nothing'}"
        case Replied(request=request) | Scored(request=request):
            return request.label
        case _:
            return ""
