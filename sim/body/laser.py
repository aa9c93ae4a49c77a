"""The planar laser scanner in the base: how far it is to whatever stands around the robot."""

from dataclasses import dataclass

import numpy as np

from executive.geometry import Floats
from sim.body.hardware import Hardware
from sim.engine import BulletClient

RAYS = 180
RANGE_M = 3.5
HEIGHT_M = 0.12
"""Above the floor; what is lower than this, the laser does not see."""
_START_M = 0.32
"""The rays begin just outside of the base (metres from its middle)."""
_DIRECTIONS = np.linspace(-np.pi, np.pi, RAYS, endpoint=False)
_UNITS = np.column_stack((np.cos(_DIRECTIONS), np.sin(_DIRECTIONS)))


@dataclass(frozen=True, slots=True, eq=False)
class Scan:
    """One turn of the laser.

    Attributes:
        middle: (2,) where the scanner was in `map` (metres).
        distances: (RAYS,) metres to the first thing on each ray; infinite where there is none. The
            rays go all around counter-clockwise, from -pi on, in `map`.
    """

    middle: Floats
    distances: Floats

    def hits(self) -> Floats:
        """(n, 2) points in `map` that were hit (metres)."""
        met = np.isfinite(self.distances)
        points: Floats = self.middle + _UNITS[met] * self.distances[met, None]
        return points

    def free_to(self, points: Floats) -> Floats:
        """How far (metres) it was seen to be free in the directions of points (n, 2)."""
        away = points - self.middle
        angles = np.arctan2(away[:, 1], away[:, 0])
        rays = np.rint((angles + np.pi) / (2 * np.pi) * RAYS).astype(int) % RAYS
        free: Floats = np.minimum(self.distances[rays], RANGE_M)
        return free


class Laser:
    """Measures by casting rays into the simulated world; exact, as far as it reaches."""

    def __init__(self, client: BulletClient, hardware: Hardware) -> None:
        """Scan around the robot."""
        self._client = client
        self._hardware = hardware

    def scan(self) -> Scan:
        """Look all around once."""
        middle = self._hardware.base_pose[:2]
        ends = np.full((2, RAYS, 3), HEIGHT_M)
        ends[0, :, :2] = middle + _START_M * _UNITS
        ends[1, :, :2] = middle + RANGE_M * _UNITS
        rays = self._client.rayTestBatch(ends[0].tolist(), ends[1].tolist(), numThreads=1)
        shares = np.array([ray[2] for ray in rays])
        met = np.array([ray[0] >= 0 for ray in rays])
        distances = np.where(met, _START_M + shares * (RANGE_M - _START_M), np.inf)
        return Scan(middle, distances)
