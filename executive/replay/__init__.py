"""Replays recorded missions."""

from executive.replay.replaying import Replay, replay, replay_text, replays_text

__all__ = ["Replay", "replay", "replay_text", "replays_text"]
