"""A session that listens, and one that speaks: words that are heard go the way of typed ones."""

import io
from pathlib import Path

import pytest
from audio_server import hearing, says
from speaking import needs_espeak, say

from executive import Session, load_settings
from executive.errors import InputError
from executive.events import Inbox, Listened
from executive.replay import replay
from executive.speech.sound import to_wav
from executive.user import Console
from logs.recording.reader import Run

FAKE = {"world": "fake", "llm": "none"}


@needs_espeak
def test_what_files_say_and_confirm_is_the_next_command_and_is_recorded(tmp_path: Path) -> None:
    pytest.importorskip("pocketsphinx", reason="needs the extra speech")
    said = tmp_path / "said"
    said.mkdir()
    for number, words in enumerate(("what is on the bed", "yes")):
        (said / f"{number}.wav").write_bytes(to_wav(say(words)))
    settings = load_settings(ears="pocketsphinx", microphone=str(said), runs=tmp_path, **FAKE)
    console = Console(inbox := Inbox(), io.StringIO(), io.StringIO())
    with Session(settings, inbox=inbox, user=console) as session:
        words = session.next_command(console)
        assert words == "what is on the bed"
        session.run(words)
        assert session.next_command(console) is None  # the sound has ended, and the input
        mission = session.folder
    assert mission
    events = (at.value for at in Run(mission).events())
    heard = [event for event in events if isinstance(event, Listened)]
    assert [(one.text, one.became) for one in heard] == [
        (words, "asked back"),
        ("yes", "an answer"),
    ]
    assert all(one.by == "pocketsphinx" and one.confidence > 0.6 for one in heard)
    assert replay(mission / "mission.mcap").parting is None


@needs_espeak
def test_what_a_server_heard_is_done_when_the_local_ears_hear_the_yes_too(tmp_path: Path) -> None:
    pytest.importorskip("pocketsphinx", reason="needs the extra speech")
    said = tmp_path / "said"
    said.mkdir()
    for number, words in enumerate(("tell me what is on the bed", "yes")):
        (said / f"{number}.wav").write_bytes(to_wav(say(words)))
    with hearing(says({"text": "What's on the bed?"}), says({"text": "Yes."})) as server:
        given = {"ears": server.url, "microphone": str(said), "runs": tmp_path, **FAKE}
        console = Console(inbox := Inbox(), io.StringIO(), out := io.StringIO())
        with Session(load_settings(**given), inbox=inbox, user=console) as session:
            assert session.next_command(console) == "What's on the bed?"
            assert session.next_command(console) is None
    assert out.getvalue().splitlines() == ["Did you say: What's on the bed?"]


@needs_espeak
def test_a_pipe_of_sound_is_heard_whole_and_is_not_typed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("pocketsphinx", reason="needs the extra speech")
    sound = io.BytesIO(say("what is on the bed").astype("<i2").tobytes())
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(sound))
    settings = load_settings(ears="pocketsphinx", microphone="-", runs=tmp_path, **FAKE)
    with Session(settings, out=(out := io.StringIO())) as session:
        person = session.parts.user
        assert isinstance(person, Console)
        assert session.next_command(person) is None
    assert out.getvalue().splitlines() == ["Did you say: what is on the bed?"]


def test_what_the_robot_says_is_said_aloud(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    said = tmp_path / "said"
    program = tmp_path / "espeak-ng"
    program.write_text(f"#!/bin/sh\ncat >> '{said}'; echo >> '{said}'\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
    settings = load_settings(voice="espeak-ng", runs=tmp_path, **FAKE)
    console = Console(inbox := Inbox(), io.StringIO(), io.StringIO())
    with Session(settings, inbox=inbox, user=console) as session:
        session.run("Find the mug")
        voice = console.aloud.__self__  # type: ignore[attr-defined]
        while voice.saying:
            pass
    assert "mug" in said.read_text()


@pytest.mark.parametrize("given", [{"ears": "pocketsphinx"}, {"voice": "espeak-ng"}])
def test_where_nobody_is_to_be_heard_it_is_refused(tmp_path: Path, given: dict[str, str]) -> None:
    settings = load_settings(user="none", runs=tmp_path, **FAKE, **given)
    with pytest.raises(InputError, match="there is no person to talk with; use --user console"):
        Session(settings)


def test_a_file_that_is_no_sound_ends_the_session_before_it_begins(tmp_path: Path) -> None:
    file = tmp_path / "said.wav"
    file.write_text("bring the mug")
    settings = load_settings(ears="pocketsphinx", microphone=str(file), runs=tmp_path, **FAKE)
    with pytest.raises(InputError, match="said.wav: is no WAV file"):
        Session(settings)


def test_ears_that_do_not_exist_are_refused() -> None:
    with pytest.raises(InputError, match="setting 'ears'.*'pocketsphinx'"):
        load_settings(ears="loud")
