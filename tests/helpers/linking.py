"""A test's robot, over the wire, as a session has its robot."""

from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from second_robot import PROFILE, SPEED_M_S

from executive.events import Inbox
from executive.ros.address import read_address
from executive.ros.arm import Hands
from executive.ros.connection import Connection, connect
from executive.ros.profile import load_profile
from executive.testing.bench import four_rooms
from sim.fake import straight_s


@contextmanager
def link_to(
    url: str, inbox: Inbox, profile: Path = PROFILE, hands: Hands | None = None
) -> Iterator[Connection]:
    """The robot at this address; it takes the straight way from one place to another one."""

    def ways(start: str, place: str) -> float:
        return straight_s(four_rooms(), start, place, SPEED_M_S)

    address, read = read_address(url), load_profile(str(profile))
    here = connect(address, read, four_rooms(), inbox, profile.name, ways, hands=hands)
    with closing(here):
        yield here
