"""Writes the mission as a rerun recording, to a file, live to a viewer, or both."""

import atexit
import threading
from collections.abc import Callable
from pathlib import Path
from typing import assert_never

import rerun as rr
from rerun_bindings import check_for_rrd_footer, flush_and_cleanup_orphaned_recordings

from executive.records import (
    EventTaken,
    Finished,
    Intervention,
    LlmCall,
    Mishap,
    Note,
    Picture,
    Planned,
    PlannedPath,
    Recalled,
    Record,
    Scene,
    Seen,
    SourceAnswer,
    Tick,
    Transform,
    Transforms,
    TreeShape,
    Utterance,
    Verified,
    WaysTold,
)
from executive.types.perception import Frame, Intrinsics
from logs.images import jpeg_scaled
from logs.recorder import Stamp
from logs.recording.events import in_words
from logs.unwritten import Unwritten
from logs.viewer import blueprint, markdown, program, scene
from logs.viewer.candidates import CandidatesView
from logs.viewer.lines import Line, line
from logs.viewer.scene import Taken
from logs.viewer.timelines import MISSION_TIME, TICK, At, Moment
from logs.viewer.tree import TreeView

APPLICATION = "robot-executive"
FLUSH_S = 5.0
"""Time limit to open, flush or close the recording (s)."""

_SPEAKERS = {"person": (120, 190, 255), "robot": (255, 200, 90)}


class RerunSink:
    """Writes an .rrd file, shows the mission in a viewer, or both.

    Timelines: `mission_time` (to the millisecond), `wall_time` and `tick`. The file contains its
    blueprint.
    """

    def __init__(self, path: Path | None, *, view: bool = False) -> None:
        """Open the recording, named after its folder.

        Args:
            path: the .rrd file; None to write none.
            view: whether to start a viewer and show the mission live.

        Raises:
            ExecutiveError: if the viewer does not start.
            OSError: if the file cannot be opened, or not within `FLUSH_S`.
        """
        self._path = path
        self._viewer = program.start() if view else None
        self._stream = rr.RecordingStream(APPLICATION)
        sinks: list[rr.FileSink | rr.GrpcSink] = []
        if path is not None:
            sinks.append(rr.FileSink(path))
            self._stream.send_recording_name(path.parent.name)
        if self._viewer is not None:
            sinks.append(rr.GrpcSink(self._viewer.address))
        layout = blueprint.mission_blueprint()
        _within(
            FLUSH_S,
            lambda: self._stream.set_sinks(*sinks, default_blueprint=layout),
            "rerun does not open its file",
        )
        layout.let_go()
        self._stream.set_time(MISSION_TIME, duration=0.0)
        self._stream.set_time(TICK, sequence=0)
        scene.log_frames(self._stream)
        self._candidates = CandidatesView(self._stream)
        self._moved: list[At[Transform]] = []
        self._taken: list[At[Taken]] = []
        self._scale = 1.0
        self._intrinsics: Intrinsics | None = None
        self._detections_shown = False
        self._tick = 0
        self._tree: TreeView | None = None
        self._call: LlmCall | None = None
        self._unwritten = Unwritten(type(self).__name__)

    def write(self, stamp: Stamp, record: Record) -> None:
        """Log a record to the view that the blueprint has for it.

        Frames and pictures come often, and so are sent together at the next flush.
        """
        moment = Moment(round(stamp.mission_s * 1e3) * 1_000_000, stamp.wall_ns, self._tick)
        if isinstance(record, Transforms):
            self._moved += [At(moment, transform) for transform in record.transforms]
            return
        moment.set_on(self._stream)
        match record:
            case TreeShape():
                self._tree = TreeView(self._stream, record)
            case Tick():
                self._write_tick(record)
            case LlmCall() | Verified():
                self._write_thought(record)
            case Utterance(speaker, text):
                self._stream.log(
                    blueprint.DIALOG,
                    rr.TextLog(text, level=speaker.upper(), color=_SPEAKERS.get(speaker)),
                )
            case Planned():
                self._candidates.plan(record)
                self._write_line(record)
            case Note() | SourceAnswer() | Recalled() | WaysTold() | Intervention() | Mishap():
                self._write_line(record)
            case EventTaken():
                self._write_event(record)
            case Picture(frame):
                self._write_picture(moment, frame)
            case Seen():
                scene.log_detections(self._stream, record, self._scale)
                self._detections_shown = True
            case Scene(entities):
                scene.log_scene(self._stream, entities)
                self._candidates.place(entities)
                layout = blueprint.mission_blueprint(entities)
                self._stream.send_blueprint(layout)
                layout.let_go()
            case PlannedPath():
                scene.log_path(self._stream, record)
            case Finished(outcome):
                self._stream.log(blueprint.BELIEF, _document(markdown.outcome(outcome)))
            case _:
                assert_never(record)

    def flush(self) -> None:
        """Send everything to the file and the viewer.

        Raises:
            RuntimeError: if that fails, or takes longer than `FLUSH_S`, and there is no viewer.
        """
        self._send_kept()
        try:
            self._stream.flush(timeout_sec=FLUSH_S)
        except RuntimeError:
            if self._viewer is None:
                raise
            # the viewer was closed, and the file goes on

    def close(self) -> None:
        """Write the footer and close the file.

        Raises:
            OSError: if that takes longer than `FLUSH_S`, or the file is not complete then, which
                rerun itself does not tell.
        """
        self._send_kept()
        _within(FLUSH_S, self._let_go, "rerun does not finish its file")
        if self._path is not None and not check_for_rrd_footer(self._path):
            raise OSError("rerun has not finished its file")

    def _let_go(self) -> None:
        """Disconnect, and end the threads of the stream, which rerun keeps until it is asked."""
        self._stream.disconnect()
        self._tree = None
        del self._stream, self._candidates
        flush_and_cleanup_orphaned_recordings()

    def _write_tick(self, tick: Tick) -> None:
        self._tick = tick.number
        self._stream.set_time(TICK, sequence=tick.number)
        if self._tree is not None:
            self._tree.show(tick)
        self._candidates.show(tick.situation)
        self._stream.log(blueprint.BELIEF, _document(markdown.belief(tick.situation)))

    def _write_picture(self, moment: Moment, frame: Frame) -> None:
        self._scale = scene.PICTURE_WIDTH / frame.intrinsics.width
        intrinsics = frame.intrinsics.scaled(self._scale)
        if intrinsics != self._intrinsics:
            self._intrinsics = intrinsics
            scene.log_intrinsics(self._stream, intrinsics)
        self._taken.append(At(moment, Taken(frame.pose, jpeg_scaled(frame, self._scale))))
        if self._detections_shown:
            scene.clear_detections(self._stream)
            self._detections_shown = False

    def _write_thought(self, thought: LlmCall | Verified) -> None:
        if isinstance(thought, LlmCall):
            self._call = thought
            text = markdown.llm_call(thought)
        elif self._call is not None:
            text = markdown.llm_call(self._call, thought)
        else:
            return
        self._stream.log(blueprint.LLM, _document(text))

    def _write_line(self, record: Line) -> None:
        level, text = line(record)
        self._stream.log(blueprint.LOG, rr.TextLog(text, level=level))

    def _write_event(self, taken: EventTaken) -> None:
        text = in_words(taken.event)
        self._stream.log(f"{blueprint.LOG}/events", rr.TextLog(text, level="DEBUG"))

    def _send_kept(self) -> None:
        """Send the kept frames and pictures: many rows cost rerun hardly more than one."""
        moved, taken = self._moved, self._taken
        self._moved, self._taken = [], []
        try:
            if moved:
                scene.send_transforms(self._stream, moved)
        except Exception as error:
            self._tell(Transforms.__name__, error)
        try:
            if taken:
                scene.send_pictures(self._stream, taken)
        except Exception as error:
            self._tell(Picture.__name__, error)

    def _tell(self, kind: str, error: Exception) -> None:
        if note := self._unwritten.note(kind, error):
            self._write_line(note)


def _within(seconds: float, do: Callable[[], None], fault: str) -> None:
    """Call `do` in a thread, and wait for at most `seconds`: rerun waits for a full disk for ever.

    Raises:
        OSError: if it takes longer, or raises.
    """
    failed: list[Exception] = []

    def work() -> None:
        try:
            do()
        except Exception as error:
            failed.append(error)

    working = threading.Thread(target=work, name="rerun", daemon=True)
    working.start()
    working.join(seconds)
    if working.is_alive():
        atexit.unregister(rr.rerun_shutdown)  # it would wait, too
        raise OSError(f"{fault} within {seconds:g} s")
    if failed:
        raise OSError(f"{fault}: {failed[0]}") from failed[0]


def _document(markdown_text: str) -> rr.TextDocument:
    return rr.TextDocument(markdown_text, media_type="text/markdown")
