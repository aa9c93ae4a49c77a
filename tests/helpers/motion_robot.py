"""A robot of the tests' own with what MoveIt 2 and a gripper offer, and no skill of its own.

Its arm is where it is sent, as far as it reaches; its fingers hold what is between them.
"""

from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation
from second_robot import ACTIONS, EYE_M, TOPICS, SecondRobot
from websockets.asyncio.server import ServerConnection

from executive.ros.moveit import SEMANTICS, SEMANTICS_TYPE
from executive.ros.protocol import GoalStatus, Operation, Publish, Subscribe, encode

PROFILE = Path(__file__).with_name("motion_robot.toml")
REACH_M, SHOULDER_M = 1.3, 0.8
BETWEEN_M = 0.06
"""What is so near to the point between the fingers is held."""
FAR_MM = 3000
CARRIED = np.array([0.3, 0.0, 1.0])
NO_WAY = -31
End = tuple[GoalStatus, dict[str, Any]]
"""A goal's status, and what its result says."""


class MotionRobot(SecondRobot):
    """Besides driving: a head that follows trajectories, an arm, fingers."""

    topics = {**TOPICS, SEMANTICS: SEMANTICS_TYPE}
    actions = {
        "/acme/go": ACTIONS["/acme/go"],
        "/acme/head": "control_msgs/action/FollowJointTrajectory",
        "/move_action": "moveit_msgs/action/MoveGroup",
        "/acme/gripper": "control_msgs/action/GripperCommand",
    }

    def __init__(self, at: tuple[float, float, float]) -> None:
        super().__init__(at)
        self.head = (0.0, 0.0)
        self.tip, self.turn = CARRIED, Rotation.from_euler("y", np.pi)
        """In the frame of the base."""
        self.thing: np.ndarray | None = None
        """The middle of the only thing there is, in the map."""
        self.turned = Rotation.identity()
        self.grasp: tuple[np.ndarray, Rotation] | None = None
        """Where it is in the hand, if it is there."""
        self.srdf = (
            '<robot name="acme"><group name="arm"><joint name="elbow"/></group>'
            '<group name="all"><group name="arm"/></group></robot>'
        )
        self.is_blind = False
        self.squeezes_on = False
        """Whether closing the fingers has no end."""
        self.ends: dict[str, list[End | None]] = {}
        """How the next goals of an action end, with nothing done; None: as they should."""
        self.motions: list[dict[str, Any]] = []
        """What it was asked for, each with the scene it was given."""

    def drop(self) -> None:
        """Lose what is in the hand."""
        self.grasp, self.holds = None, ""

    async def _take(self, client: ServerConnection, operation: Operation) -> None:
        await super()._take(client, operation)
        if isinstance(operation, Subscribe) and operation.topic == SEMANTICS:
            await client.send(encode(Publish(SEMANTICS, {"data": self.srdf})))

    async def _pursue(self, action: str) -> None:
        _, goal = self._under_way[action]
        assert isinstance(goal.args, dict)
        ends = self.ends.get(action)
        if ends and (end := ends.pop(0)) is not None:
            status, said = end
            await self._end(action, status, **said)
            return
        match action:
            case "/acme/head":
                pan, tilt = goal.args["trajectory"]["points"][0]["positions"]
                self.head = pan, tilt
                await self._end(action, GoalStatus.SUCCEEDED)
            case "/move_action":
                scene = goal.args["planning_options"]["planning_scene_diff"]
                await self._move({**goal.args["request"], "scene": scene})
            case "/acme/gripper":
                await self._grip(goal.args["command"]["position"])
            case _:
                await super()._pursue(action)

    async def _move(self, request: dict[str, Any]) -> None:
        self.motions.append(request)
        [wanted] = request["goal_constraints"]
        to, turn = CARRIED, self.turn
        if "position_constraints" in wanted:
            region = wanted["position_constraints"][0]["constraint_region"]
            at = region["primitive_poses"][0]["position"]
            turned = wanted["orientation_constraints"][0]["orientation"]
            to = np.array([at[axis] for axis in "xyz"])
            turn = Rotation.from_quat([turned[axis] for axis in "xyzw"])
        if np.linalg.norm(to - (0.0, 0.0, SHOULDER_M)) > REACH_M:
            code = {"val": NO_WAY}
            await self._end("/move_action", GoalStatus.ABORTED, error_code=code)
            return
        self.tip, self.turn = to, turn
        self._bring()
        await self._end("/move_action", GoalStatus.SUCCEEDED, error_code={"val": 1})

    async def _grip(self, position: float) -> None:
        at, turn = self._hand()
        closes, near = position == 0.0, False
        if closes and self.thing is not None:
            near = bool(np.linalg.norm(self.thing - at) < BETWEEN_M)
            if near:
                self.grasp = turn.inv().apply(self.thing - at), turn.inv() * self.turned
        elif not closes:
            self.grasp = None
        self.holds = "thing" if self.grasp is not None else ""
        if closes and self.squeezes_on:
            return
        said = {"position": position, "stalled": near, "reached_goal": not near}
        await self._end("/acme/gripper", GoalStatus.SUCCEEDED, **said)

    def _hand(self) -> tuple[np.ndarray, Rotation]:
        """Where the point between the fingers is in the map."""
        x, y, yaw = self.at
        base = Rotation.from_euler("z", yaw)
        return base.apply(self.tip) + (x, y, 0.0), base * self.turn

    def _bring(self) -> None:
        if self.grasp is not None:
            at, turn = self._hand()
            self.thing = at + turn.apply(self.grasp[0])
            self.turned = turn * self.grasp[1]

    def _frames(self) -> dict[str, Any]:
        self._bring()
        told = super()._frames()
        pan, tilt = self.head
        ahead = Rotation.from_quat([-0.5, 0.5, -0.5, 0.5])
        eye = Rotation.from_euler("ZY", (pan, tilt)) * ahead
        told["transforms"] = [
            told["transforms"][0],
            self._frame("body", "neck", np.array([0.1, 0.0, EYE_M]), Rotation.identity()),
            self._frame("neck", "eye", np.zeros(3), eye),
            self._frame("body", "grip", self.tip, self.turn),
        ]
        return told

    def _range(self) -> dict[str, Any]:
        """Only the uppermost row sees something, far behind what it looks at; blind, none does."""
        said = super()._range()
        row = b"" if self.is_blind else FAR_MM.to_bytes(2, "little") * (said["step"] // 2)
        return {**said, "data": row.ljust(len(said["data"]), b"\0")}

    def _frame(self, parent: str, child: str, at: np.ndarray, turn: Rotation) -> dict[str, Any]:
        transform = {
            "translation": dict(zip("xyz", map(float, at), strict=True)),
            "rotation": dict(zip("xyzw", map(float, turn.as_quat()), strict=True)),
        }
        return {
            "header": self._header(parent),
            "child_frame_id": child,
            "transform": transform,
        }
