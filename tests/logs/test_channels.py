"""Every kind of record has its entry, and docs/log-format.md says what is in a recording."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, get_args

import pytest
from sample_mission import mission

import logs
from executive.events import Event
from executive.records import Record, Scene
from logs.recording import plain
from logs.recording.channels import (
    CHANNELS,
    MESSAGES,
    OF_KIND,
    TOPICS,
    Channel,
    by_kind,
    decoder,
    named,
)
from logs.recording.context import Context
from logs.recording.events import by_name
from logs.recording.schema import PACKAGE, STAMPED

FORMAT = (Path(logs.__file__).parent.parent / "docs" / "log-format.md").read_text()


@dataclass(frozen=True)
class BatteryLevel:
    volts: float
    cells: tuple[int, ...]
    charging: bool
    where: str


LEVEL = BatteryLevel(12.4, (4, 4, 4), True, "at the dock")


def battery(message: str = "BatteryLevel") -> Channel[Any]:
    kind: Any = BatteryLevel
    definitions = plain.definition(BatteryLevel, message)
    encode = plain.to_fields(BatteryLevel)
    return Channel("/battery", kind, message, lambda told, _: encode(told), None, definitions)


def test_a_kind_of_record_without_an_entry_is_named_with_the_place_to_give_it_one() -> None:
    kinds = (*get_args(Record), BatteryLevel)
    with pytest.raises(TypeError, match=r"BatteryLevel would not be .* logs/recording/channels.py"):
        by_kind(CHANNELS, kinds)
    assert by_kind((*CHANNELS, battery()), kinds)[BatteryLevel]


def test_an_event_that_could_be_recorded_but_not_be_read_is_named() -> None:
    with pytest.raises(TypeError, match=r"StopRequested.* logs/recording/events.py"):
        by_name({kind: kind for kind in get_args(Event)[:3]}, Event)


def test_two_messages_of_one_name_are_refused() -> None:
    definitions = [
        (name, d) for c in (*CHANNELS, battery("Event")) for name, d in c.definitions.items()
    ]
    with pytest.raises(TypeError, match="Event is two things"):
        named(definitions)


def test_a_record_of_plain_values_is_its_own_message_and_back() -> None:
    message = dict(plain.definition(BatteryLevel, "BatteryLevel")["BatteryLevel"])
    assert {name: kind for name, kind in message.items() if name not in STAMPED} == {
        "volts": "double",
        "cells": "repeated int64",
        "charging": "bool",
        "where": "string",
    }
    fields = type("Message", (), plain.to_fields(BatteryLevel)(LEVEL))
    assert plain.from_message(BatteryLevel)(fields) == LEVEL


def test_a_measure_that_is_none_is_refused_where_it_is_read() -> None:
    fields = type("Message", (), {**plain.to_fields(BatteryLevel)(LEVEL), "volts": float("nan")})
    with pytest.raises(ValueError, match="nan is no measure"):
        plain.from_message(BatteryLevel)(fields)


def test_a_record_of_more_than_plain_values_is_told_where_its_message_is_defined() -> None:
    @dataclass
    class Wheels:
        speeds: dict[str, float]

    with pytest.raises(TypeError, match=r"Wheels.speeds .* logs/recording/schema.py"):
        plain.definition(Wheels, "Wheels")


def test_the_record_that_is_read_of_a_message_makes_that_message_again() -> None:
    now = Context(0)
    for _, record in mission():
        for channel in OF_KIND[type(record)]:
            if channel.decode is not None:
                message = channel.encode(record, now)
                assert channel.encode(channel.decode(message), now) == message


def test_a_kind_that_is_recorded_for_the_eye_only_is_not_read_back() -> None:
    with pytest.raises(LookupError, match="Scene is not read back"):
        decoder(Scene)


def test_the_page_lists_every_topic_with_its_message() -> None:
    listed = dict(re.findall(r"^\| `(/\S+)` \| `(\S+)` \|", FORMAT, re.MULTILINE))
    assert listed == {
        topic: message.DESCRIPTOR.full_name.removeprefix(f"{PACKAGE}.")
        for topic, message in TOPICS.items()
    }


@pytest.mark.parametrize("message", MESSAGES)
def test_the_page_names_every_field_of_our_messages(message: str) -> None:
    names = re.findall(r"`(\w+)`", FORMAT)
    told = {*names, *STAMPED}
    unsaid = [
        field.name
        for field in MESSAGES[message].DESCRIPTOR.fields
        if not (field.name in told or any(n[0] == "_" and field.name.endswith(n) for n in names))
    ]
    assert not unsaid
