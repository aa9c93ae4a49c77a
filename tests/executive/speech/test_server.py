"""Ears that are a server: what it may answer, and what the person is told."""

import json
import threading
import wave
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler
from io import BytesIO

import numpy as np
import pytest
from audio_server import Answer, Server, hearing, says
from hypothesis import given
from hypothesis import strategies as st
from patience import PATIENCE_S

from executive.errors import InputError
from executive.servers.key import EARS_KEY, Key
from executive.servers.refusal import Refused
from executive.speech.server import ServerEars
from executive.speech.sound import RATE_HZ
from executive.speech.transcript import MOST_CHARACTERS, NotATranscript, transcript
from executive.testing.contracts.ears import EarsContract
from executive.text import one_line

SOUND = np.random.default_rng(0).normal(0, 3000, RATE_HZ).astype(np.int16)
MUG = {"text": " Bring the mug. "}
VERBOSE = {**MUG, "segments": [{"avg_logprob": -0.1054, "no_speech_prob": 0.01}]}
NO_VERBOSE = {"error": {"message": "response_format 'verbose_json' is not compatible"}}
SECRET = "sk-0123456789"


class TestServerEars(EarsContract):
    @pytest.fixture
    def ears(self) -> Iterator[ServerEars]:
        with hearing(says(VERBOSE)) as server:
            yield ServerEars(server.url)


def heard(*answers: Answer, timeout_s: float = PATIENCE_S, key: str = "") -> tuple[str, str]:
    """What ears make of a server's answers: the words, and what went wrong."""
    with hearing(*answers) as server:
        reading = ServerEars(server.url, timeout_s=timeout_s, key=Key(key)).hear(SOUND)
        assert not reading.sure
        return reading.text, reading.problem.replace(server.url, "SERVER")


def fields(server: Server) -> bytes:
    return server.bodies[-1]


def test_it_is_sent_a_wav_file_with_model_and_language_and_key() -> None:
    with hearing(says(VERBOSE)) as server:
        ears = ServerEars(server.url, model="tiny", language="fr", key=Key(SECRET))
        reading = ears.hear(SOUND)
    assert (reading.by, reading.text, reading.confidence) == ("tiny", "Bring the mug.", 0.9)
    assert server.keys == [f"Bearer {SECRET}"]
    for name, value in ("model", "tiny"), ("language", "fr"), ("response_format", "verbose_json"):
        assert f'name="{name}"\r\n\r\n{value}\r\n'.encode() in fields(server)
    sent = fields(server)
    with wave.open(BytesIO(sent[sent.index(b"RIFF") :])) as file:
        assert (file.getframerate(), file.getnframes()) == (RATE_HZ, len(SOUND))


def test_silence_is_not_sent() -> None:
    with hearing(says(MUG)) as server:
        assert ServerEars(server.url).hear(np.zeros(RATE_HZ, dtype=np.int16)).text == ""
    assert server.paths == []


def test_one_that_has_no_verbose_form_is_asked_for_the_plain_one_from_then_on() -> None:
    with hearing(says(NO_VERBOSE, 400), says(MUG)) as server:
        ears = ServerEars(server.url)
        readings = [ears.hear(SOUND), ears.hear(SOUND)]
    assert [(one.text, one.confidence) for one in readings] == [("Bring the mug.", 0.0)] * 2
    assert len(server.paths) == 3
    assert b"\r\n\r\njson\r\n" in fields(server)


@pytest.mark.parametrize(
    ("under", "given"),
    [("/v1", ""), ("/v1", "/v1"), ("/v1", "/v1/audio/transcriptions"), ("", ""), ("/a", "/a/")],
)
def test_the_address_is_taken_as_people_write_it(under: str, given: str) -> None:
    with hearing(says(MUG), under=under) as server:
        assert ServerEars(server.url + given).hear(SOUND).text == "Bring the mug."


def hangs(request: BaseHTTPRequestHandler, body: bytes) -> None:
    threading.Event().wait(1.0)


def drips(request: BaseHTTPRequestHandler, body: bytes) -> None:
    request.wfile.write(b"HTTP/1.1 200 OK\r\n")
    for _ in range(100):
        request.wfile.write(b"X")
        threading.Event().wait(0.02)


def hangs_up(request: BaseHTTPRequestHandler, body: bytes) -> None:
    request.close_connection = True


def speaks_otherwise(request: BaseHTTPRequestHandler, body: bytes) -> None:
    request.wfile.write(b"SSH-2.0-OpenSSH\r\n")


@pytest.mark.parametrize(
    ("answer", "told"),
    [
        (hangs_up, "SERVER cannot be reached: Server disconnected"),
        (speaks_otherwise, "SERVER cannot be reached: "),
        (says(b"<html>Bad Gateway</html>", 502), "SERVER refused (HTTP 502 Bad Gateway)"),
        (says(b"<html>Hello</html>"), "the reply of SERVER cannot be read: it is not JSON"),
        (says(b""), "it is not JSON"),
        (says([MUG]), "it is no JSON object"),
        (says({"words": "bring the mug"}), "it has no 'text'"),
        (says({"text": ["bring"]}), "it has no 'text'"),
        (says(b"[" * 100_000), "it is not JSON"),
        (says(b" " * (2 << 20)), "it is too long"),
        (says(b"\x1f\x8b", Content_Encoding="gzip"), "it is packed (gzip)"),
        (says({"error": {"message": "no such model"}}), "SERVER refused (no such model)"),
        (says({}, 401), f"SERVER refused (HTTP 401 Unauthorized); set {EARS_KEY}"),
        (says({}, 429, Retry_After="7"), "Too Many Requests); it asks to wait 7 s"),
        (says({}, 307, Location="http://b.example/x"), "it sends to http://b.example/x; give that"),
        (says({"detail": "\x1b[31mred\nalert"}, 500), "(HTTP 500: \\x1b[31mred alert)"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_whatever_it_does_instead_is_told_in_a_sentence(answer: Answer, told: str) -> None:
    text, problem = heard(answer)
    assert text == ""
    assert told in problem
    assert problem.isprintable()


@pytest.mark.parametrize("answer", [hangs, drips])
def test_one_that_takes_too_long_is_given_up(answer: Answer) -> None:
    assert heard(answer, timeout_s=0.3) == ("", "SERVER did not answer within 0.3 s")


def test_one_that_is_not_there_is_told() -> None:
    with hearing(says(MUG)) as server:
        pass
    assert "cannot be reached: Connection refused" in ServerEars(server.url).hear(SOUND).problem


def test_the_key_is_shown_to_nobody_even_if_the_server_repeats_it() -> None:
    text, problem = heard(says({"error": f"bad key {SECRET}"}, 403), key=SECRET)
    assert SECRET not in problem
    assert "bad key ***" in problem
    assert heard(says({"text": SECRET}), key=SECRET)[0] == "***"


def test_a_key_in_the_address_is_refused() -> None:
    with pytest.raises(InputError, match=f"user and password; put the key into {EARS_KEY}"):
        ServerEars("http://me:secret@example.org/v1")


def test_where_sound_leaves_the_machine_it_is_said() -> None:
    assert ServerEars("http://127.0.0.1:9/v1").note == ""
    assert ServerEars("http://localhost:9").note == ""
    assert ServerEars("https://ears.example/v1").note == (
        "What you say aloud is sent to https://ears.example/v1."
    )
    assert "anyone on the way can listen" in ServerEars("http://ears.example/v1").note


@pytest.mark.parametrize(
    "noise", ["[BLANK_AUDIO]", " (music) ", "*coughs*", "...", "♪", "la " * 500]
)
def test_what_no_person_says_is_no_word(noise: str) -> None:
    assert transcript(json.dumps({"text": noise}).encode()).text == ""


def test_words_that_are_hardly_likely_in_what_is_no_speech_are_none() -> None:
    piece = {"avg_logprob": -1.5, "no_speech_prob": 0.9}
    assert transcript(json.dumps({"text": "Yes.", "segments": [piece]}).encode()).text == ""


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(
            st.sampled_from(["text", "segments", "error", "avg_logprob", "no_speech_prob", "x"]),
            inner,
            max_size=4,
        )
    ),
    max_leaves=12,
)
REPLIES = st.builds(
    lambda text, segments: {"text": text, "segments": segments},
    st.text(max_size=600),
    st.lists(
        st.fixed_dictionaries({}, optional={"avg_logprob": JSON, "no_speech_prob": JSON}) | JSON,
        max_size=3,
    ),
)


@given(st.binary() | (JSON | REPLIES).map(lambda value: json.dumps(value).encode()))
def test_any_reply_is_words_in_a_line_or_refused(body: bytes) -> None:
    try:
        found = transcript(body)
    except (NotATranscript, Refused):
        return
    assert found.text == one_line(found.text)
    assert len(found.text) <= MOST_CHARACTERS
    assert 0.0 <= found.confidence <= 1.0
