"""A robot over the wire as the body of missions: `--robot ws://HOST:PORT --profile NAME`."""

from executive.app.embodiment import Embodiment, Setup
from executive.app.simulation import blind_to
from executive.errors import InputError
from executive.perception.pipeline import CameraPerception
from executive.perception.tags import TagDetector
from executive.records import Transform, Transforms
from executive.ros.address import read_address
from executive.ros.connection import Connection, connect
from executive.ros.profile import load_profile, packaged_profiles, profile_text


def wire(setup: Setup) -> Embodiment:
    """A robot behind rosbridge; nothing of it moves yet.

    Raises:
        InputError: if nobody answers there, or the profile is wrong or does not fit.
    """
    settings = setup.settings
    if settings.profile is None:
        known = ", ".join(packaged_profiles())
        what = "nobody says what the robot has and how it calls it"
        right = f"give --profile {known} or a FILE.toml; python -m executive.ros look "
        raise InputError("setting 'profile'", what, f"{right}{settings.robot} proposes one")
    profile = load_profile(settings.profile)
    _, where = profile_text(settings.profile)
    detector = TagDetector() if profile.camera.tags else setup.detector()
    there = connect(read_address(settings.robot or ""), profile, setup.home, setup.inbox, where)
    return Embodiment(
        there.robot,
        CameraPerception(there.camera, detector, setup.inbox, setup.recorder, far=True),
        there.clock,
        in_map=profile.camera.in_map,
        blind_to=blind_to(setup.home, detector),
        has_arm=profile.has_arm,
        begin=lambda: _record_base(setup, there),
        close=there.close,
    )


def _record_base(setup: Setup, there: Connection) -> None:
    """Where the robot is when a mission begins."""
    if (pose := there.senses.base) is not None:
        setup.recorder.record(Transforms((Transform("map", "base_link", pose),)))
