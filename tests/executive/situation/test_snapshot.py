import json
from dataclasses import dataclass, field

import numpy as np

from executive.situation import Situation
from executive.situation.snapshot import NOT_LOGGED, PART, logged_as, snapshot
from executive.types.knowledge import Candidate, Source
from executive.types.perception import Box, Detection

KEYS = {
    *("command", "options", "object", "among", "consultation", "candidates", "candidate", "view"),
    *("visited", "unreached", "unseen", "sighting", "found", "gone", "in_hand", "lost", "put_at"),
    *("inquiries", "llm_calls", "status", "reason"),
}
"""What recordings of the first day have of a situation."""


@dataclass
class Inner:
    near: tuple[str, ...] = ("desk",)


@dataclass
class Outer:
    inner: Inner = field(default_factory=Inner, metadata=PART)
    picture: bytes = field(default=b"...", metadata=NOT_LOGGED)
    size: int = field(default=3, metadata=logged_as("length"))
    where: Candidate = Candidate("bed", Source.USER)


def test_the_fields_of_a_part_stand_in_its_place_and_others_as_they_are_declared() -> None:
    assert snapshot(Outer()) == {
        "near": ["desk"],
        "length": 3,
        "where": {"place": "bed", "source": "user", "probability": None},
    }


def test_a_number_of_a_strange_kind_ends_no_mission() -> None:
    likely = np.float32(0.5)
    known = snapshot(Outer(where=Candidate("bed", Source.LLM, likely)))  # type: ignore[arg-type]
    assert known["where"]["probability"] is likely


def test_no_two_fields_of_a_situation_go_by_one_key() -> None:
    keys = [key for part in vars(Situation()).values() for key in snapshot(part)]
    assert sorted(keys) == sorted(Situation().snapshot())


def test_what_older_recordings_know_is_still_known_by_the_same_key() -> None:
    assert set(Situation().snapshot()) >= KEYS


def test_of_what_was_seen_the_log_keeps_no_picture() -> None:
    situation = Situation()
    seen = Detection("mug", 0.4, Box(0, 0, 2, 2), np.ones((2, 2), bool))
    situation.search.doubtful = situation.search.detection = seen
    known = situation.snapshot()
    assert (known["sighting"], known["doubtful"]) == ([], {"label": "mug", "confidence": 0.4})
    assert json.loads(json.dumps(known)) == known
