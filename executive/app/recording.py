"""The logs of a mission, with the settings, knowledge and state that a replay needs."""

import json
import logging
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from importlib.metadata import version
from pathlib import Path

from executive.app.parts import Parts, guarded_model
from executive.app.run_folder import write
from executive.app.sources import written
from executive.config import Settings
from executive.files import read_bytes
from executive.guards import GuardedRobot, in_words
from executive.toml_file import MOST_BYTES
from executive.types.home import DELIVERY, FLOOR
from logs.recorder import Sink
from logs.recording.sink import McapSink
from sim.home.home import Home
from sim.home.home_file import home_text

log = logging.getLogger(__name__)

PACKAGES = ("py-trees", "pybullet", "llama-cpp-python", "owlready2", "rerun-sdk", "mcap")


@dataclass(frozen=True)
class Recording:
    """How the missions of a session are recorded.

    Attributes:
        used: attachments about settings and body (`files_used`, `body_used`).
        parts: the parts of the missions.
        policy: name of the policy that chose the parts.
        view: whether to open a viewer.
    """

    used: dict[str, bytes]
    parts: Parts
    policy: str
    view: bool = False

    def sinks(
        self, folder: Path, started: datetime, before: dict[str, str]
    ) -> tuple[list[Sink], bool]:
        """Open the logs of a mission, as `open_sinks` does, and write its settings beside them.

        `before` is the state at its beginning, as metadata.
        """
        write(folder / "config.toml", self.used["config.toml"].decode())
        attachments = {
            **self.used,
            **self.parts.knowledge.files(),
            "facts.json": json.dumps(self.parts.facts.beliefs()).encode(),
        }
        known = {"origins": self.parts.facts.origins(), "denials": self.parts.facts.denials()}
        attachments |= {f"{name}.json": json.dumps(of).encode() for name, of in known.items() if of}
        if self.parts.sources:
            attachments["sources.json"] = written(self.parts.sources)
        metadata = {
            "requests_before": str(self.parts.inbox.last),
            **before,
            "seed": str(self.parts.settings.seed),
            "model": self._model(),
            "speaks": "in words",
            "thinks": str(self.parts.model is not None),
            "policy": self.policy,
            **({"learns": str(True)} if self.parts.experience else {}),
            **{name: version(name) for name in PACKAGES},
        }
        from logs.viewer.sink import RerunSink  # slow to import

        return open_sinks(
            lambda: McapSink(folder / "mission.mcap", started, attachments, metadata),
            lambda: RerunSink(folder / "mission.rrd", view=self.view),
        )

    def _model(self) -> str:
        model = self.parts.model
        return guarded_model(self.parts, model).name if model else "none"


def files_used(settings: Settings) -> dict[str, bytes]:
    """The attachments about the settings, by name: contents of the files that they use.

    Raises:
        InputError: if one of them cannot be read.
    """
    prompts, profile = settings.prompts, b""
    if settings.robot and settings.profile:
        from executive.ros.profile import profile_text  # most missions do not need it

        profile, _ = profile_text(settings.profile)
    return {
        "config.toml": settings.to_toml().encode(),
        "home.toml": home_text(settings.home).encode(),
        **({"prompts.toml": read_bytes(prompts, MOST_BYTES)} if prompts else {}),
        **({"profile.toml": profile} if profile else {}),
    }


def body_used(parts: Parts) -> dict[str, bytes]:
    """The attachment about the body, which a replay cannot ask.

    It says whether things have positions in `map`, which places need more than one view, which
    objects perception does not recognise, and whether the robot has an arm.
    """
    robot = GuardedRobot(parts.robot, parts.inbox, parts.recorder)
    views = {place: robot.views(place) for place in places_viewed(parts.home)}
    several = {place: number for place, number in views.items() if number > 1}
    body = {"in_map": parts.in_map, "views": several, "blind_to": parts.blind_to}
    body["has_arm"] = parts.has_arm
    return {"body.json": json.dumps(body).encode()}


def places_viewed(home: Home) -> tuple[str, ...]:
    """All places that a robot may have to look at."""
    return (*(place.name for place in home.places()), DELIVERY, FLOOR)


def open_sinks(*makers: Callable[[], Sink]) -> tuple[list[Sink], bool]:
    """Open the logs; return those that could be opened, and whether these are all.

    For the others there is a warning, and the mission goes on without them.
    """
    sinks = []
    for make in makers:
        try:
            sinks.append(make())
        except Exception as error:
            why = in_words(error)
            log.warning("a log cannot be opened, the mission goes on without it: %s", why)
    return sinks, len(sinks) == len(makers)
