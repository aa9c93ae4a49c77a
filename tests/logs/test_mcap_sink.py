"""A mission's mcap file, read with mcap's own reader."""

from collections import defaultdict
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory
from sample_mission import STARTED, detection, frame, mission, robot_at, scene

from executive.records import (
    Entity,
    Picture,
    PlannedPath,
    Record,
    Scene,
    Seen,
    Shape,
    Transform,
    Transforms,
)
from executive.types.geometry import Pose
from logs.recorder import Stamp
from logs.recording.channels import TOPICS
from logs.recording.sink import McapSink

START_NS = int(STARTED.timestamp()) * 10**9


def write(path: Path, *records: tuple[float, Record]) -> dict[str, list[tuple[int, Any]]]:
    """Write records and read them back: log time (ns) and message, by topic."""
    sink = McapSink(path, STARTED, {"household.owl": b"<rdf/>"}, {"seed": "7"})
    for time, record in records:
        sink.write(Stamp(time, START_NS + 1), record)
    sink.close()
    found: dict[str, list[tuple[int, Any]]] = defaultdict(list)
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for _, channel, message, decoded in reader.iter_decoded_messages():
            found[channel.topic].append((message.log_time, decoded))
    return found


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "mission.mcap"


def test_a_mission_reaches_every_topic(path: Path) -> None:
    assert set(write(path, *mission())) == set(TOPICS)


def test_log_time_is_run_start_plus_mission_time_and_so_is_the_messages_timestamp(
    path: Path,
) -> None:
    ((_, _), (time, tick), _) = write(path, *mission())["/bt/tick"]
    assert time == START_NS + 2 * 10**9 == tick.timestamp.ToNanoseconds()
    assert tick.wall_time.ToNanoseconds() == START_NS + 1


def test_each_tick_carries_the_status_of_every_behaviour_as_py_trees_ros_numbers_it(
    path: Path,
) -> None:
    messages = write(path, *mission())
    (_, tree), (_, tick) = messages["/bt/tree"][0], messages["/bt/tick"][0]
    assert [b.own_id for b in tree.behaviours] == [b.own_id for b in tick.behaviours]
    assert [b.status for b in tick.behaviours] == [2, 2, 2, 1, 1]
    assert [b.is_active for b in tick.behaviours] == [True, True, True, False, False]
    assert list(tree.behaviours[0].child_ids) == [
        "mission/which places",
        "mission/drive",
        "mission/see",
    ]


def test_a_call_of_the_model_keeps_prompt_reply_parameters_and_cost(path: Path) -> None:
    (_, rank), (_, chat) = write(path, *mission())["/llm/call"]
    assert chat.gen_ai_input_messages[1].content.startswith("I am searching")
    assert "spice rack" in chat.gen_ai_output_messages[0].content
    assert chat.HasField("gen_ai_request_temperature")
    assert chat.gen_ai_request_temperature == 0.0
    assert not chat.HasField("gen_ai_request_top_p")
    assert chat.gen_ai_usage_cache_read_input_tokens == 312 - 40
    assert (chat.prepared_tokens, chat.prepared_s) == (250, 1.2)
    assert [(o.place, o.score) for o in rank.options][0] == ("cupboard", 2.5)


def test_a_picture_is_a_jpeg_with_its_camera_where_it_was(path: Path) -> None:
    messages = write(path, (6.0, Picture(frame())))
    (_, image), (_, camera) = (
        messages["/camera/image/compressed"][0],
        messages["/camera/camera_info"][0],
    )
    decoded = cv2.imdecode(np.frombuffer(image.data, np.uint8), cv2.IMREAD_COLOR)
    assert decoded is not None
    difference = np.abs(cv2.cvtColor(decoded, cv2.COLOR_BGR2RGB).astype(int) - frame().color)
    assert difference.mean() < 2
    assert (camera.width, camera.K[0], camera.K[2]) == (160, 140, 80)
    ((_, tf),) = messages["/tf"]
    (transform,) = tf.transforms
    assert (transform.parent_frame_id, transform.child_frame_id) == ("map", "camera_optical")
    assert transform.translation.z == 1.0


def test_the_robots_own_camera_frame_is_not_contradicted(path: Path) -> None:
    own = Transforms((Transform("head", "camera_optical", Pose()),))
    assert len(write(path, (0.0, own), (1.0, Picture(frame())))["/tf"]) == 1


def test_detections_are_drawn_on_the_picture_that_they_were_seen_in(path: Path) -> None:
    messages = write(path, (6.0, Picture(frame())), (8.0, Seen(0, (detection(),))))
    ((_, annotations),) = messages["/camera/annotations"]
    assert annotations.timestamp.ToNanoseconds() == START_NS + 6 * 10**9
    assert annotations.texts[0].text == "sugar_box 0.91"
    assert [(p.x, p.y) for p in annotations.points[0].points][2] == (100, 80)


def test_the_scene_holds_every_shape_in_its_frame(path: Path, tmp_path: Path) -> None:
    mesh = tmp_path / "cup.obj"
    mesh.write_text("v 0 0 0\n")
    cup = Entity("cup", "map", (Shape("mesh", (1, 1, 1), (1, 0, 0, 1), mesh=str(mesh)),))
    messages = write(path, (0.0, Scene((*scene().entities, cup))), (0.0, robot_at(1.5)))
    ((_, update),) = messages["/scene"]
    home, robot, cup_entity = update.entities
    assert (len(home.cubes), len(robot.cylinders), len(robot.spheres)) == (2, 1, 1)
    assert (robot.frame_id, robot.frame_locked) == ("base_link", True)
    assert cup_entity.models[0].data == b"v 0 0 0\n"
    assert messages["/tf"][0][1].transforms[0].translation.x == 1.5


def test_only_a_mesh_without_colours_of_its_own_is_given_one(path: Path, tmp_path: Path) -> None:
    files = tmp_path / "cup.obj", tmp_path / "apple.glb"
    for file in files:
        file.write_bytes(b"mesh")
    shapes = tuple(Shape("mesh", (1, 1, 1), (1, 1, 1, 1), mesh=str(file)) for file in files)
    messages = write(path, (0.0, Scene((Entity("things", "map", shapes),))))
    cup, apple = messages["/scene"][0][1].entities[0].models
    assert (cup.media_type, cup.override_color) == ("model/obj", True)
    assert (apple.media_type, apple.override_color) == ("model/gltf-binary", False)


def test_a_planned_path_is_drawn_until_it_is_given_up(path: Path) -> None:
    way = PlannedPath(((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)))
    (_, drawn), (_, gone) = write(path, (0.0, way), (1.0, PlannedPath(())))["/scene"]
    assert len(drawn.entities[0].lines[0].points) == 2
    assert gone.deletions[0].id == drawn.entities[0].id


def test_the_file_carries_its_attachments_and_facts(path: Path) -> None:
    write(path)
    with path.open("rb") as file:
        reader = make_reader(file)
        (attachment,) = reader.iter_attachments()
        (metadata,) = reader.iter_metadata()
    assert (attachment.name, attachment.media_type, attachment.data) == (
        "household.owl",
        "application/rdf+xml",
        b"<rdf/>",
    )
    assert metadata.metadata == {"started": STARTED.isoformat(), "seed": "7"}
