from executive.events import Inbox
from executive.perception.pipeline import locate as locate_pixels
from executive.testing.bench import Notebook, four_rooms
from executive.testing.contracts.robot import Bench
from executive.types.goals import LookAt
from executive.types.perception import Detection
from executive.types.results import Succeeded
from sim.home.home import Home
from sim.objects.objects import load_objects
from sim.world import PhysicsWorld

MODELS = load_objects()


def home_before(place: str) -> Home:
    """The home with the robot already standing before a place."""
    return four_rooms().model_copy(update={"robot_start": four_rooms().stand(place)})


class Kitchen(Bench):
    """The robot before a piece of furniture: the counter wagon, where the sugar_box is."""

    def __init__(
        self, home: Home | None = None, place: str = "counter_wagon", seed: int = 1
    ) -> None:
        inbox = Inbox()
        self.world = PhysicsWorld(
            home or home_before(place), MODELS, inbox, Notebook(), seed=seed, camera_hz=0.0
        )
        super().__init__(self.world.robot, inbox, self.world.advance, place)

    def detection_of(self, name: str, view: int = 0) -> Detection:
        assert self.do(LookAt(self.place, view)) == Succeeded()
        frame = self.world.camera.capture()
        (found,) = (d for d in self.world.detector.detect(frame) if d.label == name)
        return locate_pixels(found, frame)
