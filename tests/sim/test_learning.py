"""Scenes to learn from are drawn by their seed, and what is in them is known."""

import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from executive.errors import InputError
from sim.learning import __main__ as door
from sim.learning.frames import VALIDATION_SEED, class_names, make_shards, read_shard, shards
from sim.learning.scenes import Scene, SceneMaker, Truth, extent
from sim.objects.objects import load_objects

physics = pytest.mark.physics


@pytest.fixture(scope="module")
def maker() -> Iterator[SceneMaker]:
    with tempfile.TemporaryDirectory() as folder:
        maker = SceneMaker(load_objects(), Path(folder))
        yield maker
        maker.close()


@pytest.fixture(scope="module")
def scenes(maker: SceneMaker) -> list[Scene]:
    return [maker.make(seed) for seed in range(4)]


@physics
def test_one_seed_gives_one_scene(maker: SceneMaker, scenes: list[Scene]) -> None:
    again = maker.make(2)
    assert (again.frame.color == scenes[2].frame.color).all()
    assert (again.photograph() == scenes[2].photograph()).all()
    assert again.truths == scenes[2].truths
    assert (scenes[1].frame.color != scenes[2].frame.color).any()


@physics
def test_boxes_are_those_of_the_visible_pixels(scenes: list[Scene]) -> None:
    assert sum(len(scene.truths) for scene in scenes) > 4
    for scene in scenes:
        for number, truth in enumerate(scene.truths, start=1):
            pixels = scene.bodies == number
            assert truth.box == extent(pixels)
            assert truth.visible == pixels.sum()


@physics
def test_about_as_much_is_seen_of_a_thing_alone_as_of_one_that_nothing_covers(
    scenes: list[Scene],
) -> None:
    shares = [truth.visible / max(1, truth.alone) for scene in scenes for truth in scene.truths]
    assert max(shares) < 1.25
    assert np.median(shares) > 0.8


@pytest.mark.parametrize(
    ("visible", "alone", "counts"), [(500, 600, True), (500, 2000, False), (80, 80, False)]
)
def test_small_and_mostly_covered_things_do_not_count(
    visible: int, alone: int, counts: bool
) -> None:
    truth = Truth("mug", extent(np.ones((2, 2), np.bool_)), visible, alone, pose=None)  # type: ignore[arg-type]
    assert truth.counts == counts


@physics
def test_a_stopped_run_goes_on_with_the_shards_that_are_missing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    [first] = make_shards(tmp_path, frames=2, seed=0, workers=1)
    before = first.stat().st_mtime_ns
    assert list(make_shards(tmp_path, frames=2, seed=0, workers=1)) == []
    assert first.stat().st_mtime_ns == before
    examples = read_shard(*shards(tmp_path))
    assert len(examples) == 2
    for example in examples:
        assert example.color.shape == (480, 640, 3)
        assert len(example.boxes) == len(example.classes) == len(example.counts)
        assert (example.classes < len(class_names())).all()


def test_the_seeds_that_judge_a_detector_are_not_for_training(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="the others are for judging"):
        next(make_shards(tmp_path, frames=10, seed=VALIDATION_SEED - 5, workers=1))


def test_training_without_frames_says_how_to_make_them(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="run python -m sim.learning frames"):
        shards(tmp_path)


def test_training_without_pytorch_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(door, "find_spec", lambda name: None)
    assert door.main(["train", str(tmp_path)]) == 2
    assert "pip install '.[train]'" in capsys.readouterr().err
