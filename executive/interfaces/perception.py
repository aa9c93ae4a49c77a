"""Camera and detector."""

from typing import Protocol

from executive.types.perception import Detection, Frame


class Camera(Protocol):
    """A colour and depth camera."""

    def capture(self) -> Frame:
        """Take a picture now; blocks for some milliseconds."""
        ...


class Detector(Protocol):
    """Recognises objects in a picture."""

    def detect(self, frame: Frame) -> tuple[Detection, ...]:
        """All known objects in the picture, the highest confidence first."""
        ...


class Perception(Protocol):
    """A camera and a detector together: takes a picture, and recognises and locates objects."""

    def see(self) -> int:
        """Start to take a picture and recognise objects in it; ends Saw, or Failed."""
        ...

    def cancel(self, request: int) -> None:
        """Cancel the request; its result is not delivered."""
        ...
