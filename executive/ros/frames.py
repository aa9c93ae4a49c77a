"""Where the robot's frames are, from what it says on /tf and /tf_static."""

from bisect import bisect_left
from collections import deque

from scipy.spatial.transform import Rotation, Slerp

from executive.geometry import pose_from, seen_from
from executive.ros.messages import pose_of, stamp_of
from executive.ros.protocol import Message
from executive.types.geometry import Pose

KEPT = 500
"""Poses of a frame that are remembered."""
MOST_FRAMES = 2000
STALE_S = 0.5
"""A pose is good for so long before and after its stamp."""
BACK_S = 1.0
"""A clock that goes back so far was set anew: what was before does not count."""


class FrameTree:
    """Frames by their names, each in its parent, over the last seconds."""

    def __init__(self) -> None:
        """Nothing is known."""
        self._fixed: dict[str, tuple[str, Pose]] = {}
        self._moving: dict[str, tuple[str, deque[tuple[float, Pose]]]] = {}
        self.newest = 0.0
        """The newest stamp (s, by the robot's clock)."""

    def take(self, message: Message, fixed: bool = False) -> None:
        """Take in a `tf2_msgs/TFMessage`."""
        for one in message["transforms"]:
            child = str(one["child_frame_id"]).lstrip("/")
            parent = str(one["header"]["frame_id"]).lstrip("/")
            pose = pose_of(one["transform"])
            if child not in self._fixed and len(self._fixed) + len(self._moving) > MOST_FRAMES:
                continue
            if fixed:
                self._fixed[child] = parent, pose
            else:
                self._move(child, parent, stamp_of(one), pose)

    def _move(self, child: str, parent: str, stamp: float, pose: Pose) -> None:
        before = self._moving.get(child)
        if before is None or before[0] != parent or before[1][-1][0] > stamp + BACK_S:
            before = self._moving[child] = parent, deque(maxlen=KEPT)
            self.newest = stamp
        history = before[1]
        if not history or stamp > history[-1][0]:
            history.append((stamp, pose))
        elif stamp == history[-1][0]:
            history[-1] = stamp, pose
        self.newest = max(self.newest, stamp)

    @property
    def names(self) -> tuple[str, ...]:
        """All frames that were heard of."""
        parents = [parent for parent, _ in (*self._fixed.values(), *self._moving.values())]
        return tuple(sorted({*self._fixed, *self._moving, *parents}))

    def pose(self, frame: str, within: str, stamp: float | None = None) -> Pose | None:
        """Where a frame was in another one at this time (s; None: now); None if nobody told."""
        down = self._chain(frame, stamp)
        up = self._chain(within, stamp)
        if down is None or up is None or down[-1][0] != up[-1][0]:
            return None
        names = [name for name, _ in down]
        if within in names:
            return _joined([pose for _, pose in reversed(down[: names.index(within)])])
        return seen_from(_whole(up), _whole(down))

    def _chain(self, frame: str, stamp: float | None) -> list[tuple[str, Pose]] | None:
        """From the frame to its root, each with its pose in the next; the root's is nothing."""
        chain: list[tuple[str, Pose]] = []
        seen: set[str] = set()
        while frame not in seen:
            seen.add(frame)
            if frame in self._fixed:
                parent, pose = self._fixed[frame]
            elif frame in self._moving:
                parent, history = self._moving[frame]
                found = _at(history, stamp)
                if found is None:
                    return None
                pose = found
            else:
                return [*chain, (frame, Pose())]
            chain.append((frame, pose))
            frame = parent
        return None  # a frame that is its own ancestor


def _at(history: deque[tuple[float, Pose]], stamp: float | None) -> Pose | None:
    """The pose at this time, between the two next to it; None if there is none near."""
    if stamp is None:
        return history[-1][1]
    after = bisect_left(history, stamp, key=lambda one: one[0])
    if after == len(history):
        time, pose = history[-1]
        return pose if stamp - time <= STALE_S else None
    time, pose = history[after]
    if time == stamp:
        return pose
    if after == 0:
        return pose if time - stamp <= STALE_S else None
    earlier, before = history[after - 1]
    part = (stamp - earlier) / (time - earlier)
    return _mixed(before, pose, part)


def _mixed(one: Pose, other: Pose, part: float) -> Pose:
    if one == other:
        return one
    turns = Rotation.from_quat([one.orientation, other.orientation])
    turn = Slerp([0.0, 1.0], turns)(part).as_quat()
    x, y, z = (a + part * (b - a) for a, b in zip(one.position, other.position, strict=True))
    return Pose((x, y, z), (float(turn[0]), float(turn[1]), float(turn[2]), float(turn[3])))


def _whole(chain: list[tuple[str, Pose]]) -> Pose:
    """Where the first of a chain is in its root."""
    return _joined([pose for _, pose in reversed(chain[:-1])])


def _joined(poses: list[Pose]) -> Pose:
    """The last of these frames, each in the one before, in the parent of the first."""
    whole: Pose | None = None
    for pose in poses:
        whole = pose if whole is None else _after(whole, pose)
    return whole or Pose()


def _after(outer: Pose, inner: Pose) -> Pose:
    turn = Rotation.from_quat(outer.orientation)
    position = turn.apply(inner.position) + outer.position
    return pose_from(position, turn * Rotation.from_quat(inner.orientation))
