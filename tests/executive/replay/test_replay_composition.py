"""A replay puts the mission together as it was, from what the recording keeps."""

import io
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from executive.app.parts import Parts
from executive.app.session import Session
from executive.campaign import blocks
from executive.campaign.policies import POLICIES
from executive.config import KnowledgeSystem, Settings, load_settings
from executive.events import Inbox
from executive.replay.body import recorded_body
from executive.replay.replaying import replay
from executive.testing.bench import four_rooms
from executive.types.goals import Goal, LookAt, Pick
from executive.types.outcome import MissionStatus
from executive.types.perception import Box, Detection
from executive.types.results import Saw
from kb.advice.prompts import TEXTS
from kb.llm.scripted import Scripted as ScriptedModel
from logs.recording.reader import Run
from sim.fake import FakeWorld
from sim.home.home import FLOOR_VIEWS

OKB = {"world": "fake", "llm": "none", "knowledge": KnowledgeSystem.OKB, "user": "oracle"}


class FarSighted:
    """Perception that see the mug on the desk: once from the bed, then from the desk itself."""

    def __init__(self, parts: Parts) -> None:
        self._inbox = parts.inbox
        self._world = parts.robot._world  # type: ignore[attr-defined]
        self._looks = 0
        x, y, _ = parts.home.furniture_named("desk").pose
        on_desk = np.array([[x, y, 0.8]], np.float32)
        self._mug = Detection("mug", 1.0, Box(0, 0, 1, 1), np.ones((1, 1), np.bool_), on_desk)

    def see(self) -> int:
        self._looks += 1
        seen = (self._mug,) if self._looks == 1 or self._world.at == "desk" else ()
        self._inbox.end(request := self._inbox.open(), Saw(self._looks, seen))
        return request

    def cancel(self, request: int) -> None:
        self._inbox.drop(request)


def with_true_positions(parts: Parts) -> Parts:
    """As in the physical world, where the robot's map tells on what a thing is that it sees."""
    views = parts.home.view_targets
    parts.robot.views = lambda place: len(views(place))  # type: ignore[method-assign]
    return replace(parts, in_map=True, perception=FarSighted(parts))


def test_what_was_seen_on_furniture_behind_a_place_is_remembered_there(tmp_path: Path) -> None:
    settings = Settings(**OKB, place={"mug": "bed"}, runs=tmp_path)  # type: ignore[arg-type]
    session = Session(settings, out=io.StringIO(), change=with_true_positions)
    world = session.world
    assert isinstance(world, FakeWorld)

    def someone_takes_it(goal: Goal) -> str | None:
        if isinstance(goal, Pick) and world.things["mug"] == "bed":
            world.things["mug"] = "desk"
            return "the mug slipped from my fingers"
        return None

    world.fault = someone_takes_it
    outcome = session.run("Take the mug")
    assert (outcome.status, outcome.source) == (MissionStatus.DONE, "memory")
    assert replay(Path(outcome.run_dir or "")).parting is None


@pytest.mark.parametrize("policy", ["nearest", "random", "true-first", "always-asks"])
def test_a_mission_of_any_policy_replays(policy: str, tmp_path: Path) -> None:
    given = {**OKB, "knowledge": KnowledgeSystem.OKB_LLM, "defaults": False, "runs": tmp_path}
    block = blocks.Block(
        load_settings(**given), ("Take a mug.", "Find the hammer"), policy, recorded=True
    )
    for entry in blocks.run(block):
        run = Path(entry.row.run_dir)
        assert Run(run).metadata["policy"] == policy
        assert replay(run).parting is None


def test_a_mission_without_verification_replays_without(tmp_path: Path) -> None:
    inbox = Inbox()
    settings = load_settings(**{**OKB, "knowledge": KnowledgeSystem.OKB_LLM, "runs": tmp_path})
    session = Session(
        settings.model_copy(update={**POLICIES["unverified"].settings, "llm": "embedded"}),
        inbox=inbox,
        model=ScriptedModel(['{"places": ["the moon", "desk"]}'], inbox),
        policy="unverified",
        change=POLICIES["unverified"],
        out=io.StringIO(),
    )
    outcome = session.run("Find an apple")
    run = Path(outcome.run_dir or "")
    assert "the moon" in next(Run(run).verifications()).value.accepted
    assert replay(run).parting is None


def test_a_robot_that_does_not_learn_does_not_in_the_replay(tmp_path: Path) -> None:
    settings = Settings(**OKB, learn=False, runs=tmp_path)  # type: ignore[arg-type]
    session = Session(settings, out=io.StringIO())
    assert isinstance(session.world, FakeWorld)
    to_fail: list[type] = [Pick, LookAt]

    def fault(goal: Goal) -> str | None:
        """The pick fails, and the look after it: the thing counts as gone, and is searched anew."""
        if to_fail and isinstance(goal, to_fail[0]):
            to_fail.pop(0)
            return "it does not work"
        return None

    session.world.fault = fault
    outcome = session.run("Take an apple")
    assert replay(Path(outcome.run_dir or "")).parting is None


def test_a_recording_keeps_the_texts_that_replaced_ours(tmp_path: Path) -> None:
    file = tmp_path / "prompts.toml"
    file.write_text(TEXTS.read_text().replace("home", "castle"))
    inbox = Inbox()
    given: dict[str, Any] = {**OKB, "knowledge": KnowledgeSystem.OKB_LLM, "llm": "embedded"}
    session = Session(
        Settings(**given, prompts=file, runs=tmp_path / "runs"),
        inbox=inbox,
        model=ScriptedModel([], inbox),
        out=io.StringIO(),
    )
    outcome = session.run("Find a power_drill")
    file.unlink()
    run = Run(Path(outcome.run_dir or ""))
    assert "castle" in run.attachments["prompts.toml"].decode()
    assert replay(run.path).parting is None


def test_a_recording_from_before_the_body_was_kept_has_one_of_two_bodies(tmp_path: Path) -> None:
    old = SimpleNamespace(attachments={}, path=tmp_path)
    home = four_rooms()
    physical, fake = (recorded_body(old, Settings(world=w), home) for w in ("physics", "fake"))
    assert (physical.in_map, physical.views["floor"]) == (True, FLOOR_VIEWS)
    assert physical.views["shelf_lobby"] == len(home.view_targets("shelf_lobby")) > 1
    assert (fake.in_map, fake.views) == (False, {})
