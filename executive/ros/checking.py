"""A profile held against the robot before anything moves: what is wrong, what would be right."""

import asyncio
from collections.abc import Sequence

from executive.errors import InputError
from executive.ros.goal_fields import misfits
from executive.ros.link import Link, LinkError
from executive.ros.messages import FRAMES_TYPE
from executive.ros.moveit import SEMANTICS, SEMANTICS_TYPE, planning_groups
from executive.ros.offers import Offers, likely, same_type
from executive.ros.profile import COMPRESSED, IMAGE, PATH_TYPE, Profile
from executive.ros.protocol import Message
from executive.ros.rosapi import RIGHT
from executive.ros.senses import Senses

LOOKS = 3
"""What is missing is looked for so often: ROS discovers a graph bit by bit."""
HEARING_S = 3.0
"""So long a robot may take to say where it is, and whether it rests."""


def refuse_unknown_rooms(profile: Profile, rooms: Sequence[str], where: str) -> None:
    """See that the home has the rooms that the robot may enter: with a slip, it enters none.

    Raises:
        InputError: if it lacks one.
    """
    for room in profile.limits.rooms or ():
        if room not in rooms:
            what = f"limits.rooms: the home has no room {room[:80]}"
            raise InputError(where, what, f"it has {', '.join(rooms)}")


async def faults(link: Link, profile: Profile, senses: Senses, where: str) -> list[InputError]:
    """All that is wrong with a profile for the robot that is linked."""
    found: list[InputError] = []
    for _ in range(LOOKS):
        try:
            offers = await link.offers()
        except LinkError as error:
            return [InputError(where, str(error), RIGHT)]
        found = [*_topics(offers, profile, where), *_actions(offers, profile, where)]
        if not found:
            unheard = await _heard(profile, senses, where)
            unfit = await misfits(link, offers, profile, where)
            return [*unheard, *unfit, *await _unknown_group(link, offers, profile, where)]
    return found


def _topics(offers: Offers, profile: Profile, where: str) -> list[InputError]:
    camera = profile.camera
    wanted = [
        ("camera.color", camera.color, camera.image_type("color")),
        ("camera.depth", camera.depth, camera.image_type("depth")),
        ("camera.info", camera.info, "sensor_msgs/msg/CameraInfo"),
        ("odometry.topic", profile.odometry.topic, "nav_msgs/msg/Odometry"),
    ]
    if camera.in_map:
        wanted.append(("frames.tf", profile.frames.tf, FRAMES_TYPE))
    if profile.joints:
        wanted.append(("joints.topic", profile.joints.topic, "sensor_msgs/msg/JointState"))
    if profile.hand:
        wanted.append(("hand.topic", profile.hand.topic, profile.hand.type))
    if profile.clock:
        wanted.append(("clock.topic", profile.clock.topic, "rosgraph_msgs/msg/Clock"))
    found = []
    for key, name, kind in wanted:
        said = offers.topics.get(name)
        if said is None:
            right = likely(name, offers.topics_of(kind), ())
            found.append(InputError(where, f"{key}: the robot has no topic {name}", right))
        elif not same_type(said, kind):
            right = _other_image(key, said) or likely(name, offers.topics_of(kind), ())
            what = f"{key}: {name} is of type {said}, and not {kind}"
            found.append(InputError(where, what, right))
    return found


def _other_image(key: str, said: str) -> str:
    """What would be right for a picture that comes in the other way; nothing for all else."""
    of = key.rpartition(".")[2]
    if of in ("color", "depth") and same_type(said, COMPRESSED):
        return f'write compressed = ["{of}"] in [camera], beside what else comes so'
    if of in ("color", "depth") and same_type(said, IMAGE):
        return f"leave {of} out of camera.compressed"
    return ""


def _actions(offers: Offers, profile: Profile, where: str) -> list[InputError]:
    wanted = [(s, action.action, action.type) for s, action in profile.actions().items()]
    if profile.drive.path:
        wanted.append(("drive.path", profile.drive.path, PATH_TYPE))
    found = []
    for section, name, kind in wanted:
        if name not in offers.actions:
            right = likely(name, offers.actions_of(kind), offers.actions_of(""))
            what = f"{section}: the robot has no action {name}"
            found.append(InputError(where, what, right))
        elif offers.actions[name] and not same_type(offers.actions[name], kind):
            what = f"{section}: {name} is of type {offers.actions[name]}, and not {kind}"
            found.append(InputError(where, what, likely(name, offers.actions_of(kind), ())))
    return found


async def _unknown_group(
    link: Link, offers: Offers, profile: Profile, where: str
) -> list[InputError]:
    """Whether MoveIt lacks the planning group of the arm, as far as it tells which there are."""
    told = same_type(offers.topics.get(SEMANTICS, ""), SEMANTICS_TYPE)
    if profile.arm is None or not told:
        return []
    heard: asyncio.Future[tuple[str, ...]] = asyncio.get_running_loop().create_future()

    def take(message: Message) -> None:
        groups = planning_groups(message["data"])
        if not heard.done():
            heard.set_result(groups)

    end = link.subscribe(SEMANTICS, SEMANTICS_TYPE, take)
    try:
        async with asyncio.timeout(HEARING_S):
            groups = await heard
    except TimeoutError:
        return []
    finally:
        end()
    if profile.arm.group in groups:
        return []
    what = f"arm.group: MoveIt has no planning group {profile.arm.group[:80]}"
    there = ", ".join(groups[:20]) or "none"
    return [InputError(where, what, f"{SEMANTICS} tells of {there}")]


async def _heard(profile: Profile, senses: Senses, where: str) -> list[InputError]:
    """Whether the robot says where it is and how it moves, within a few seconds."""
    latest = asyncio.get_running_loop().time() + HEARING_S
    while asyncio.get_running_loop().time() < latest:
        if not (found := _unheard(profile, senses, where)):
            break
        await asyncio.sleep(0.05)
    return found


def _unknown_joints(profile: Profile, senses: Senses, where: str) -> list[InputError]:
    """Joints of arm and head that are not among those that the robot tells of."""
    if profile.joints is None or not senses.joints:
        return []
    arm, look = profile.arm, profile.look
    named = [("arm.carry", name) for name in (arm.carry if arm else ())]
    named += [("look.joints", name) for name in ((look.joints if look else None) or ())]
    told = ", ".join(sorted(senses.joints)[:20])
    right = f"{profile.joints.topic} tells of {told}"
    return [
        InputError(where, f"{key}: the robot has no joint {name[:80]}", right)
        for key, name in named
        if name not in senses.joints
    ]


def _unheard(profile: Profile, senses: Senses, where: str) -> list[InputError]:
    found = _unknown_joints(profile, senses, where)
    if senses.unrest.startswith("nobody"):
        right = "name a topic on which something is published"
        found.append(InputError(where, f"odometry, joints: {senses.unrest}", right))
    if (hand := profile.hand) and hand.joint and senses.holding is None:
        what = f"hand: nobody tells on {hand.topic} where {hand.joint[:80]} is"
        found.append(InputError(where, what, "name a topic, and a joint that it tells of"))
    if profile.clock and senses.clock is None:
        what = f"clock: nobody tells the time on {profile.clock.topic}"
        right = "see that the simulation runs; without [clock] real time counts"
        found.append(InputError(where, what, right))
    frames = profile.frames
    needed = [frames.base, frames.camera] if profile.camera.in_map else []
    needed += [profile.arm.tip] if profile.arm else []
    needed += [profile.look.mount] if profile.look else []
    for frame in filter(None, needed):
        if senses.frames.pose(frame, frames.map) is None:
            known = ", ".join(senses.frames.names[:12]) or "no frames at all"
            what = f"frames: nobody tells where {frame} is in {frames.map}"
            right = f"localise the robot, or name other frames; it tells of {known}"
            found.append(InputError(where, what, right))
    return found
