"""What the wire costs, on loopback: `python tests/benchmarks/bench_wire.py [--missions N]`.

The simulated robot is served by a process of its own. Told are real times: from a goal to the first
that is heard of it, from a stop to rest, of a picture with depth and lens, and of the same missions
in physics over the wire and in one process.
"""

import argparse
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from served import ZERO, Raw, look_goal, place_goal, served_process

from executive import Session, load_settings
from executive.events import Inbox
from executive.testing.bench import four_rooms
from executive.user import Scripted

DRIVE, LOOK = "/navigate_to_pose", "/head_controller/point_head_action"
COLOR, DEPTH = "/camera/color/image_raw", "/camera/depth/image_raw"
LENS = "/camera/color/camera_info"
GOALS, STOPS = 200, 10
PLACE = "coffee_table"
MISSIONS = (
    ("Bring a sugar_box", "on the counter wagon"),
    ("Bring the hammer", "on the shelf in the lobby"),
    ("Take the mug", "on the coffee table"),
)


def timed(do: Callable[[], object]) -> float:
    """Real seconds."""
    began = time.perf_counter()
    do()
    return time.perf_counter() - began


def goal_to_effect(client: Raw) -> float:
    """From sending a goal to hearing that the robot has begun."""
    began = time.perf_counter()
    id = client.pursue(LOOK, look_goal(PLACE))
    client.hear_of("action_feedback", id=id)
    passed = time.perf_counter() - began
    client.end_of(id)
    return passed


def stop_to_rest(client: Raw, place: str) -> float:
    """From calling a goal off, in full drive, to its end, which is at rest."""
    id = client.pursue(DRIVE, place_goal(place))
    while client.hear_of("publish", topic="/odom")["msg"]["twist"]["twist"]["linear"]["x"] < 0.2:
        pass
    began = time.perf_counter()
    client.say("call_service", service=f"{DRIVE}/_action/cancel_goal", args={"goal_info": ZERO})
    client.end_of(id)
    return time.perf_counter() - began


def picture(client: Raw, place: str, view: int, compression: str) -> float:
    """Colour, depth and lens of what a look has just shown, as a client asks for them."""
    client.do(LOOK, look_goal(place, view))
    topics: dict[str, str] = {}

    def take() -> None:
        for topic in (COLOR, DEPTH, LENS):
            topics[topic] = client.say("subscribe", topic=topic, compression=compression)
        for topic in topics:
            client.hear_of("publish", topic=topic)

    passed = timed(take)
    for topic, id in topics.items():
        client.say("unsubscribe", topic=topic, id=id)
    client.heard.clear()
    return passed


def pictures(client: Raw) -> dict[str, list[float]]:
    """Of all looks at all furniture, in each packing."""
    taken: dict[str, list[float]] = {"cbor": [], "none": []}
    for piece in four_rooms().places():
        client.do(DRIVE, place_goal(piece.name))
        for view in range(len(four_rooms().view_targets(piece.name))):
            for compression, seconds in taken.items():
                seconds.append(picture(client, piece.name, view, compression))
    return taken


def mission(words: str, answer: str, runs: str, **body: Any) -> tuple[float, str]:
    """One mission in real seconds, and how it ended."""
    inbox = Inbox()
    settings = load_settings(llm="none", runs=runs, **body)
    with Session(settings, inbox=inbox, user=Scripted(inbox, [answer])) as session:
        began = time.perf_counter()
        outcome = session.run(words)
        return time.perf_counter() - began, f"{outcome.status}, {outcome.mission_time_s:.1f} s"


def told(what: str, seconds: list[float]) -> None:
    """Print a line."""
    ms = 1000 * np.array(seconds)
    half, most, worst = np.median(ms), np.quantile(ms, 0.99), ms.max()
    print(f"{what:40} median {half:6.1f} ms, p99 {most:6.1f}, worst {worst:6.1f}, of {len(ms)}")


def measure_wire() -> None:
    """Goals, stops and pictures."""
    with served_process() as address, Raw(address) as client:
        assert client.do(DRIVE, place_goal(PLACE))["status"] == 4
        told("goal to effect", [goal_to_effect(client) for _ in range(GOALS)])
        for compression, seconds in pictures(client).items():
            name = {"cbor": "CBOR", "none": "JSON"}[compression]
            told(f"picture with depth and lens, {name}", seconds)
    with served_process("--speed", "1") as address, Raw(address) as client:
        client.subscribe("/odom")
        ways = ["desk", "person"] * (STOPS // 2)
        told("stop to rest, in real time", [stop_to_rest(client, place) for place in ways])


def measure_missions(times: int) -> None:
    """Over the wire and in one process, in turn."""
    sums = {"wire": 0.0, "process": 0.0}
    with tempfile.TemporaryDirectory() as runs:
        for words, answer in MISSIONS * times:
            with served_process() as address:
                wire, end = mission(words, answer, runs, robot=address, profile="served")
            process, other = mission(words, answer, runs, world="physics", camera_hz=0)
            print(f"{words:24} wire {wire:5.1f} s ({end}), process {process:5.1f} s ({other})")
            sums["wire"] += wire
            sums["process"] += process
    print(f"a mission over the wire takes {sums['wire'] / sums['process']:.2f} times as long")


def main() -> None:
    """Print all of it."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--missions", type=int, default=1, metavar="N", help="times (default: 1)")
    options = parser.parse_args()
    measure_wire()
    if options.missions:
        measure_missions(options.missions)


if __name__ == "__main__":
    main()
