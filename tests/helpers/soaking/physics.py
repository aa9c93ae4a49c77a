"""The same in PyBullet: faulted missions, some of them stopped at a random moment."""

import random
import threading
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from executive.config import KnowledgeSystem, Settings
from executive.events import StopRequested
from sim.body.skill import CONTROL_S
from sim.home.home_file import load_home
from sim.world import PhysicsWorld
from soaking.case import INSTANT, Soak, faults, watchdog
from soaking.chaos import Chaos

PHYSICAL = (*INSTANT, "crate")
STILL_M_S = 0.02
"""What moves slower (m/s, rad/s) is at rest."""
SETTLED_S = 0.5
"""So long after a mission nothing may move: the head nods on for a moment when it has looked."""


def run_in_physics(seed: int) -> list[str]:
    """Run one faulted mission in PyBullet, and another when all is well; a line each violation."""
    with TemporaryDirectory() as folder, watchdog():
        return [f"seed {seed}: {line}" for line in PhysicsSoak(seed, 1, Path(folder)).run()]


class PhysicsSoak(Soak):
    """One household in PyBullet; its truth is PyBullet's."""

    def _draw_chaos(self, chance: random.Random) -> Chaos:
        return Chaos(chance, rate=chance.choice((0.0, 0.0, 0.02)), stops_at=())

    def _draw_settings(self, chance: random.Random, runs: Path) -> Settings:
        home = load_home("four_rooms")
        return Settings(
            runs=runs,
            user="none",
            seed=chance.randrange(1000),
            knowledge=chance.choice(list(KnowledgeSystem)),
            elicit="rank",
            detector=chance.choice(("simulated", "learned")),
            camera_hz=0.0,
            fault=tuple(faults(chance, home, PHYSICAL)),
        )

    def _mission(self) -> Iterator[str]:
        """A third of the missions is stopped, at a random moment of real time."""
        stop = threading.Timer(
            self._chance.uniform(0.1, 6.0), self._inbox.post, [StopRequested("the person")]
        )
        if stopped := self._chance.random() < 1 / 3:
            stop.start()
        yield from super()._mission()
        if stopped:
            stop.cancel()
            stop.join()
            self._inbox.take_all()

    def _all_is_well_again(self) -> Iterator[str]:
        """Not if a crate may stand in the way, or a door stay shut, for good."""
        if not any(fault.startswith(("crate", "blocked")) for fault in self._settings.fault):
            yield from super()._all_is_well_again()

    def _unheard(self) -> Iterator[str]:
        """A stop may come when the mission has just ended: there was nothing to stop."""
        self._inbox.take_all()
        return iter(())

    def _body_at_rest(self) -> Iterator[str]:
        world = self._world
        assert isinstance(world, PhysicsWorld)
        for _ in range(round(SETTLED_S / CONTROL_S)):
            world._pass_period()
        client, body = world._client, world._hardware.body
        joints = range(client.getNumJoints(body))
        speeds = {
            client.getJointInfo(body, joint)[1].decode(): client.getJointState(body, joint)[1]
            for joint in joints
        }
        moving = [name for name, speed in speeds.items() if np.abs(speed) > STILL_M_S]
        if moving and not self._chaos.struck:
            yield f"not at rest: {', '.join(moving)}"
