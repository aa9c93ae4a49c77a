"""The robot's eyes."""

from typing import Protocol

from executive.types.perception import Detection, Frame


class Camera(Protocol):
    """A colour and depth camera."""

    def capture(self) -> Frame:
        """The picture of this moment; takes some milliseconds."""
        ...


class Detector(Protocol):
    """Recognises things in a picture."""

    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        """All known things in the picture, surest first."""
        ...


class Perception(Protocol):
    """A camera and a detector together: takes a picture and says what is in it, and where."""

    def see(self) -> int:
        """Take a picture and recognise; ends Saw, or Failed."""
        ...

    def cancel(self, request: int) -> None:
        """Forget the picture."""
        ...
