"""What a robot over the wire offers, and whether a profile fits it: `python -m executive.ros`."""

from executive.start import begin

if __name__ == "__main__":
    begin()

import argparse
import asyncio
import sys
from collections.abc import Sequence

from executive.errors import InputError
from executive.ros.address import read_address
from executive.ros.connection import check, dial
from executive.ros.frames import FrameTree
from executive.ros.link import Link, LinkError
from executive.ros.messages import FRAMES_TYPE
from executive.ros.offers import Offers
from executive.ros.profile import load_profile, packaged_profiles, profile_text
from executive.ros.proposing import frame_topics, listing, printable_lines, proposal
from executive.ros.rosapi import RIGHT
from executive.shell import BAD_INPUT, DONE, entry_point
from executive.usage import Parser

LISTENING_S = 1.5
"""So long the frames are listened to."""


@entry_point
def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command."""
    given = _parser().parse_args(arguments)
    match given.command:
        case "look":
            return _look(given.address)
        case "check":
            return _check(given.address, given.profile)
        case _:
            return _profiles()


def _look(address: str) -> int:
    """List what the robot offers, and propose a profile for it."""
    line = dial(read_address(address))
    try:
        offers, frames = line.wire.run(_seen(line.link))
    except LinkError as error:
        raise InputError(f"--robot {address}", str(error), RIGHT) from None
    finally:
        line.close()
    print(printable_lines(f"# {one}" for one in listing(offers).splitlines()))
    print(f"\n{proposal(offers, frames)}")
    return DONE


async def _seen(link: Link) -> tuple[Offers, tuple[str, ...]]:
    offers, frames = await link.offers(), FrameTree()
    moving, fixed = frame_topics(offers)
    link.subscribe(moving, FRAMES_TYPE, frames.take)
    link.subscribe(fixed, FRAMES_TYPE, lambda message: frames.take(message, fixed=True))
    await asyncio.sleep(LISTENING_S)
    return offers, frames.names


def _check(address: str, name: str) -> int:
    """Hold a profile against the robot; a line for each fault."""
    _, where = profile_text(name)
    found = check(read_address(address), load_profile(name), where)
    for fault in found:
        print(fault, file=sys.stderr)
    if not found:
        print(f"{where} fits the robot")
    return BAD_INPUT if found else DONE


def _profiles() -> int:
    """The profiles that come along."""
    for name in packaged_profiles():
        profile = load_profile(name)
        print(f"{name}  {profile.about} (tried: {profile.tried})")
    return DONE


def _parser() -> argparse.ArgumentParser:
    parser = Parser(prog="python -m executive.ros", description="Look at a robot over the wire.")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    look = commands.add_parser("look", help="list what a robot offers, and propose a profile")
    look.add_argument("address", metavar="ws://HOST:PORT")
    held = commands.add_parser("check", help="hold a profile against a robot; nothing moves")
    held.add_argument("address", metavar="ws://HOST:PORT")
    held.add_argument("--profile", required=True, metavar="NAME or FILE.toml")
    commands.add_parser("profiles", help="list the profiles that come along")
    return parser


if __name__ == "__main__":
    sys.exit(main())
