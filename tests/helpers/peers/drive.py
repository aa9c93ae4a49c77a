"""Drives a served robot with roslibpy, and prints what came of it as JSON.

Usage: python drive.py PORT < goals.json
"""

import base64
import json
import sys
import threading
from typing import Any

import roslibpy

PATIENCE_S = 120.0


def pursue(ros: Any, goal: dict[str, Any], cancel_at_first: bool) -> dict[str, Any]:
    """Send a goal of NavigateToPose to its end."""
    kind = "nav2_msgs/action/NavigateToPose"
    action = roslibpy.ActionClient(ros, "/navigate_to_pose", kind)
    ended, got, heard = threading.Event(), {}, []

    def end(result: Any) -> None:
        got["result"] = result if isinstance(result, str) else _plain(result)
        ended.set()

    def feedback(_: Any) -> None:
        heard.append(1)
        if cancel_at_first and len(heard) == 1:
            action.cancel_goal(ids[0])

    ids = [""]
    ids[0] = action.send_goal(roslibpy.Goal(goal), end, feedback, end)
    assert ended.wait(PATIENCE_S)
    return {**got, "heard": len(heard)}


def picture(ros: Any) -> dict[str, Any]:
    """The next one."""
    topic = roslibpy.Topic(ros, "/camera/color/image_raw", "sensor_msgs/Image")
    come, got = threading.Event(), []

    def take(message: Any) -> None:
        got.append(message)
        come.set()

    topic.subscribe(take)
    assert come.wait(PATIENCE_S)
    topic.unsubscribe()
    return dict(got[0])


def _plain(value: Any) -> Any:
    return json.loads(json.dumps(value, default=lambda one: getattr(one, "data", str(one))))


def main() -> None:
    """Do all of it."""
    goals = json.load(sys.stdin)
    ros = roslibpy.Ros("127.0.0.1", int(sys.argv[1]))
    ros.run()
    reached = pursue(ros, goals["near"], cancel_at_first=False)
    cancelled = pursue(ros, goals["far"], cancel_at_first=True)
    shown = picture(ros)
    service = roslibpy.Service(ros, "/rosapi/topic_type", "rosapi_msgs/srv/TopicType")
    kind = service.call(roslibpy.ServiceRequest({"topic": "/odom"}))["type"]
    told = {
        "reached": reached,
        "cancelled": cancelled,
        "pixels": len(base64.b64decode(shown["data"])),
        "kind": kind,
        "topics": ros.get_topics(),
    }
    ros.terminate()
    print(json.dumps(told))


main()
