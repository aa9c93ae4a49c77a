"""A voice that is a program: espeak-ng, or one that stands in for it."""

from pathlib import Path

import pytest
from patience import until

from executive.errors import InputError
from executive.speech.espeak import MOST_WAITING, EspeakVoice


def program(folder: Path, does: str) -> str:
    path = folder / "speaks"
    path.write_text(f"#!/bin/sh\n{does}\n")
    path.chmod(0o755)
    return str(path)


def test_sentences_are_said_in_their_order_whatever_is_in_them(tmp_path: Path) -> None:
    said = tmp_path / "said"
    voice = EspeakVoice(program(tmp_path, f"cat >> '{said}'; echo >> '{said}'"))
    for text in ("Hello.", "-w $(rm -rf /)\nnext", "", "Good bye."):
        voice.say(text)
    until(lambda: not voice.saying)
    assert said.read_text().splitlines() == ["Hello.", "-w $(rm -rf /) next", "Good bye."]
    voice.close()


def test_hushed_it_is_silent_at_once(tmp_path: Path) -> None:
    voice = EspeakVoice(program(tmp_path, "exec sleep 1000"))
    voice.say("A long story")
    voice.say("and another one")
    until(lambda: voice._speaking is not None)
    assert voice.saying == "A long story and another one"
    voice.hush()
    until(lambda: not voice.saying)
    voice.close()


def test_who_talks_too_much_is_cut_short(tmp_path: Path) -> None:
    voice = EspeakVoice(program(tmp_path, "exec sleep 1000"))
    for _ in range(1000):
        voice.say("and so on")
    assert voice.saying.count("and so on") == MOST_WAITING
    voice.close()


def test_a_program_that_is_not_there_is_told_with_what_would_be_right() -> None:
    with pytest.raises(
        InputError, match="--voice espeak-ng: there is no such program; apt install"
    ):
        EspeakVoice("no-such-program")


def test_it_says_halt_for_stop_so_as_not_to_stop_itself(tmp_path: Path) -> None:
    voice = EspeakVoice(program(tmp_path, "exec sleep 1000"))
    voice.say("Stopping. I stopped; there is nothing to stop at the stopwatch.")
    assert voice.saying == "halting. I halted; there is nothing to halt at the stopwatch."
    voice.close()
