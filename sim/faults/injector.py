"""Fault injection: decides when faults strike, and wraps cameras and detectors to apply them.

The wrapped parts know nothing of faults. A fault that strikes is recorded as a `Mishap` for the
reader of the log; the executive is not told.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import TypeVar

import numpy as np

from executive.computing import afterwards
from executive.interfaces.perception import Camera, Detector
from executive.interfaces.runtime import Recorder
from executive.records import Mishap
from executive.types.perception import Detection, Frame
from sim.faults.orders import Blind, Confuse, Fault, Miss, Noise, Rated

F = TypeVar("F", bound=Fault)
R = TypeVar("R", bound=Rated)


class FaultInjector:
    """Tells which faults are active now. Each has its own random generator, seeded by `seed`."""

    def __init__(
        self, faults: Sequence[Fault], recorder: Recorder, now: Callable[[], float], seed: int = 0
    ) -> None:
        """Inject these faults; `now` returns the mission time (s)."""
        self._recorder = recorder
        self._now = now
        self._chances = {
            fault: np.random.default_rng((seed, index)) for index, fault in enumerate(faults)
        }
        self._struck: set[Fault] = set()

    def begin(self) -> None:
        """Begin a mission: faults that strike once may strike again."""
        self._struck.clear()

    def ordered(self, kind: type[F]) -> tuple[F, ...]:
        """All faults of a kind, at whatever time."""
        return tuple(fault for fault in self._chances if isinstance(fault, kind))

    def active(self, kind: type[F]) -> tuple[F, ...]:
        """The faults of a kind that are active now."""
        time = self._now()
        return tuple(fault for fault in self.ordered(kind) if time in fault.during)

    def due(self, kind: type[F]) -> tuple[F, ...]:
        """The active faults of a kind that have not struck in this mission."""
        return tuple(fault for fault in self.active(kind) if fault not in self._struck)

    @property
    def spoils_pictures(self) -> bool:
        """Whether any fault changes pictures, at whatever time."""
        return bool(self.ordered(Blind) or self.ordered(Noise))

    def draw(self, kind: type[R], what: str) -> R | None:
        """Draw at random whether a fault of this kind strikes now.

        Args:
            kind: the kind of fault.
            what: what it does, for the record.

        Returns:
            The fault that strikes, or None.
        """
        for fault in self.active(kind):
            if self._chances[fault].random() < fault.rate:
                self.strike(fault, what)
                return fault
        return None

    def chance(self, fault: Fault) -> np.random.Generator:
        """The random generator of a fault."""
        return self._chances[fault]

    def strike(self, fault: Fault, what: str) -> None:
        """Record what a fault does, and remember that it has struck."""
        self._struck.add(fault)
        afterwards(partial(self._recorder.record, Mishap(str(fault), what)))


class FaultyCamera:
    """A Camera with the faults `Blind` and `Noise`."""

    def __init__(self, camera: Camera, injector: FaultInjector) -> None:
        """Apply faults to the pictures of `camera`."""
        self._camera = camera
        self._injector = injector

    def capture(self) -> Frame:
        """Take a picture, with the faults that are active now."""
        frame = self._camera.capture()
        for fault in (*self._injector.due(Blind), *self._injector.due(Noise)):
            self._injector.strike(fault, "the camera's pictures are spoilt")
        if self._injector.active(Blind):
            return _black(frame)
        for noise in self._injector.active(Noise):
            frame = _noisy(frame, noise.deviation, self._injector.chance(noise))
        return frame


class FaultyDetector:
    """A Detector with the faults `Miss` and `Confuse`, which sees nothing during `Blind`."""

    def __init__(self, detector: Detector, injector: FaultInjector, names: Sequence[str]) -> None:
        """Apply faults to the detections of `detector`; confused labels are from `names`."""
        self._detector = detector
        self._injector = injector
        self._names = names

    @property
    def labels(self) -> frozenset[str] | None:
        """The labels that the detector can return; None if it may return any."""
        return getattr(self._detector, "labels", None)

    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        """Detect objects, with the faults that are active now."""
        if self._injector.active(Blind):
            return ()
        seen = (d for d in self._detector.detect(frame) if not self._overlooks(d))
        return tuple(self._confused(detection) for detection in seen)

    def _overlooks(self, detection: Detection) -> bool:
        what = f"the {detection.label} is overlooked"
        return self._injector.draw(Miss, what) is not None

    def _confused(self, detection: Detection) -> Detection:
        fault = self._injector.draw(Confuse, f"the {detection.label} is taken for something else")
        if fault is None:
            return detection
        others = [name for name in self._names if name != detection.label]
        return replace(detection, label=str(self._injector.chance(fault).choice(others)))


def _black(frame: Frame) -> Frame:
    depth = np.full_like(frame.depth, np.inf)
    return replace(frame, color=np.zeros_like(frame.color), depth=depth)


def _noisy(frame: Frame, deviation: float, chance: np.random.Generator) -> Frame:
    color = frame.color + chance.normal(0.0, 255.0 * deviation, frame.color.shape)
    depth = frame.depth + chance.normal(0.0, deviation, frame.depth.shape).astype(np.float32)
    return replace(frame, color=color.clip(0, 255).astype(np.uint8), depth=depth.clip(0.01, None))
