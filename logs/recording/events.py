"""Events to `/event` messages, and back: all that a behaviour may read of them."""

from dataclasses import replace
from typing import Any

import numpy as np

from executive.events import (
    Broke,
    DeadlinePassed,
    Ended,
    Event,
    HandFelt,
    Started,
    StopRequested,
)
from executive.records import LlmCall
from executive.types import (
    Answered,
    Box,
    Detection,
    Failed,
    Replied,
    Result,
    Saw,
    Scored,
    Succeeded,
)
from logs.recording.messages import llm_call_from_message, llm_call_to_message
from logs.recording.schema import MESSAGES
from logs.recording.sound import finite, whole

MOST_PIXELS = 100_000
"""Along an edge of a picture."""


def event_to_message(event: Event, mission_time_s: float) -> Any:
    """`/event`: all that a behaviour may read of it, and its gist in words.

    Args:
        event: as the executive took it.
        mission_time_s: when it took it, to the last digit.
    """
    message = MESSAGES["Event"](
        name=type(event).__name__, text=gist(event), mission_time_s=mission_time_s
    )
    match event:
        case DeadlinePassed(time):
            message.deadline_s = time
        case HandFelt(holding):
            message.holding, message.numb = bool(holding), holding is None
        case Ended(request, result):
            message.request = request
            message.result = type(result).__name__
            match result:
                case Failed(lost=lost):
                    message.lost = lost
                case Saw(number, detections):
                    message.frame_number = number
                    for detection in detections:
                        _add_detection(message.detections, detection)
                case Replied() | Scored():
                    message.llm_call.CopyFrom(llm_call_to_message(LlmCall(result)))
    return message


def event_from_message(message: Any) -> Event:
    """The event of an `/event` message; its detections are points without a mask."""
    match message.name:
        case "Started":
            return Started(message.text)
        case "Ended":
            return Ended(whole(message.request), _result(message))
        case "DeadlinePassed":
            return DeadlinePassed(finite(message.deadline_s))
        case "StopRequested":
            return StopRequested(message.text)
        case "HandFelt":
            return HandFelt(None if message.numb else message.holding)
        case "Broke":
            return Broke(message.text)
    raise ValueError(f"unknown event {message.name!r}")


def _result(message: Any) -> Result:
    match message.result:
        case "Succeeded":
            return Succeeded()
        case "Failed":
            return Failed(message.text, message.lost)
        case "Answered":
            return Answered(message.text)
        case "Saw":
            return Saw(message.frame_number, tuple(_detection(d) for d in message.detections))
        case "Replied" | "Scored":
            return llm_call_from_message(message.llm_call).result
    raise ValueError(f"unknown result {message.result!r}")


def _add_detection(field: Any, detection: Detection) -> None:
    box = detection.box
    message = field.add(
        label=detection.label,
        confidence=detection.confidence,
        left=box.left,
        top=box.top,
        width=box.width,
        height=box.height,
        cut_off=detection.cut_off,
    )
    if detection.position is not None:
        message.position.x, message.position.y, message.position.z = detection.position


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
    """An event on one line: its name, that of its result, its gist."""
    result = type(event.result).__name__ if isinstance(event, Ended) else ""
    return " ".join(filter(None, (type(event).__name__, result, gist(event))))


def gist(event: Event) -> str:
    """What is worth reading of an event, beside its name."""
    match event:
        case Started(words):
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
