"""Exports the camera's pictures: as single files, or as a video in mission time."""

import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from executive.errors import InputError
from logs.recording.reader import At

VIDEO_HZ = 10
"""Frame rate of a video (Hz); each picture is shown until the next one was taken."""


MOST_PIXELS = 64_000_000
"""Limit for one picture: a JPEG of a few hundred bytes can claim to have a billion pixels."""
LONGEST_VIDEO_S = 6 * 3600.0

Frames = Iterable[At[bytes]]


def write_files(frames: Frames, folder: Path, *, png: bool = False) -> list[Path]:
    """Write each picture to `folder` as `<number>-<mission time>s.jpg`, or as PNG; all or none.

    Raises:
        InputError: if the folder or a file cannot be written, or a picture cannot be decoded.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(dir=folder, prefix=".pictures") as unfinished:
            names = []
            for number, at in enumerate(frames, start=1):
                data = cv2.imencode(".png", _image(at.value))[1].tobytes() if png else at.value
                names.append(f"{number:05}-{at.time_s:.3f}s{'.png' if png else '.jpg'}")
                (Path(unfinished) / names[-1]).write_bytes(data)
            return [(Path(unfinished) / name).replace(folder / name) for name in names]
    except OSError as error:
        raise InputError(str(folder), f"cannot be written: {error.strerror}") from error


def write_video(frames: Frames, file: Path) -> int:
    """Write an MP4 (MPEG-4) that plays in mission time; return the number of frames in the video.

    Each picture is shown until the next one was taken. All are scaled to the largest width and
    height.

    Args:
        frames: the pictures; iterated twice.
        file: created when the video is complete; an existing file is replaced.

    Raises:
        InputError: if there are no pictures, one cannot be decoded, they span too long a time, or
            the file cannot be written.
    """
    sizes = [(at.time_s, *_size(at.value)) for at in frames]
    if not sizes:
        raise InputError(str(file), "the recording holds no pictures to make a video of")
    start_s = min(time_s for time_s, _, _ in sizes)
    long_s = max(time_s for time_s, _, _ in sizes) - start_s
    if long_s > LONGEST_VIDEO_S:
        what = f"a video of {long_s:.0f} s is longer than the {LONGEST_VIDEO_S:.0f} that are made"
        raise InputError(str(file), what, "name a folder, for single pictures")
    size = max(width for _, width, _ in sizes), max(height for _, _, height in sizes)
    with _video(file, size) as video:
        return _show(frames, video, size, start_s)


def _show(frames: Frames, video: cv2.VideoWriter, size: tuple[int, int], start_s: float) -> int:
    """Show each picture until the next one was taken; the last one is shown once."""
    shown = 0
    image: NDArray[np.uint8] | None = None
    for at in frames:
        while image is not None and shown < (at.time_s - start_s) * VIDEO_HZ:
            video.write(image)
            shown += 1
        image = np.asarray(cv2.resize(_image(at.value), size), np.uint8)
    if image is not None:
        video.write(image)
    return shown + 1


@contextmanager
def _video(file: Path, size: tuple[int, int]) -> Iterator[cv2.VideoWriter]:
    right = "name a .mp4 file in an existing folder"
    try:
        with TemporaryDirectory(dir=file.parent, prefix=".video") as unfinished:
            new = Path(unfinished) / file.name
            video = cv2.VideoWriter(str(new), cv2.VideoWriter.fourcc(*"mp4v"), VIDEO_HZ, size)
            if not video.isOpened():
                raise InputError(str(file), "cannot be written", right)
            yield video
            video.release()
            new.replace(file)
    except OSError as error:
        raise InputError(str(file), f"cannot be written: {error.strerror}", right) from error


def _image(jpeg: bytes) -> NDArray[np.uint8]:
    _size(jpeg)
    image = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR)
    if image is None:
        raise InputError("/camera/image/compressed", "a picture cannot be decoded")
    return image.astype(np.uint8, copy=False)


def _size(jpeg: bytes) -> tuple[int, int]:
    """Width and height of a picture (pixels), read from its header.

    Raises:
        InputError: if it is not a JPEG, or too large.
    """
    try:
        with warnings.catch_warnings(action="ignore", category=Image.DecompressionBombWarning):
            width, height = Image.open(BytesIO(jpeg), formats=["JPEG"]).size
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        raise InputError("/camera/image/compressed", "a picture cannot be decoded") from error
    if width * height > MOST_PIXELS:
        what = f"a picture of {width} x {height} pixels is larger than what is decoded"
        raise InputError("/camera/image/compressed", what)
    return width, height
