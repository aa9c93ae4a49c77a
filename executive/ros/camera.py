"""The robot's camera: a picture when one is wanted, colour with depth, and where it was taken."""

import asyncio
from concurrent.futures import CancelledError
from itertools import count

import numpy as np

from executive.computing import still_wanted
from executive.geometry import Floats, back_project
from executive.guards import in_words
from executive.ros.link import Link, LinkError
from executive.ros.losses import Losses
from executive.ros.messages import stamp_of
from executive.ros.pictures import color_of, depth_of, lens_of
from executive.ros.profile import Profile
from executive.ros.protocol import Message
from executive.ros.senses import Senses
from executive.ros.thread import WireThread
from executive.types.geometry import Pose
from executive.types.perception import Frame

TOGETHER_S = 0.02
"""Colour and depth that are no further apart are of one moment."""
KEPT = 8
"""Pictures of either that wait for their other."""
LINK_S = 5.0


class LateError(LinkError):
    """A picture did not come in the time that it may take."""


class Shutter:
    """Takes pictures; belongs to the thread of the wire."""

    def __init__(self, link: Link, profile: Profile, senses: Senses) -> None:
        """Take no picture yet."""
        self._link = link
        self._profile = profile
        self._senses = senses
        self._numbers = count()

    async def take(self) -> Frame:
        """A picture of now, within the time that it may take.

        Raises:
            LinkError: if none comes, or not such as can be used.
        """
        await self._link.ready(LINK_S)
        color, depth, lens = await self._pair()
        try:
            self._refuse_other_views(color, depth, lens)
            pixels = await asyncio.to_thread(lambda: (color_of(color), depth_of(depth)))
            read = *pixels, lens_of(lens), await self._pose(color)
        except LinkError:
            raise
        except Exception as error:  # a field is missing, or holds something else
            raise LinkError(f"its picture cannot be read: {in_words(error)}") from None
        frame = Frame(next(self._numbers), *read)
        size = (frame.intrinsics.height, frame.intrinsics.width)
        if frame.depth.shape != size or frame.color.shape[:2] != size:
            sizes = [f"{one.shape[1]} x {one.shape[0]}" for one in (frame.color, frame.depth)]
            raise LinkError(
                f"colour has {sizes[0]} pixels, depth {sizes[1]} and the lens {size[1]} x {size[0]}"
                ": the profile should name depth that is aligned with colour"
            )
        return frame

    async def _pair(self) -> tuple[Message, Message, Message]:
        """Colour and depth of one moment that is not before this one, and the lens."""
        topics = self._profile.camera
        collector = _Collector(self._senses.now)
        colors, depths = topics.image_type("color"), topics.image_type("depth")
        endings = [
            self._link.subscribe(topics.info, "sensor_msgs/msg/CameraInfo", collector.take_lens),
            self._link.subscribe(topics.color, colors, collector.take_color),
            self._link.subscribe(topics.depth, depths, collector.take_depth),
        ]
        try:
            async with asyncio.timeout(topics.late_s):
                return await collector.pair
        except TimeoutError:
            missing = collector.missing(topics.color, topics.depth, topics.info)
            raise LateError(f"no picture came in {topics.late_s:g} s: {missing}") from None
        finally:
            for end in endings:
                end()

    def _refuse_other_views(self, *messages: Message) -> None:
        """See that all are of one optical frame, if it is they who say which one that is.

        Raises:
            LinkError: if they are not.
        """
        said = {str(one["header"].get("frame_id", "")).lstrip("/") for one in messages} - {""}
        if len(said) > 1 and not self._profile.frames.camera:
            raise LinkError(
                f"colour, depth and lens are of {', '.join(sorted(said))}: the profile should name"
                " those of one camera, depth aligned with colour; or frames.camera, if they are"
            )

    async def _pose(self, color: Message) -> Pose:
        """Where the camera was in the map, when the picture was taken."""
        if not self._profile.camera.in_map:
            return Pose()
        said = str(color["header"]["frame_id"]).lstrip("/")
        camera, within = self._profile.frames.camera or said, self._profile.frames.map
        stamp = stamp_of(color)
        late_s = self._profile.camera.late_s
        latest = asyncio.get_running_loop().time() + late_s
        while asyncio.get_running_loop().time() < latest:
            pose = self._senses.frames.pose(camera, within, stamp)
            if pose is not None and self._senses.frames.newest >= stamp:
                return pose
            await asyncio.sleep(0.01)
        pose = self._senses.frames.pose(camera, within, stamp)
        if pose is None and self._senses.frames.pose(camera, within) is not None:
            raise LateError(f"it was not told in {late_s:g} s where {camera} was in {within} then")
        if pose is None:
            raise LinkError(f"nobody tells where {camera} is in {within}: is the robot localised?")
        return pose


class WireCamera:
    """Implements `Camera`; `capture` takes tens of milliseconds, and never longer than it may."""

    def __init__(self, wire: WireThread, shutter: Shutter, losses: Losses) -> None:
        """Take no picture yet."""
        self._wire = wire
        self._shutter = shutter
        self._losses = losses

    def capture(self) -> Frame:
        """A picture of now; not called on the thread that ticks.

        Raises:
            NoLinkError: if the link was lost, and does not come back.
            LinkError: if none comes, or not such as can be used.
            GivenUpError: if it is part of a computation that was given up.
        """
        taking = self._wire.start(self._losses.outlived(self._shutter.take))
        try:
            while True:
                try:
                    return taking.result(0.05)
                except TimeoutError:
                    if taking.done():
                        raise
                    still_wanted()
        except CancelledError:
            raise LinkError("the link to the robot was closed") from None
        finally:
            taking.cancel()

    async def points(self) -> Floats:
        """What it sees now, as points (n, 3) in `map`; called on the thread of the wire."""
        frame = await self._shutter.take()
        rows, columns = np.mgrid[: frame.intrinsics.height, : frame.intrinsics.width]
        points: Floats = back_project(frame, rows.ravel(), columns.ravel()).astype(np.float64)
        return points


class _Collector:
    """Waits for a pair of pictures."""

    def __init__(self, since: float) -> None:
        self.pair: asyncio.Future[tuple[Message, Message, Message]]
        self.pair = asyncio.get_running_loop().create_future()
        self._since = since
        self._colors: list[Message] = []
        self._depths: list[Message] = []
        self._lens: Message | None = None
        self._old = False

    def take_color(self, message: Message) -> None:
        self._keep(self._colors, message)

    def take_depth(self, message: Message) -> None:
        self._keep(self._depths, message)

    def take_lens(self, message: Message) -> None:
        self._lens = message
        self._look()

    def _keep(self, kept: list[Message], message: Message) -> None:
        if stamp_of(message) < self._since - 1e-6:
            self._old = True
            return
        kept.append(message)
        del kept[:-KEPT]
        self._look()

    def _look(self) -> None:
        if self._lens is None or self.pair.done():
            return
        for color in self._colors:
            apart = [abs(stamp_of(depth) - stamp_of(color)) for depth in self._depths]
            if apart and min(apart) <= TOGETHER_S:
                depth = self._depths[int(np.argmin(apart))]
                self.pair.set_result((color, depth, self._lens))
                return

    def missing(self, color: str, depth: str, info: str) -> str:
        """What did not come, as a clause."""
        names = ((self._colors, color), (self._depths, depth), (self._lens, info))
        silent = [name for come, name in names if not come]
        if silent and self._old:
            return "there were only older ones than the robot's own clock has"
        if silent:
            return f"nothing on {' and '.join(silent)}"
        return "colour and depth are of different moments"
