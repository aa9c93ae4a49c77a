"""The embodiment for a robot over rosbridge: `--robot ws://HOST:PORT --profile NAME`."""

from collections.abc import Callable
from functools import partial

from executive.app.embodiment import Embodiment, Setup
from executive.app.handling import KnownThings
from executive.app.simulation import blind_to
from executive.errors import InputError
from executive.perception.pipeline import CameraPerception
from executive.perception.tags import TagDetector
from executive.records import Transform, Transforms
from executive.ros.address import read_address
from executive.ros.checking import refuse_unknown_rooms
from executive.ros.connection import connect
from executive.ros.profile import Profile, load_profile, packaged_profiles, profile_text
from executive.types.geometry import Pose
from sim.body.base import FREE
from sim.fake import straight_s
from sim.home.home import Home
from sim.navigation.durations import durations_in
from sim.navigation.grid import OccupancyGrid


def wire(setup: Setup) -> Embodiment:
    """Connect to a robot; nothing moves yet.

    Raises:
        InputError: if there is no answer, or the profile is wrong or does not fit.
    """
    settings = setup.settings
    if settings.profile is None:
        known = ", ".join(packaged_profiles())
        what = "nobody says what the robot has and how it calls it"
        right = f"give --profile {known} or a FILE.toml; python -m executive.ros look "
        raise InputError("setting 'profile'", what, f"{right}{settings.robot} proposes one")
    profile = load_profile(settings.profile)
    _, where = profile_text(settings.profile)
    refuse_unknown_rooms(profile, [room.name for room in setup.home.rooms], where)
    detector = TagDetector() if profile.camera.tags else setup.detector()

    def record(pose: Pose) -> None:
        setup.recorder.record(Transforms((Transform("map", "base_link", pose),)))

    address = read_address(settings.robot or "")
    ways = ways_of(setup.home, profile)
    hands = KnownThings(setup.home)
    there = connect(address, profile, setup.home, setup.inbox, where, ways, record, hands)
    return Embodiment(
        there.robot,
        CameraPerception(there.camera, detector, setup.inbox, setup.recorder, far=True),
        there.clock,
        in_map=profile.camera.in_map,
        blind_to=blind_to(setup.home, detector),
        has_arm=profile.has_arm,
        begin=there.tell,
        close=there.close,
    )


def ways_of(home: Home, profile: Profile) -> Callable[[str, str], float]:
    """A function for the duration (s) of a drive between two places, by the home's map.

    A robot that is slower than the simulated one takes longer; a faster one counts as equal. With a
    camera that reads tags, drives are straight, as in the instant world.
    """
    if profile.camera.tags:
        return partial(straight_s, home)
    durations = durations_in(home, OccupancyGrid.from_home(home))
    slower = max(1.0, FREE.speed / (profile.limits.speed_m_s or FREE.speed))
    return lambda start, place: slower * durations.seconds(start, place)
