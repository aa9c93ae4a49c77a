"""The body of a mission: ours in simulation, or a robot of one's own.

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
    """A simulated world whose things can be saved where they are, and moved by people."""

    def left(self) -> Mapping[str, Spot]:
        """Where the things are that are on furniture."""
        ...

    def put(self, name: str, furniture: str) -> bool:
        """Put a thing on other furniture, as a person would; return whether that was possible."""
        ...


def nothing() -> None:
    """Do nothing, as most bodies do when a mission begins or ends, or the session ends."""


def no_pause(seconds: float) -> None:
    """Do nothing: in a home where nobody lives, nothing changes with time."""


@dataclass(frozen=True)
class Setup:
    """What an embodiment is built from.

    Attributes:
        settings: `detector`, `fault` and others are for the embodiment to apply.
        home: places and their poses in `map`; for a simulation also where things are.
        inbox: where the results of requests go.
        recorder: where pictures and movements go.
        knowledge: the names of objects, for the labels of a detector.
        gui: whether to show the simulator's own window.
        left: things that are exactly where they were left; the seed does not move them.
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
            InputError: if its file is wrong, or if it is the one that only a simulation has.
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
    """A robot with its perception and its clock.

    Attributes:
        robot: pursues goals.
        perception: recognises things; `CameraPerception` makes one from a camera and a detector.
        clock: mission time.
        in_map: whether detections have a position in `map`, from which the home's plan tells the
            furniture.
        truth: the simulated world; None if the world is real.
        blind_to: objects of the home that perception would not recognise.
        has_arm: whether the robot can take things; if not, it finds them, and says that it cannot
            do the rest.
        jumps: whether the robot reaches its goal without passing the points in between.
        keeps: the simulated world, if its things can be saved where they are (`--home-state`).
        begin: called when a mission begins, to record the scene.
        end: called when a mission has ended.
        pause: lets so many seconds pass in a home where people live, before the next mission.
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
