"""Tags in pictures of the instant world: what is drawn is what is read."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.events import Inbox
from executive.perception.tags import LONGEST, TagDetector, read, tag
from executive.testing.bench import Notebook, four_rooms
from executive.testing.contracts.detector import DetectorBench, DetectorContract
from executive.types.perception import Frame
from sim.fake import FakeCamera, FakeDetector, FakeWorld

NAMES = st.text(min_size=1, max_size=64).filter(lambda name: 0 < len(name.encode()) <= LONGEST)


def picture_of(place: str) -> tuple[FakeWorld, Frame]:
    world = FakeWorld(four_rooms(), Inbox(), Notebook())
    world.looking_at = place
    return world, FakeCamera(world).capture()


@given(NAMES.filter(lambda name: name.isprintable()))
def test_a_tag_spells_any_name(name: str) -> None:
    assert read(tag(name)) == name


def test_a_name_that_is_too_long_is_not_read_as_another_one() -> None:
    assert not any(read(tag("a" * length)) for length in (LONGEST + 1, 257, 999))


@given(NAMES, st.integers(0, 2**32 - 1))
def test_a_tag_is_read_through_a_little_noise(name: str, seed: int) -> None:
    noise = np.random.default_rng(seed).normal(0.0, 5.0, (16, 16, 3))
    assert read((tag(name) + noise).clip(0, 255).astype(np.uint8)) == read(tag(name))


@given(st.integers(0, 2**32 - 1))
def test_what_is_no_tag_spells_nothing(seed: int) -> None:
    assert read(np.random.default_rng(seed).integers(0, 256, (16, 16, 3), np.uint8)) == ""


@pytest.mark.parametrize("place", ["counter_wagon", "coffee_table", "desk"])
def test_the_tags_spell_what_the_instant_world_has_in_view(place: str) -> None:
    world, frame = picture_of(place)
    assert [(d.label, d.box) for d in TagDetector().detect(frame)] == [
        (d.label, d.box) for d in FakeDetector(world).detect(frame)
    ]


class TestTagDetector(DetectorContract):
    @pytest.fixture
    def detector_bench(self) -> DetectorBench:
        _, frame = picture_of("counter_wagon")
        return DetectorBench(TagDetector(), frame, ["sugar_box"], list(four_rooms().objects))
