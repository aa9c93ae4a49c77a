"""Files of sound, good ones and bad ones."""

import io
import wave
from pathlib import Path

import numpy as np
import pytest

from executive.errors import InputError
from executive.speech.microphone import from_files, microphone
from executive.speech.sound import RATE_HZ, from_wav, is_silent, read_wav, to_wav
from executive.speech.utterances import Utterances

TONE = (8000 * np.sin(2 * np.pi * 440 * np.arange(RATE_HZ) / RATE_HZ)).astype(np.int16)


def wav(samples: "np.ndarray", rate: int = RATE_HZ, channels: int = 1, width: int = 2) -> bytes:
    content = io.BytesIO()
    with wave.open(content, "wb") as file:
        file.setnchannels(channels)
        file.setsampwidth(width)
        file.setframerate(rate)
        file.writeframes(samples.tobytes())
    return content.getvalue()


def test_what_was_written_is_read_again() -> None:
    assert np.array_equal(from_wav(to_wav(TONE), "it"), TONE)


def test_eight_kilohertz_in_stereo_become_sixteen_in_one_channel() -> None:
    both = np.stack([TONE[::2], TONE[::2]], axis=1)
    sound = from_wav(wav(both, rate=8000, channels=2), "it")
    assert len(sound) == RATE_HZ
    assert np.abs(sound[1000:-1000].astype(int) - TONE[1000:-1000]).max() < 800


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "is no WAV file"),
        (b"OggS and so on", "is no WAV file"),
        (wav(TONE.astype(np.int8), width=1), "has samples of 8 bits"),
        (wav(np.tile(TONE, 601)), "is longer than 60 s"),
        (wav(TONE, rate=400), "has 400 samples a second"),
    ],
    ids=["empty", "ogg", "8 bits", "10 minutes", "slow"],
)
def test_what_cannot_be_heard_is_refused_in_a_sentence(content: bytes, said: str) -> None:
    with pytest.raises(InputError, match=f"words.wav: {said}"):
        from_wav(content, "words.wav")


def test_a_file_that_is_not_there_is_told_with_what_would_be_right(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="No such file.*record WAV"):
        read_wav(tmp_path / "none.wav")


def test_a_folder_without_sound_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"there is no \.wav file in this folder"):
        microphone(str(tmp_path))


def test_a_recorder_that_is_not_installed_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    with pytest.raises(InputError, match="--microphone arecord: there is no such program"):
        microphone("arecord")


def test_a_click_and_a_hum_are_no_utterances() -> None:
    click = np.zeros(2 * RATE_HZ, dtype=np.int16)
    click[8000:8160] = 20000
    hum = np.tile(TONE, 20)
    assert _cut(click) == []
    assert _cut(hum) == []


def test_an_utterance_is_cut_out_of_the_quiet_around_it() -> None:
    quiet = np.zeros(2 * RATE_HZ, dtype=np.int16)
    (said,) = _cut(np.concatenate([quiet, TONE, quiet]))
    assert RATE_HZ < len(said) < 2.2 * RATE_HZ


def test_silence_is_silent() -> None:
    assert is_silent(TONE[:0])
    assert is_silent(TONE // 100)
    assert not is_silent(TONE)


def _cut(sound: "np.ndarray") -> list["np.ndarray"]:
    cut = Utterances()
    found = [cut.add(block) for block in from_files([sound], wait=lambda seconds: None)]
    return [said for said in (*found, cut.end()) if said is not None]
