"""Estimates the pose of a known object from the points of its surface that the camera saw."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from executive.geometry import Floats, heading
from executive.types.geometry import Pose
from sim.manipulation.fitting import least_squares
from sim.objects.distance import distance_to
from sim.objects.objects import ObjectModel
from sim.objects.resting import Lying, lyings

_POINTS, _FEW = 250, 3
"""The most points of a fit; rough and close fits use only every third of them."""
_YAWS, _BEHIND = 12, (0.0, 0.5, 1.0)
"""Start values: the number of yaws, and how far the object's centre is behind the visible points,
as fractions of half the object's depth."""
_NUDGES_M = (0.0, 0.02, -0.02, 0.04, -0.04)
"""The close fit starts again at these offsets along the view, to leave local minima."""
_ROUGH, _FINE, _EXACT = 5, 10, 50
"""The most steps of the rough, the close and the exact fit."""
_NUDGED, _REFINED = 4, 3
"""How many rough fits are refined by the close fit, and how many close ones by the exact fit."""
_CENTERING = 0.1
"""Weight of centring: where the points leave the object free to slide, it is centred on them."""
_SEED = 0
_FITS_M = 0.008
"""A fit is accepted if its errors of surface and of height together are less than this."""
_HOPELESS_M = 0.03
"""An exact fit is not tried if those errors are more than this after the close fit."""
_LIKELY = 2
"""How many fallen poses, the likeliest after the rough fit, get a close fit."""
_SIFTING, _SIFTED = 3, 6
"""In the close fit of fallen poses, only the best `_SIFTED` starts go on after `_SIFTING` steps."""
_LIKELY_YAWS = 8
"""The number of yaws that the rough fit of fallen poses starts with."""
Which = NDArray[np.intp]
"""(g,) for each guess, the index of its resting pose."""


def fit_pose(model: ObjectModel, points: Floats, eye: Floats) -> Pose:
    """The pose in `map` of an upright object that fits its visible points best.

    Fits x, y, z and yaw so that the points are on the side of the object that faces the camera. If
    an object is symmetric, its yaw is one of several.

    Args:
        model: the object.
        points: (n, 3) its visible points in `map` (metres).
        eye: (3,) position of the camera in `map`.
    """
    seen, stands = _Seen(points, eye), lyings(model)[0]
    return seen.exactly(stands, seen.closely([stands], seen.roughly([stands]))[0]).pose


def fit_fallen_pose(
    model: ObjectModel, points: Floats, eye: Floats, support: float
) -> tuple[ObjectModel, Pose]:
    """The resting pose of an object that may have fallen.

    Args:
        model: the object.
        points: (n, 3) its visible points in `map` (metres).
        eye: (3,) position of the camera in `map`.
        support: height of the surface that it rests on (metres).

    Returns:
        The model of the one of its `lyings` that fits best, and its pose in `map`.
    """
    seen, (stands, *fallen) = _Seen(points, eye), lyings(model)
    upright = seen.closely([stands], seen.roughly([stands]))[0]
    may_stand = upright[0].doubt(support) < _HOPELESS_M
    stood = seen.exactly(stands, upright) if may_stand else upright[0]
    if stood.doubt(support) < _FITS_M:
        return model, stood.pose
    lying, lies = _fallen(seen, fallen, support)
    if lies.doubt(support) < stood.doubt(support):
        return lying.model, lies.pose
    return model, stood.pose if may_stand else seen.exactly(stands, upright).pose


def _fallen(seen: "_Seen", lyings: Sequence[Lying], support: float) -> tuple[Lying, "_Fit"]:
    """The best of these resting poses, and its fit."""
    rough = seen.roughly(lyings, _LIKELY_YAWS)
    by_doubt = sorted(range(len(lyings)), key=lambda way: rough[way][0].doubt(support))
    ways = sorted(by_doubt[:_LIKELY])
    close = seen.closely([lyings[way] for way in ways], [rough[way] for way in ways], sifted=True)
    doubts = [fits[0].doubt(support) for fits in close]
    sure = (number for number, doubt in enumerate(doubts) if doubt < _FITS_M)
    likely = next(sure, int(np.argmin(doubts)))
    lying = lyings[ways[likely]]
    return lying, seen.exactly(lying, close[likely])


@dataclass(frozen=True, slots=True, eq=False)
class _Fit:
    """A guess (x, y, z, yaw), and the mean distance of the points from the object there (m)."""

    guess: Floats
    off: float

    @property
    def pose(self) -> Pose:
        """The pose in `map`."""
        x, y, z, yaw = (float(value) for value in self.guess)
        return Pose((x, y, z), heading(yaw))

    def doubt(self, support: float) -> float:
        """The error: distance of the points, and distance of the base from the support (m)."""
        return self.off + abs(float(self.guess[2]) - support)


class _Seen:
    """The visible points of an object, seen from `eye`, and the fits to them."""

    def __init__(self, points: Floats, eye: Floats) -> None:
        order = np.random.default_rng(_SEED).permutation(len(points))
        few = np.asarray(points[order[:_POINTS]], dtype=np.float64)
        self._eye = eye
        self._points = few
        self._middle = (few.min(axis=0) + few.max(axis=0))[:2] / 2
        self._away = (self._middle - eye[:2]) / np.linalg.norm(self._middle - eye[:2])

    def roughly(self, lyings: Sequence[Lying], yaws: int = _YAWS) -> list[list[_Fit]]:
        """Rough fits for each resting pose, the best first; each starts with the best `yaws`."""
        surface = _Surface(lyings, self._points[::_FEW])
        guesses, which = self._starts(surface, lyings, yaws)
        return self._fits(surface, *self._best(surface, guesses, which, _ROUGH, _NUDGED))

    def closely(
        self, lyings: Sequence[Lying], rough: Sequence[Sequence[_Fit]], sifted: bool = False
    ) -> list[list[_Fit]]:
        """Close fits for each resting pose, from rough ones; `sifted` drops bad starts early."""
        surface = _Surface(lyings, self._points[::_FEW])
        nudges = np.zeros((len(_NUDGES_M), 4))
        nudges[:, :2] = np.outer(_NUDGES_M, self._away)
        guesses = np.array([fit.guess for fits in rough for fit in fits])
        which = np.repeat(np.arange(len(lyings)), len(rough[0]) * len(nudges))
        guesses = (guesses[:, None] + nudges).reshape(-1, 4)
        if sifted:
            guesses, which = self._best(surface, guesses, which, _SIFTING, _SIFTED)
        return self._fits(surface, *self._best(surface, guesses, which, _FINE, _REFINED))

    def exactly(self, lying: Lying, fits: Sequence[_Fit]) -> _Fit:
        """The best fit to all points, from close ones."""
        surface, which = _Surface([lying], self._points), np.zeros(len(fits), np.intp)
        guesses, which = self._best(surface, np.array([f.guess for f in fits]), which, _EXACT, 1)
        return self._fits(surface, guesses, which)[0][0]

    def _fits(self, surface: "_Surface", guesses: Floats, which: Which) -> list[list[_Fit]]:
        """The fits of guesses, grouped by resting pose; all groups have the same size."""
        off = np.abs(surface.distances(guesses, which)).mean(axis=1)
        fits = [_Fit(*fit) for fit in zip(guesses, off.tolist(), strict=True)]
        each = len(fits) // (int(which.max()) + 1)
        return [fits[first : first + each] for first in range(0, len(fits), each)]

    def _starts(
        self, surface: "_Surface", lyings: Sequence[Lying], kept: int
    ) -> tuple[Floats, Which]:
        """Start values (x, y, z, yaw) for each resting pose: the best `kept` yaws.

        For each yaw the object is centred on the visible points, or behind them, whichever is best.
        """
        yaws = np.arange(_YAWS) * 2 * np.pi / _YAWS
        across = np.stack((np.cos(yaws), np.sin(yaws), -np.sin(yaws), np.cos(yaws)), axis=-1)
        along = np.abs(across.reshape(-1, 2, 2) @ self._away)
        sizes = np.array([lying.model.size for lying in lyings])
        half = sizes[:, :2] @ along.T / 2
        guesses = np.empty((len(lyings), _YAWS, len(_BEHIND), 4))
        behind = np.asarray(_BEHIND)[:, None] * half[:, :, None, None]
        guesses[..., :2] = self._middle + behind * self._away
        guesses[..., 2] = self._points[:, 2].max() - sizes[:, None, None, 2]
        guesses[..., 3] = yaws[:, None]
        which = np.repeat(np.arange(len(lyings)), _YAWS * len(_BEHIND))
        off = surface.off_only(guesses.reshape(-1, 4), which)
        costs = (off**2).sum(axis=1).reshape(-1, len(_BEHIND))
        flat = guesses.reshape(-1, len(_BEHIND), 4)
        best = flat[np.arange(len(flat)), costs.argmin(axis=1)].reshape(len(lyings), _YAWS, 4)
        likely = costs.min(axis=1).reshape(-1, _YAWS).argsort(axis=1, kind="stable")[:, :kept]
        likely.sort(axis=1)
        chosen = np.take_along_axis(best, likely[:, :, None], axis=1).reshape(-1, 4)
        return chosen, np.repeat(np.arange(len(lyings)), kept)

    def _best(
        self, surface: "_Surface", starts: Floats, which: Which, steps: int, kept: int
    ) -> tuple[Floats, Which]:
        """Fit from all starts, and keep the best `kept` for each resting pose.

        Fits that face the camera come first; then the order is that of the costs.
        """
        guesses, costs = least_squares(surface.off, starts, which, steps)
        away = surface.facing(guesses, which, self._eye) < 0.5
        order = np.lexsort((costs, away, which))
        each = len(guesses) // (int(which.max()) + 1)
        best = order.reshape(-1, each)[:, :kept].ravel()
        return guesses[best], which[best]


class _Surface:
    """Distances of points (n, 3) from the surface of an object at guessed poses.

    There are g guesses (x, y, z, yaw); `which` gives the index of the resting pose of each.
    """

    def __init__(self, lyings: Sequence[Lying], points: Floats) -> None:
        self._points = points.T
        self._distance = distance_to(lyings[0].shapes)
        self._falls = np.stack([lying.fall.T for lying in lyings])
        self._bases = np.stack([lying.base for lying in lyings])
        models = [lying.model for lying in lyings]
        self._middles = np.array([np.add(m.lower, m.upper)[:2] / 2 for m in models])

    def distances(self, guesses: Floats, which: Which) -> Floats:
        """Signed distances (g, n) of the points; negative inside."""
        standing = self._standing(self._local(guesses), which)
        return self._distance.at(_columns(standing)).reshape(len(guesses), -1)

    def off_only(self, guesses: Floats, which: Which) -> Floats:
        """Residuals (g, n + 2): the distances, and the weighted x and y between the centres."""
        local = self._local(guesses)
        distances = self._distance.at(_columns(self._standing(local, which)))
        middle = (local[:, :2].min(axis=2) + local[:, :2].max(axis=2)) / 2
        centering = _CENTERING * (middle - self._middles[which])
        return np.concatenate((distances.reshape(len(guesses), -1), centering), axis=1)

    def off(self, guesses: Floats, which: Which) -> tuple[Floats, Floats]:
        """The same residuals (g, n + 2), and their derivatives by the guess (g, n + 2, 4)."""
        local = self._local(guesses)
        distances, grows = self._with_gradient(local, which)
        cos, sin = np.cos(guesses[:, 3:]), np.sin(guesses[:, 3:])
        count, points = distances.shape
        off, slope = np.empty((count, points + 2)), np.zeros((count, points + 2, 4))
        off[:, :points] = distances
        slope[:, :points, 0] = sin * grows[:, 1] - cos * grows[:, 0]
        slope[:, :points, 1] = -sin * grows[:, 0] - cos * grows[:, 1]
        slope[:, :points, 2] = -grows[:, 2]
        slope[:, :points, 3] = grows[:, 0] * local[:, 1] - grows[:, 1] * local[:, 0]
        every = np.arange(count)
        for axis, (by_x, by_y) in enumerate(((-cos, -sin), (sin, -cos))):
            ends = local[:, axis].argmin(axis=1), local[:, axis].argmax(axis=1)
            middle = (local[every, axis, ends[0]] + local[every, axis, ends[1]]) / 2
            other = (local[every, 1 - axis, ends[0]] + local[every, 1 - axis, ends[1]]) / 2
            off[:, points + axis] = _CENTERING * (middle - self._middles[which, axis])
            slope[:, points + axis, 0] = _CENTERING * by_x[:, 0]
            slope[:, points + axis, 1] = _CENTERING * by_y[:, 0]
            slope[:, points + axis, 3] = _CENTERING * (other if axis == 0 else -other)
        return off, slope

    def facing(self, guesses: Floats, which: Which, eye: Floats) -> Floats:
        """(g,) the fraction of points on sides of the object that face the camera."""
        local = self._local(guesses)
        _, grows = self._with_gradient(local, which)
        to_eye = _turned(guesses, np.broadcast_to(eye[:, None], (3, 1))) - local
        share: Floats = ((to_eye * grows).sum(axis=1) > 0).mean(axis=1)
        return share

    def _with_gradient(self, local: Floats, which: Which) -> tuple[Floats, Floats]:
        """Distances (g, n), and their gradients (g, 3, n) in the frame of the lying object."""
        distances, grows = self._distance.with_gradient(_columns(self._standing(local, which)))
        standing = grows.reshape(3, len(local), -1).transpose(1, 0, 2)
        return distances.reshape(len(local), -1), self._falls[which].transpose(0, 2, 1) @ standing

    def _local(self, guesses: Floats) -> Floats:
        """The points (g, 3, n) in the frame of the lying object at each guess."""
        return _turned(guesses, self._points)

    def _standing(self, local: Floats, which: Which) -> Floats:
        """The points (g, 3, n) in the frame of the upright object."""
        stood: Floats = self._falls[which] @ (local + self._bases[which][:, :, None])
        return stood


def _turned(guesses: Floats, points: Floats) -> Floats:
    """Transform points (3, n) from `map` to the frames at guesses: (g, 3, n)."""
    off = points[None] - guesses[:, :3, None]
    cos, sin = np.cos(guesses[:, 3:]), np.sin(guesses[:, 3:])
    x, y = off[:, 0].copy(), off[:, 1].copy()
    off[:, 0] = cos * x + sin * y
    off[:, 1] = cos * y - sin * x
    return off


def _columns(points: Floats) -> Floats:
    """Reshape points (g, 3, n) to (3, g * n)."""
    return points.transpose(1, 0, 2).reshape(3, -1)
