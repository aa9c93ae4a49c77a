"""What a mission has for a body: ours in simulation, or a robot of one's own.

`--world package.module:function` names a function that is given a `Setup` and returns an
`Embodiment`; docs/own-robot.md shows one.
"""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from executive.config import Settings
from executive.errors import InputError
from executive.events import Inbox
from executive.interfaces.knowledge import Knowledge
from executive.interfaces.perception import Detector, Perception
from executive.interfaces.robot import Robot
from executive.interfaces.runtime import Clock, Recorder
from executive.interfaces.simulation import SimulatedHome
from sim.home.arrangement import Spot
from sim.home.home import Home


class Furnished(Protocol):
    """A simulated world whose things may be kept where they are, and moved by others."""

    def left(self) -> Mapping[str, Spot]:
        """Where each thing is that is on furniture."""
        ...

    def put(self, name: str, furniture: str) -> bool:
        """Have somebody put a thing on other furniture; whether that could be done."""
        ...


def nothing() -> None:
    """What most bodies do when a mission begins, or the session ends."""


def no_pause(seconds: float) -> None:
    """Where nobody lives, nothing comes of waiting."""


@dataclass(frozen=True)
class Setup:
    """What an embodiment is built with.

    Attributes:
        settings: `detector`, `fault` and others are for it to heed.
        home: places and their poses in `map`; for a simulation also where things are.
        inbox: where the ends of what is started go.
        recorder: where pictures and movements go.
        knowledge: which labels a detector may use.
        gui: whether a simulator's own window is wanted.
        left: things that are just where they were left, which no seed moves.
    """

    settings: Settings
    home: Home
    inbox: Inbox
    recorder: Recorder
    knowledge: Knowledge
    gui: bool = False
    left: Collection[str] = ()

    def detector(self) -> Detector:
        """The detector that the settings name, for pictures of any camera.

        Raises:
            InputError: if its file is wrong, or they name the one that only a simulation has.
        """
        name = self.settings.detector
        if name == "simulated":
            raise InputError(
                "setting 'detector'", f"{name} is not for this world", "use learned or a FILE.onnx"
            )
        from executive.perception.detector import LEARNED, OnnxDetector

        return OnnxDetector(
            LEARNED if name == "learned" else Path(name), self.knowledge.objects_named
        )


@dataclass(frozen=True)
class Embodiment:
    """A robot with its senses and its time.

    Attributes:
        robot: what pursues goals.
        perception: what it sees with; `CameraPerception` joins a camera and a detector.
        clock: mission time.
        in_map: whether perception tells where in `map` things are; the home's plan then says on
            which furniture.
        truth: the simulated world, if it is one.
        blind_to: objects of the home that perception would not recognise.
        has_arm: whether it can take things; one without finds them, and declines the rest in words.
        jumps: whether the robot is where it drives to without having been in between.
        keeps: the simulated world, if its things can be kept where they are (`--home-state`).
        begin: called when a mission begins, to record what is to be seen of the world.
        end: called when a mission has ended.
        pause: called to let so many seconds pass where people live, before the next mission.
        close: called once, at the end of the session.
    """

    robot: Robot
    perception: Perception
    clock: Clock
    in_map: bool = True
    truth: SimulatedHome | None = None
    blind_to: tuple[str, ...] = ()
    has_arm: bool = True
    jumps: bool = False
    keeps: Furnished | None = None
    begin: Callable[[], None] = nothing
    end: Callable[[], None] = nothing
    pause: Callable[[float], None] = no_pause
    close: Callable[[], None] = nothing


Factory = Callable[[Setup], Embodiment]
