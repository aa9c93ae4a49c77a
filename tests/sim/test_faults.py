"""Faults as they are written, and senses that have them."""

import contextlib
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.app.session import Session
from executive.config import load_settings
from executive.errors import InputError
from executive.events import Inbox
from executive.records import Mishap
from executive.testing.bench import Notebook, four_rooms
from executive.types.perception import Frame
from sim.fake import FakeCamera, FakeDetector, FakeWorld
from sim.faults.injector import FaultInjector, FaultyCamera, FaultyDetector
from sim.faults.orders import FAULTS, Blind, Fault, Miss, Moved, Span, parse_fault, parse_faults

HOME = four_rooms()
TIMES = st.sampled_from(["", "@0", "@12", "@3.5", "@5-60", "@0-0.5"])


@pytest.mark.parametrize("kind", FAULTS.values(), ids=lambda kind: kind.word)
def test_every_kind_reads_its_own_example_in_four_rooms(kind: type[Fault]):
    [fault] = parse_faults([kind.example], HOME)
    assert isinstance(fault, kind)
    assert str(fault) == kind.example


@given(st.sampled_from(sorted(FAULTS)), TIMES)
def test_what_is_printed_reads_as_the_same_fault(word: str, when: str):
    fault = parse_fault(FAULTS[word].example.partition("@")[0] + when)
    assert parse_fault(str(fault)) == fault


@given(st.text(max_size=30) | st.from_regex(r"[a-z]{1,8}=[a-z0-9.,:\-]{0,9}(@[0-9\-.]{0,6})?"))
def test_any_text_is_a_fault_or_an_input_error(text: str):
    with contextlib.suppress(InputError):
        assert isinstance(parse_fault(text), Fault)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("flood", "known: moved, blocked"),
        ("moved=mug", "as in moved=mug:desk@12"),
        ("moved=anvil:desk", "there is no anvil in this home"),
        ("moved=mug:pantry", "there is no pantry in this home"),
        ("blocked=kitchen-bedroom", "there is kitchen-living_room"),
        ("crate=99,1", "is in no room"),
        ("slip=1.5", "at most 1"),
        ("drop=3", "drop takes no value"),
        ("stuck=joint9", "there is lift, joint1"),
        ("noise=nan", "is no number"),
        ("blind@40-20", "ends after it begins"),
        ("blind@-5", "is no number"),
    ],
)
def test_a_wrong_fault_says_what_would_be_right(text: str, complaint: str):
    with pytest.raises(InputError, match=complaint):
        parse_faults([text], HOME)


def test_a_wrong_fault_ends_the_program_before_it_begins():
    with pytest.raises(InputError, match="needs --world physics"):
        Session(load_settings(world="fake", llm="none", fault=("crate=2,2",)), recorded=False)


def test_a_span_holds_its_start_and_not_its_end():
    assert [time in Span(2.0, 4.0) for time in (1.9, 2.0, 3.9, 4.0)] == [False, True, True, False]


class Senses:
    """Camera and detector of the instant world, before the shelf, with faults."""

    def __init__(self, *texts: str, seed: int = 0) -> None:
        self.time, self.notes = 0.0, Notebook()
        world = FakeWorld(HOME, Inbox(), self.notes)
        world.looking_at = "shelf_lobby"
        faults = parse_faults(texts, HOME)
        self.injector = FaultInjector(faults, self.notes, lambda: self.time, seed)
        self.camera = FaultyCamera(FakeCamera(world), self.injector)
        names = tuple(HOME.objects)
        self.detector = FaultyDetector(FakeDetector(world), self.injector, names)

    def labels(self) -> list[str]:
        return [found.label for found in self.detector.detect(self.camera.capture())]


TRUE_LABELS = Senses().labels()


def test_a_blind_camera_shows_nothing_while_it_is_blind():
    senses = Senses("blind@5-10")
    for time, sees in ((0.0, True), (5.0, False), (9.9, False), (10.0, True)):
        senses.time = time
        frame = senses.camera.capture()
        assert frame.color.any() == sees
        assert np.isfinite(frame.depth).any() == sees
        assert (senses.labels() == TRUE_LABELS) == sees
    assert len(senses.notes.all(Mishap)) == 1


def test_noise_has_the_ordered_deviation():
    def depths(*texts: str) -> Any:
        return Senses(*texts).camera.capture().depth

    assert np.std(depths("noise=0.02") - depths()) == pytest.approx(0.02, rel=0.05)


@pytest.mark.parametrize(("text", "share"), [("miss=0.3", 0.7), ("confuse=0.3", 0.7)])
def test_a_detector_is_wrong_as_often_as_ordered(text: str, share: float):
    senses = Senses(text)
    right = [set(TRUE_LABELS) & set(senses.labels()) for _ in range(300)]
    found = sum(map(len, right)) / 300 / len(TRUE_LABELS)
    assert found == pytest.approx(share, abs=0.06)


def test_what_is_confused_is_another_thing_of_the_home():
    labels = set(Senses("confuse=1").labels())
    assert labels <= set(HOME.objects)


def test_the_same_seed_has_the_same_mishaps_and_one_fault_does_not_disturb_another():
    def misses(*texts: str, seed: int = 1) -> list[list[str]]:
        senses = Senses(*texts, seed=seed)
        return [senses.labels() for _ in range(20)]

    assert misses("miss=0.5") == misses("miss=0.5") == misses("miss=0.5", "noise=0.1")
    assert misses("miss=0.5") != misses("miss=0.5", seed=2)


def test_what_strikes_once_strikes_again_in_the_next_mission():
    injector = Senses("moved=mug:desk@3").injector
    assert not injector.due(Moved)
    injector = Senses("moved=mug:desk").injector
    [fault] = injector.due(Moved)
    injector.strike(fault, "it is moved")
    assert not injector.due(Moved)
    injector.begin()
    assert injector.due(Moved) == (fault,)


def test_frames_keep_their_numbers_and_sizes():
    def of(frame: Frame) -> Any:
        return frame.number, frame.color.shape, frame.color.dtype, frame.depth.dtype, frame.pose

    clear, *spoilt = (of(Senses(*texts).camera.capture()) for texts in ([], ["blind"], ["noise=1"]))
    assert spoilt == [clear, clear]


def test_kinds_are_told_apart():
    injector = Senses("blind", "miss=0.5").injector
    assert [type(fault) for fault in (*injector.active(Blind), *injector.active(Miss))] == [
        Blind,
        Miss,
    ]
