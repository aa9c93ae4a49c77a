"""The camera's pictures as files: singly, or as a video in mission time."""

from collections.abc import Iterable
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from executive.errors import InputError
from logs.reader import At

VIDEO_HZ = 10
"""Pictures a second in a video; between two of the camera's the first one stays."""


def write_files(frames: Iterable[At[bytes]], folder: Path, *, png: bool = False) -> list[Path]:
    """Write each picture to `folder` as `<number>-<mission time>s.jpg`, or as PNG.

    Raises:
        InputError: if the folder or a file cannot be written.
    """
    written = []
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for number, at in enumerate(frames, start=1):
            data = cv2.imencode(".png", _image(at.value))[1].tobytes() if png else at.value
            name = f"{number:05}-{at.time_s:.3f}s{'.png' if png else '.jpg'}"
            written.append(folder / name)
            written[-1].write_bytes(data)
    except OSError as error:
        raise InputError(str(folder), f"cannot be written: {error.strerror}") from error
    return written


def write_video(frames: Iterable[At[bytes]], file: Path) -> int:
    """Write an MP4 (MPEG-4) in which a second is a second of the mission; return its pictures.

    Raises:
        InputError: if there are no pictures, or the file cannot be written.
    """
    video: cv2.VideoWriter | None = None
    began, shown = 0.0, 0
    last: NDArray[np.uint8] | None = None
    for at in frames:
        image = _image(at.value)
        if video is None:
            began, video = at.time_s, _open(file, image)
        while last is not None and shown < (at.time_s - began) * VIDEO_HZ:
            video.write(last)
            shown += 1
        last = image
    if video is None or last is None:
        raise InputError(str(file), "the recording holds no pictures to make a video of")
    video.write(last)
    video.release()
    return shown + 1


def _open(file: Path, image: NDArray[np.uint8]) -> cv2.VideoWriter:
    height, width = image.shape[:2]
    fourcc = cv2.VideoWriter.fourcc(*"mp4v")
    video = cv2.VideoWriter(str(file), fourcc, VIDEO_HZ, (width, height))
    if not video.isOpened():
        raise InputError(str(file), "cannot be written", "name a .mp4 file in an existing folder")
    return video


def _image(jpeg: bytes) -> NDArray[np.uint8]:
    image = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR)
    if image is None:
        raise InputError("/camera/image/compressed", "a picture cannot be decoded")
    return image.astype(np.uint8, copy=False)
