"""Talking with the robot aloud: ears that hear words, a voice that says them (docs/speech.md)."""
