"""The layout of the viewer: world, tree, reasoning, dialog."""

from collections.abc import Iterable

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from executive.geometry import vector3
from executive.records import Entity
from logs.viewer import candidates, scene, tree
from logs.viewer.timelines import MISSION_TIME

BELIEF = "belief"
LLM = "llm"
DIALOG = "dialog"
LOG = "log"


class Layout(rrb.Blueprint):
    """A blueprint that releases the stream it was sent with.

    rerun sends a blueprint with a stream of its own, which holds a reference to itself: the stream
    and its two threads would live as long as the process.
    """

    def _log_to_stream(self, stream: rr.RecordingStream) -> None:
        super()._log_to_stream(stream)
        self._sent_by = stream

    def let_go(self) -> None:
        """Release the stream, after sending."""
        self._sent_by.disconnect()
        del self._sent_by


def mission_blueprint(entities: Iterable[Entity] = ()) -> Layout:
    """Left: home and camera; middle: tree; right: belief, model, dialog; below: what ran when.

    Args:
        entities: the scene, once it is known, for a bird's-eye view of all that is fixed in `map`.
    """
    return Layout(
        rrb.Vertical(
            rrb.Horizontal(
                rrb.Vertical(_world(entities), _camera(), row_shares=[3, 2]),
                _behaviours(),
                _words(),
                column_shares=[5, 3, 4],
            ),
            rrb.Tabs(
                rrb.StateTimelineView(origin=tree.LANES, name="What ran when"),
                rrb.StateTimelineView(origin=tree.EVERY, name="Every behaviour"),
            ),
            row_shares=[2, 1],
        ),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        rrb.TimePanel(timeline=MISSION_TIME, state="collapsed"),
        auto_views=False,
        auto_layout=False,
    )


def _world(entities: Iterable[Entity]) -> rrb.Spatial3DView:
    robot = (scene.FRAMES, scene.PLAN, scene.CAMERA)
    thoughts = (candidates.CANDIDATES, candidates.ORDER, candidates.TARGET)
    drawn = (scene.SCENE, *robot, *thoughts)
    return rrb.Spatial3DView(
        origin="/",
        contents=[f"/{path}/**" for path in drawn],
        name="Home",
        spatial_information=rrb.SpatialInformation(target_frame="map"),
        eye_controls=_birds_eye(entities),
        line_grid=False,
    )


def _birds_eye(entities: Iterable[Entity]) -> rrb.EyeControls3D | None:
    """Look down on all shapes that are fixed in `map`; None if there are none."""
    shapes = [s for e in entities if e.frame_id == "map" for s in e.shapes if s.kind != "mesh"]
    if not shapes:
        return None
    centers = np.array([shape.pose.position for shape in shapes])
    sizes = np.array([shape.size for shape in shapes])
    low, high = (centers - sizes / 2).min(axis=0), (centers + sizes / 2).max(axis=0)
    middle = (low + high) / 2
    away = np.linalg.norm((high - low)[:2]) * np.array([0.0, -0.39, 0.58])
    return rrb.EyeControls3D(position=vector3(middle + away), look_target=vector3(middle))


def _camera() -> rrb.Spatial2DView:
    return rrb.Spatial2DView(
        origin=scene.CAMERA,
        name="Camera",
        spatial_information=rrb.SpatialInformation(target_frame=scene.IMAGE_FRAME),
    )


def _behaviours() -> rrb.Tabs:
    return rrb.Tabs(
        rrb.GraphView(origin=tree.BRANCH, name="Behaviour tree: the branch at work"),
        rrb.GraphView(origin=tree.WHOLE, name="Whole tree"),
    )


def _words() -> rrb.Vertical:
    columns = rrb.TextLogColumns(
        timeline_columns=[MISSION_TIME], text_log_columns=["loglevel", "body"]
    )
    return rrb.Vertical(
        rrb.TextDocumentView(origin=BELIEF, name="Where it may be"),
        rrb.TextDocumentView(origin=LLM, name="Language model"),
        rrb.Tabs(
            rrb.TextLogView(origin=DIALOG, name="Dialogue", columns=columns),
            rrb.TextLogView(origin=LOG, name="Log", columns=columns),
        ),
        row_shares=[5, 6, 3],
    )
