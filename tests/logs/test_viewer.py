"""The recording as the real viewer draws it, without a display.

With `SCREENSHOTS=DIR` in the environment the pictures are kept there, to be looked at.
"""

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from patience import PATIENCE_S
from rerun.experimental import ViewerClient
from sample_mission import STARTED, frame, mission

from executive.records import Picture
from logs.__main__ import main
from logs.recorder import Stamp
from logs.recording.sink import McapSink
from logs.viewer import program
from logs.viewer.sink import RerunSink
from logs.viewer.timelines import MISSION_TIME

pytestmark = [
    pytest.mark.viewer,
    pytest.mark.skipif(
        not list(Path("/usr/share/vulkan/icd.d").glob("*.json")),
        reason="no Vulkan driver: install mesa-vulkan-drivers",
    ),
]

NOTICES_PX = 80
"""Height of the strip at the top in which the viewer shows notices of its own for a while."""


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("run")
    sinks = (RerunSink(folder / "mission.rrd"), McapSink(folder / "mission.mcap", STARTED, {}, {}))
    at_the_start = replace(frame(), color=np.zeros_like(frame().color))
    for sink in sinks:
        for mission_s, record in ((0.0, Picture(at_the_start)), *mission()):
            sink.write(Stamp(mission_s, 0), record)
        sink.close()
    return folder


@pytest.fixture(scope="module")
def client(run: Path) -> Iterator[ViewerClient]:
    with opened(run / "mission.rrd") as client:
        yield client


@contextmanager
def opened(recording: Path) -> Iterator[ViewerClient]:
    """A viewer without a window that shows the recording."""
    live = program.start("--headless")
    try:
        client = ViewerClient.connect(live.address)
        client.open(str(recording))
        yield client
    finally:
        live.close()


def screenshot(client: ViewerClient, mission_s: float) -> NDArray[np.uint8]:
    """What the viewer shows at this mission time."""
    client.set_time(MISSION_TIME, duration=mission_s, play_state="paused")
    return settled(client, f"mission-{mission_s:g}s")


def settled(client: ViewerClient, name: str) -> NDArray[np.uint8]:
    """What the viewer shows once three pictures in a row agree."""
    latest = time.monotonic() + PATIENCE_S
    pictures = [b"", client.take_screenshot()]
    while client.get_state().loading or len(set(pictures[-3:])) > 1:
        assert time.monotonic() < latest, "the view does not settle"
        time.sleep(0.2)
        pictures.append(client.take_screenshot())
    picture = pictures[-1]
    if folder := os.environ.get("SCREENSHOTS"):
        Path(folder).mkdir(parents=True, exist_ok=True)
        (Path(folder) / f"{name}.png").write_bytes(picture)
    decoded = cv2.imdecode(np.frombuffer(picture, np.uint8), cv2.IMREAD_COLOR)
    assert decoded is not None
    return decoded[NOTICES_PX:].astype(np.uint8)


def test_every_view_draws_without_complaint_and_the_picture_follows_the_time(
    client: ViewerClient,
) -> None:
    while_thinking = screenshot(client, 1.5)
    assert_healthy(client)
    while_seeing = screenshot(client, 6.2)
    assert_healthy(client)
    assert (while_thinking != while_seeing).mean() > 0.01
    assert_same(screenshot(client, 1.5), while_thinking)


def test_the_blueprint_in_the_file_lays_out_the_views(client: ViewerClient) -> None:
    assert {view.name for view in client.get_state().views} >= {
        "Home",
        "Camera",
        "Behaviour tree: the branch at work",
        "Where it may be",
        "Language model",
        "Dialogue",
        "What ran when",
    }


def test_the_picture_and_its_detection_are_on_screen(client: ViewerClient) -> None:
    assert green(screenshot(client, 6.2)) > green(screenshot(client, 5.0)) + 100


def test_rerun_draws_the_mcap_too_without_complaint(run: Path) -> None:
    began = STARTED.timestamp()
    with opened(run / "mission.mcap") as client:
        pictures = []
        for mission_s in (0.5, 4.0, 6.2):
            client.set_time("message_log_time", timestamp=began + mission_s, play_state="paused")
            pictures.append(settled(client, f"mcap-{mission_s:g}s"))
            assert_healthy(client)
        kinds = {view.view_class for view in client.get_state().views}
    assert {"2D", "3D", "TextLog"} <= kinds
    assert (pictures[1] != pictures[2]).mean() > 0.01


def test_a_picture_of_the_viewer_is_taken_from_the_command_line(run: Path, tmp_path: Path) -> None:
    file = tmp_path / "picture.png"
    assert main(["view", str(run), "--at", "6.2", "--png", str(file)]) == 0
    taken = cv2.imread(str(file))
    assert taken is not None
    assert green(taken.astype(np.uint8)) > 100


def green(image: NDArray[np.uint8]) -> int:
    """Pixels in the colour of a detection's rectangle."""
    blue, green, red = image[..., 0], image[..., 1], image[..., 2]
    return int(((abs(red.astype(int) - 60) < 12) & (green > 200) & (blue < 110)).sum())


def assert_healthy(client: ViewerClient) -> None:
    assert {view.name: view.reports for view in client.get_state().views if view.reports} == {}


def assert_same(first: NDArray[np.uint8], second: NDArray[np.uint8]) -> None:
    assert (first != second).mean() < 0.001
