"""Where a robot's frames are, from what it says on /tf."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from executive.ros.frames import KEPT, FrameTree
from executive.ros.packets import PacketError
from executive.types.geometry import Pose

COORDINATE = st.floats(-10, 10)
TURN = st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: sum(v * v for v in q) > 0.1)
POSE = st.builds(
    lambda position, turn: Pose(position, tuple(Rotation.from_quat(turn).as_quat().tolist())),
    st.tuples(COORDINATE, COORDINATE, COORDINATE),
    TURN,
)


def said(parent: str, child: str, pose: Pose, time_s: float = 1.0) -> dict[str, Any]:
    whole = int(time_s)
    stamp = {"sec": whole, "nanosec": round((time_s - whole) * 1e9)}
    transform = {
        "translation": dict(zip("xyz", pose.position, strict=True)),
        "rotation": dict(zip("xyzw", pose.orientation, strict=True)),
    }
    header = {"frame_id": parent, "stamp": stamp}
    return {"transforms": [{"header": header, "child_frame_id": child, "transform": transform}]}


def matrix(pose: Pose) -> Any:
    whole = np.eye(4)
    whole[:3, :3] = Rotation.from_quat(pose.orientation).as_matrix()
    whole[:3, 3] = pose.position
    return whole


@given(POSE, POSE, POSE)
def test_frames_are_joined_along_their_chain(one: Pose, two: Pose, three: Pose) -> None:
    tree = FrameTree()
    tree.take(said("map", "odom", one))
    tree.take(said("odom", "base", two))
    tree.take(said("base", "eye", three), fixed=True)
    found = tree.pose("eye", "map")
    assert found is not None
    assert np.allclose(matrix(found), matrix(one) @ matrix(two) @ matrix(three), atol=1e-6)


@given(POSE, POSE)
def test_a_frame_is_seen_from_a_sister(one: Pose, two: Pose) -> None:
    tree = FrameTree()
    tree.take(said("map", "left", one))
    tree.take(said("map", "right", two))
    found = tree.pose("right", "left")
    assert found is not None
    assert np.allclose(matrix(found), np.linalg.inv(matrix(one)) @ matrix(two), atol=1e-6)


def test_what_was_said_of_one_frame_comes_out_to_the_digit() -> None:
    pose = Pose((0.1, 1 / 3, 1e-17), tuple(Rotation.from_euler("z", 0.1).as_quat().tolist()))
    tree = FrameTree()
    tree.take(said("map", "eye", pose))
    assert tree.pose("eye", "map") == pose


def test_between_two_moments_a_frame_is_between_two_places() -> None:
    tree = FrameTree()
    tree.take(said("map", "base", Pose((0.0, 0.0, 0.0)), 1.0))
    tree.take(said("map", "base", Pose((2.0, 0.0, 0.0)), 2.0))
    assert tree.pose("base", "map", 1.5) == Pose((1.0, 0.0, 0.0))


@pytest.mark.parametrize("time_s", [0.1, 9.0])
def test_long_before_and_after_nobody_knows(time_s: float) -> None:
    tree = FrameTree()
    tree.take(said("map", "base", Pose(), 1.0))
    assert tree.pose("base", "map", time_s) is None


def test_a_clock_that_is_set_back_begins_anew() -> None:
    tree = FrameTree()
    tree.take(said("map", "base", Pose((5.0, 0.0, 0.0)), 100.0))
    tree.take(said("map", "base", Pose((1.0, 0.0, 0.0)), 3.0))
    assert tree.pose("base", "map") == Pose((1.0, 0.0, 0.0))


@pytest.mark.parametrize("wrong", [math.nan, math.inf, "nan", 2.0**40])
def test_a_stamp_that_is_no_time_spoils_none_that_come_after(wrong: object) -> None:
    tree = FrameTree()
    odd = said("map", "base", Pose())
    odd["transforms"][0]["header"]["stamp"]["sec"] = wrong
    with pytest.raises(PacketError, match="a time that is none"):
        tree.take(odd)
    tree.take(said("map", "base", Pose((1.0, 0.0, 0.0)), 3.0))
    assert tree.pose("base", "map", 3.0) == Pose((1.0, 0.0, 0.0))


def test_unknown_frames_and_rings_are_nowhere() -> None:
    tree = FrameTree()
    tree.take(said("a", "b", Pose()))
    tree.take(said("b", "a", Pose()))
    assert tree.pose("a", "b") is None
    assert tree.pose("nothing", "map") is None


def test_only_so_many_moments_are_kept() -> None:
    tree = FrameTree()
    for number in range(KEPT + 100):
        tree.take(said("map", "base", Pose(), 1.0 + number))
    assert tree.pose("base", "map", 1.0) is None
    assert tree.pose("base", "map", KEPT + 50.0) == Pose()
