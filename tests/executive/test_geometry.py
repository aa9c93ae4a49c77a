"""Turns are those of SciPy, and the instant world does without it."""

import subprocess
import sys
from pathlib import Path

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial.transform import Rotation

from executive.geometry import matrix_of, orientation_of, transform, turned
from executive.types.geometry import Pose

numbers = st.floats(-10, 10)
four = st.tuples(numbers, numbers, numbers, numbers)
three = st.tuples(numbers, numbers, numbers)
points = arrays(float, st.tuples(st.integers(0, 5), st.just(3)), elements=numbers)


@given(orientation=four, position=three, vectors=points)
def test_a_quaternion_turns_as_it_does_in_scipy(orientation, position, vectors):
    assume(np.linalg.norm(orientation) > 1e-3)
    turn = Rotation.from_quat(orientation)
    np.testing.assert_allclose(matrix_of(orientation), turn.as_matrix(), atol=1e-15)
    np.testing.assert_allclose(turned(orientation, vectors), turn.apply(vectors), atol=1e-13)
    moved = transform(Pose(position, orientation), vectors)
    np.testing.assert_allclose(moved, turn.apply(vectors) + position, atol=1e-13)


@given(angles=three)
def test_turns_about_the_axes_are_the_quaternion_that_they_are_in_scipy(angles):
    expected = Rotation.from_euler("xyz", angles).as_quat()
    np.testing.assert_allclose(orientation_of(angles), expected, atol=1e-15)


MISSION = """
import sys
from executive import Session, load_settings
settings = load_settings(world="fake", llm="none", user="oracle", runs=sys.argv[1])
with Session(settings) as session:
    session.run("Bring a sugar_box")
print(*sys.modules)
"""


def test_a_recorded_mission_in_the_instant_world_imports_nothing_that_is_for_physics(
    tmp_path: Path,
):
    done = subprocess.run(
        [sys.executable, "-c", MISSION, str(tmp_path)], capture_output=True, text=True, check=True
    )
    assert {"rerun", "mcap"} < (loaded := set(done.stdout.split()))
    assert loaded.isdisjoint({"scipy", "pybullet", "onnxruntime"})
