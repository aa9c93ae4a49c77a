"""Spoken dialogue: ears recognise speech, and a voice produces it (docs/speech.md)."""
