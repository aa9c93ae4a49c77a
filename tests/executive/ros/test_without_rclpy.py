"""Where there is no ROS 2, `--robot ros2:` says what to do."""

import importlib.util

import pytest
from second_robot import PROFILE

from executive.__main__ import main


@pytest.mark.skipif(importlib.util.find_spec("rclpy") is not None, reason="there is ROS 2 here")
def test_without_rclpy_it_is_said_what_to_do(capsys: pytest.CaptureFixture[str]) -> None:
    robot = ("--robot", "ros2:", "--profile", str(PROFILE))
    assert main([*robot, "--llm", "none", "--user", "none", "Find a mug"]) == 2
    said = capsys.readouterr().err
    assert "rclpy cannot be imported" in said
    assert "source its setup.bash" in said
