"""How it stands between the robot and the person."""

from dataclasses import dataclass


@dataclass
class Dialogue:
    """Whether the person is there to be asked, and how often they were."""

    away: bool = False
    """Whether the robot has left the person."""
    inquiries: int = 0
    no_help: str = ""
    """Why the person cannot or will not help, as a clause; empty if they may."""
