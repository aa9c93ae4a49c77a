"""Recorded missions run again."""

from executive.replay.replay import Replay, replay

__all__ = ["Replay", "replay"]
