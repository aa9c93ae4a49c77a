"""Clients that others wrote drive the served robot, unmodified: npm's roslib, and roslibpy."""

import importlib.util
import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_S
from served import place_goal, served

from sim.served.offered import GRAPH

pytestmark = pytest.mark.peers
PEERS = Path(__file__).parents[2] / "helpers" / "peers"


def driven_by(command: list[str], whole_address: bool) -> dict[str, Any]:
    """What a client tells that drives near, then far and is called off, and takes a picture."""
    with served(speed=3.0) as robot:
        address = robot.server.address
        where = address if whole_address else address.rpartition(":")[2]
        goals = {"near": place_goal("coffee_table"), "far": place_goal("desk")}
        ended = subprocess.run(
            [*command, where],
            input=json.dumps(goals),
            capture_output=True,
            text=True,
            timeout=PATIENCE_S,
        )
    assert ended.returncode == 0, ended.stderr
    told: dict[str, Any] = json.loads(ended.stdout)
    return told


def check_what_both_tell(told: dict[str, Any]) -> None:
    assert told["reached"]["heard"] >= 1
    assert told["pixels"] == 160 * 120 * 3
    assert told["kind"] == "nav_msgs/msg/Odometry"
    assert set(told["topics"]) == set(GRAPH.topics)


def test_roslib_of_npm_drives_it() -> None:
    node = shutil.which("node")
    if node is None or not (PEERS / "node_modules" / "roslib").exists():
        pytest.skip("needs node, and npm install in tests/helpers/peers")
    told = driven_by([node, str(PEERS / "drive.mjs")], whole_address=True)
    check_what_both_tell(told)
    assert told["reached"]["values"] == {"error_code": 0, "error_msg": ""}
    assert "canceled" in told["cancelled"]["why"]
    assert told["same"], "JSON and CBOR show the same picture"


def test_roslibpy_drives_it() -> None:
    if importlib.util.find_spec("roslibpy") is None:
        pytest.skip("needs roslibpy: pip install -e '.[peers]'")
    told = driven_by([sys.executable, str(PEERS / "drive.py")], whole_address=False)
    check_what_both_tell(told)
    assert told["reached"]["result"]["status"] == "GoalStatus.SUCCEEDED"
    assert told["cancelled"]["result"]["status"] == "GoalStatus.CANCELED"
