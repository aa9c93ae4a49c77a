"""Files of sound, good ones and bad ones."""

import io
import wave
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from patience import PATIENCE_S

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
        (wav(TONE)[:20], "is no WAV file"),
        (wav(TONE)[:44], "has no sound in it"),
        (b"bring the mug\n", "is no WAV file"),
        (wav(TONE).replace(b"fmt \x10\0\0\0\1", b"fmt \x10\0\0\0\3"), "no whole numbers"),
        (wav(np.tile(TONE, 601)), "is longer than 60 s"),
        (wav(TONE, rate=400), "has 400 samples a second"),
    ],
    ids=["empty", "ogg", "cut header", "no samples", "text", "float", "10 minutes", "slow"],
)
def test_what_cannot_be_heard_is_refused_in_a_sentence(content: bytes, said: str) -> None:
    with pytest.raises(InputError, match=f"words.wav: .*{said}.*; "):
        from_wav(content, "words.wav")


def test_a_file_that_is_not_there_is_told_with_what_would_be_right(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="No such file.*record WAV"):
        read_wav(tmp_path / "none.wav")


def test_a_folder_without_sound_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"there is no \.wav file in this folder"):
        microphone(str(tmp_path))


@pytest.mark.parametrize("extensible", [False, True])
@pytest.mark.parametrize("bits", [8, 24, 32])
def test_samples_of_other_sizes_become_sixteen_bits(bits: int, extensible: bool) -> None:
    if bits == 8:
        raw = (TONE // 256 + 128).astype(np.uint8)
    else:
        raw = (TONE.astype("<i4") << 16).view(np.uint8).reshape(-1, 4)[:, 4 - bits // 8 :]
    content = wav(np.ascontiguousarray(raw), width=bits // 8)
    if extensible:
        plain = content[20:36]
        header = b"\xfe\xff" + plain[2:] + bytes([22, 0, bits, 0, 0, 0, 0, 0, 1]) + bytes(15)
        content = content[:16] + bytes([40, 0, 0, 0]) + header + content[36:]
        content = content[:4] + (len(content) - 8).to_bytes(4, "little") + content[8:]
    assert np.abs(from_wav(content, "it").astype(int) - TONE).max() <= (256 if bits == 8 else 1)


def test_a_file_without_end_is_refused() -> None:
    with pytest.raises(InputError, match="/dev/zero: is larger than 100 MB"):
        read_wav(Path("/dev/zero"))


@given(st.binary(max_size=80), st.integers(0, 60), st.integers(0, 40))
def test_whatever_a_file_has_in_it_is_sound_or_refused(junk: bytes, at: int, cut: int) -> None:
    whole = wav(TONE[:100])
    for content in (junk, whole[:at] + junk + whole[at + cut :]):
        with suppress(InputError):
            assert from_wav(content, "it").dtype == np.int16


def arecord(folder: Path, does: str, monkeypatch: pytest.MonkeyPatch) -> None:
    program = folder / "arecord"
    program.write_text(f"#!/bin/sh\n{does}\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(folder), prepend=":")


@pytest.mark.parametrize("why", ["No such file or directory", "Device or resource busy"])
def test_a_microphone_that_is_not_there_or_busy_is_told_at_once(
    tmp_path: Path, why: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    arecord(tmp_path, f"echo 'arecord: main:850: audio open error: {why}' >&2; exit 1", monkeypatch)
    monkeypatch.setattr("executive.speech.microphone.START_S", PATIENCE_S)
    said = f"--microphone arecord: nothing is recorded: audio open error: {why}; see what arecord"
    with pytest.raises(InputError, match=said):
        microphone("arecord")


def test_a_microphone_that_is_pulled_out_is_told_when_it_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    does = "head -c 6400 /dev/zero; sleep 1; echo 'arecord: pcm_read:2221: read error' >&2; exit 1"
    arecord(tmp_path, does, monkeypatch)
    heard = microphone("arecord")
    assert [len(next(heard)) for _ in range(2)] == [1600, 1600]
    with pytest.raises(InputError, match="nothing is recorded: read error"):
        next(heard)


def test_a_recorder_is_ended_with_who_listens(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    arecord(tmp_path, f"echo $$ > {tmp_path}/pid; exec cat /dev/zero", monkeypatch)
    heard = microphone("arecord")
    next(heard)
    heard.close()  # type: ignore[attr-defined]
    assert not Path(f"/proc/{(tmp_path / 'pid').read_text().strip()}").exists()


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
