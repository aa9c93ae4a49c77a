"""A node of ROS 2 with what a robot with Nav2, a depth camera and no arm has: profile `nav2`."""

import math
import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import rclpy
from geometry_msgs.msg import TransformStamped
from nav2_msgs.action import ComputePathToPose, NavigateToPose, Spin
from nav2_msgs.msg import SpeedLimit
from nav_msgs.msg import Odometry
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.executors import MultiThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from ros2.spinning import spin
from sensor_msgs.msg import CameraInfo, Image
from tf2_msgs.msg import TFMessage

WIDTH, HEIGHT, FOCAL, EYE_M = 64, 48, 60.0, 1.0
SPEED_M_S, TURN_RAD_S, PERIOD_S = 1.5, 2.0, 0.05
CAMERA = "/camera/color", "/camera/aligned_depth_to_color"


class Nav2Robot:
    """It drives straight to where it is sent, and sees an empty floor."""

    def __init__(self, at: tuple[float, float, float]) -> None:
        self.at, self.speed = list(at), 0.0
        self.goals: list[tuple[float, float]] = []
        self.limits: list[float] = []
        self.rejects, self.aborts = False, ""
        self.context = rclpy.Context()
        rclpy.init(context=self.context)
        self.node = rclpy.create_node("robot", context=self.context)
        self.executor = MultiThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self._serve(NavigateToPose, "/navigate_to_pose", self._navigate)
        self._serve(Spin, "/spin", self._spin)
        self._serve(ComputePathToPose, "/compute_path_to_pose", self._plan)
        heard = self.limits
        self.node.create_subscription(
            SpeedLimit, "/speed_limit", lambda one: heard.append(one.speed_limit), 5
        )
        self._out = self._publishers()
        self.node.create_timer(PERIOD_S, self._tell)
        threading.Thread(target=spin, args=(self.executor,), daemon=True).start()

    def close(self) -> None:
        self.executor.shutdown(timeout_sec=1.0)
        self.context.try_shutdown()

    # --- actions ---

    def _serve(self, kind: Any, name: str, execute: Callable[[Any], Any]) -> None:
        ActionServer(
            self.node,
            kind,
            name,
            execute_callback=execute,
            goal_callback=lambda _: GoalResponse.REJECT if self.rejects else GoalResponse.ACCEPT,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
        )

    def _navigate(self, handle: Any) -> Any:
        pose, result = handle.request.pose.pose, NavigateToPose.Result()
        self.goals.append((pose.position.x, pose.position.y))
        if self.aborts:
            handle.abort()
            result.error_code, result.error_msg = 9000, self.aborts
            return result
        feedback = NavigateToPose.Feedback()
        while (left := math.dist(self.at[:2], self.goals[-1])) > 1e-3:
            if handle.is_cancel_requested:
                self.speed = 0.0
                handle.canceled()
                return result
            part, self.speed = min(1.0, SPEED_M_S * PERIOD_S / left), SPEED_M_S
            self.at[0] += part * (self.goals[-1][0] - self.at[0])
            self.at[1] += part * (self.goals[-1][1] - self.at[1])
            feedback.distance_remaining = left
            handle.publish_feedback(feedback)
            time.sleep(PERIOD_S)
        self.at[2] = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
        self.speed = 0.0
        handle.succeed()
        return result

    def _spin(self, handle: Any) -> Any:
        left = handle.request.target_yaw
        while abs(left) > 1e-3:
            if handle.is_cancel_requested:
                handle.canceled()
                return Spin.Result()
            step = math.copysign(min(abs(left), TURN_RAD_S * PERIOD_S), left)
            self.at[2], left = self.at[2] + step, left - step
            time.sleep(PERIOD_S)
        handle.succeed()
        return Spin.Result()

    def _plan(self, handle: Any) -> Any:
        goal, result = handle.request.goal, ComputePathToPose.Result()
        end = goal.pose.position
        for part in np.linspace(0.0, 1.0, 100):
            pose = type(goal)(header=goal.header)
            pose.pose.position.x = self.at[0] + part * (end.x - self.at[0])
            pose.pose.position.y = self.at[1] + part * (end.y - self.at[1])
            result.path.poses.append(pose)
        handle.succeed()
        return result

    # --- topics ---

    def _publishers(self) -> dict[str, Any]:
        kept = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        made = self.node.create_publisher
        color, depth = CAMERA
        fixed = made(TFMessage, "/tf_static", kept)
        fixed.publish(TFMessage(transforms=[self._eye()]))
        return {
            "fixed": fixed,
            "tf": made(TFMessage, "/tf", 10),
            "odom": made(Odometry, "/odom", 10),
            "color": made(Image, f"{color}/image_raw", qos_profile_sensor_data),
            "lens": made(CameraInfo, f"{color}/camera_info", qos_profile_sensor_data),
            "depth": made(Image, f"{depth}/image_raw", qos_profile_sensor_data),
        }

    def _tell(self) -> None:
        now = self.node.get_clock().now().to_msg()
        base = self._frame("map", "base_link")
        base.transform.translation.x, base.transform.translation.y = self.at[:2]
        base.transform.rotation.z = math.sin(self.at[2] / 2)
        base.transform.rotation.w = math.cos(self.at[2] / 2)
        base.header.stamp = now
        self._out["tf"].publish(TFMessage(transforms=[base]))
        odometry = Odometry()
        odometry.header.stamp = now
        odometry.twist.twist.linear.x = self.speed
        self._out["odom"].publish(odometry)
        lens = CameraInfo(width=WIDTH, height=HEIGHT)
        lens.k = np.array([FOCAL, 0, WIDTH / 2, 0, FOCAL, HEIGHT / 2, 0, 0, 1.0])
        lens.header.stamp, lens.header.frame_id = now, "camera_optical"
        rows = np.arange(HEIGHT) - HEIGHT // 2
        depth = np.zeros((HEIGHT, WIDTH), "<u2")
        depth[rows > 3] = (1000 * EYE_M * FOCAL / rows[rows > 3])[:, None]
        color = np.full((HEIGHT, WIDTH, 3), 90, np.uint8)
        self._out["lens"].publish(lens)
        self._out["color"].publish(self._image(lens.header, "rgb8", color, 3))
        self._out["depth"].publish(self._image(lens.header, "16UC1", depth, 2))

    def _image(self, header: Any, encoding: str, pixels: Any, of_pixel: int) -> Image:
        image = Image(header=header, height=HEIGHT, width=WIDTH, encoding=encoding)
        image.step, image.data = WIDTH * of_pixel, pixels.tobytes()
        return image

    def _eye(self) -> TransformStamped:
        eye = self._frame("base_link", "camera_optical")
        eye.transform.translation.z = EYE_M
        turn = eye.transform.rotation
        turn.x, turn.y, turn.z, turn.w = -0.5, 0.5, -0.5, 0.5
        return eye

    def _frame(self, parent: str, child: str) -> TransformStamped:
        frame = TransformStamped(child_frame_id=child)
        frame.header.frame_id = parent
        return frame
