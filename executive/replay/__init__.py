"""Recorded missions run again."""

from executive.replay.replaying import Replay, replay

__all__ = ["Replay", "replay"]
