"""The camera's pictures as files: singly, or as a video in mission time."""

from collections.abc import Iterable
from itertools import pairwise
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

    All pictures are shown at the size of the largest.

    Raises:
        InputError: if there are no pictures, or the file cannot be written.
    """
    taken = list(frames)
    if not taken:
        raise InputError(str(file), "the recording holds no pictures to make a video of")
    height, width = max(_image(at.value).shape[:2] for at in taken)
    video, shown = _open(file, (width, height)), 0
    for at, following in pairwise(taken):
        image = cv2.resize(_image(at.value), (width, height))
        while shown < (following.time_s - taken[0].time_s) * VIDEO_HZ:
            video.write(image)
            shown += 1
    video.write(cv2.resize(_image(taken[-1].value), (width, height)))
    video.release()
    return shown + 1


def _open(file: Path, size: tuple[int, int]) -> cv2.VideoWriter:
    video = cv2.VideoWriter(str(file), cv2.VideoWriter.fourcc(*"mp4v"), VIDEO_HZ, size)
    if not video.isOpened():
        raise InputError(str(file), "cannot be written", "name a .mp4 file in an existing folder")
    return video


def _image(jpeg: bytes) -> NDArray[np.uint8]:
    image = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_COLOR)
    if image is None:
        raise InputError("/camera/image/compressed", "a picture cannot be decoded")
    return image.astype(np.uint8, copy=False)
