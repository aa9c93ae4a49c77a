"""The planar laser scanner in the base: distances to the obstacles around the robot."""

from dataclasses import dataclass

import numpy as np

from executive.geometry import Floats
from sim.body.hardware import Hardware
from sim.engine import BulletClient

RAYS = 180
RANGE_M = 3.5
HEIGHT_M = 0.12
"""Height of the scan plane above the floor; the laser does not see lower objects."""
_START_M = 0.32
"""The rays begin just outside the base (metres from its centre)."""
_DIRECTIONS = np.linspace(-np.pi, np.pi, RAYS, endpoint=False)
_UNITS = np.column_stack((np.cos(_DIRECTIONS), np.sin(_DIRECTIONS)))


@dataclass(frozen=True, slots=True, eq=False)
class Scan:
    """One scan, over the full circle.

    Attributes:
        middle: (2,) position of the scanner in `map` (metres).
        distances: (RAYS,) distance to the first hit of each ray (metres); infinite if there is
            none. Rays go counter-clockwise in `map`, from the angle -pi.
    """

    middle: Floats
    distances: Floats

    def hits(self) -> Floats:
        """The points (n, 2) that were hit (metres, in `map`)."""
        met = np.isfinite(self.distances)
        points: Floats = self.middle + _UNITS[met] * self.distances[met, None]
        return points

    def free_to(self, points: Floats) -> Floats:
        """(n,) how far it is free in the directions of points (n, 2) in `map` (metres)."""
        away = points - self.middle
        angles = np.arctan2(away[:, 1], away[:, 0])
        rays = np.rint((angles + np.pi) / (2 * np.pi) * RAYS).astype(int) % RAYS
        free: Floats = np.minimum(self.distances[rays], RANGE_M)
        return free


class Laser:
    """Casts rays into the simulated world; exact up to RANGE_M."""

    def __init__(self, client: BulletClient, hardware: Hardware) -> None:
        """Scan the world of `client` around the robot."""
        self._client = client
        self._hardware = hardware

    def scan(self) -> Scan:
        """Take one scan."""
        middle = self._hardware.base_pose[:2]
        ends = np.full((2, RAYS, 3), HEIGHT_M)
        ends[0, :, :2] = middle + _START_M * _UNITS
        ends[1, :, :2] = middle + RANGE_M * _UNITS
        rays = self._client.rayTestBatch(ends[0].tolist(), ends[1].tolist(), numThreads=1)
        shares = np.array([ray[2] for ray in rays])
        met = np.array([ray[0] >= 0 for ray in rays])
        distances = np.where(met, _START_M + shares * (RANGE_M - _START_M), np.inf)
        return Scan(middle, distances)
