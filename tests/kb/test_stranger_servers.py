"""A server's language model: more ways in which servers write, refuse and list."""

import gzip
import json
from typing import Any

import pytest
from odd_server import (
    HELLO,
    THE_DESK,
    Behaviour,
    Handler,
    answer,
    dislikes,
    refuses,
    says,
    sends,
    streams,
    talking,
    word,
)

from executive.servers.key import Key
from executive.types.llm import ChatRequest
from kb.llm.server import asking
from kb.llm.thinking import answer_of

WHOLE = {"choices": [{"message": {"content": "desk"}, "finish_reason": "stop"}]}
IN_LINES = json.dumps(word("desk", "stop"), indent=1).splitlines()


@pytest.fixture(autouse=True)
def no_pauses(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(asking, "PAUSE_S", 0.0)


def lines(*values: object) -> bytes:
    return b"".join(json.dumps(value).encode() + b"\n" for value in values)


def chunks(*raw: bytes, whole: bool = True) -> Behaviour:
    """Sends these in HTTP's chunks; the end of them is missing if it is not whole."""

    def behave(handler: Handler, body: dict[str, Any]) -> None:
        handler.protocol_version = "HTTP/1.1"
        handler.send_response(200)
        handler.send_header("Transfer-Encoding", "chunked")
        handler.end_headers()
        for part in (*raw, *([b""] if whole else [])):
            handler.wfile.write(b"%x\r\n%s\r\n" % (len(part), part))
        handler.close_connection = True

    return behave


def packed(raw: bytes, coding: str = "gzip", status: int = 200) -> Behaviour:
    return lambda handler, _: answer(handler, status, raw, Content_Encoding=coding)


NDJSON = lines(word("de"), word("sk", "stop"))
OLLAMA = lines(
    {"model": "m", "message": {"role": "assistant", "content": "de"}, "done": False},
    {"message": {"role": "assistant", "content": "sk"}, "done": True, "done_reason": "stop"},
)
EVENT = b"data: " + json.dumps(word("desk")).encode() + b"\r\n\r\n"


@pytest.mark.parametrize(
    "behaviour",
    [
        sends("".join(f"data: {line}\n" for line in IN_LINES).encode() + b"\ndata: [DONE]\n\n"),
        sends("".join(f"data: {line}\r\n" for line in IN_LINES).encode() + b"\r\n"),
        sends(NDJSON),
        sends(OLLAMA),
        sends(lines({"response": "de"}, {"response": "sk", "done": True, "done_reason": "stop"})),
        chunks(EVENT),
        chunks(*(EVENT[at : at + 1] for at in range(len(EVENT)))),
        streams(word("desk"), {"choices": [], "usage": {"completion_tokens": 1}}),
        streams("null", word("de"), "null", word("sk", "stop"), "[DONE]"),
        packed(gzip.compress(json.dumps(WHOLE).encode())),
        packed(gzip.compress(EVENT)),
        sends(
            lines(
                {
                    "choices": [
                        {"index": 0, "message": {"content": "desk"}},
                        {"index": 1, "message": {"content": "sofa"}},
                    ]
                }
            )
        ),
    ],
)
def test_a_reply_is_read_in_the_less_usual_forms_too(behaviour: Behaviour) -> None:
    with talking(behaviour) as talk:
        assert talk.reply().text == "desk"


def test_a_reply_that_lost_its_end_on_the_way_does_not_count() -> None:
    with talking(chunks(EVENT, whole=False)) as talk:
        assert "broke off in the middle of its reply" in talk.reason()


def test_a_small_packed_reply_cannot_become_a_huge_one() -> None:
    with talking(packed(gzip.compress(b"data: " + b" " * (9 << 20)))) as talk:
        assert "it is longer than 8 MiB" in talk.reason()


@pytest.mark.parametrize(("raw", "coding"), [(b"x" * 50, "gzip"), (b"x", "br")])
def test_what_cannot_be_unpacked_is_told(raw: bytes, coding: str) -> None:
    with talking(packed(raw, coding)) as talk:
        assert f"packed ({coding})" in talk.reason()


def test_a_packed_refusal_and_a_packed_listing_are_read() -> None:
    refusal = packed(gzip.compress(b'{"error": "who are you?"}'), status=401)
    listing = packed(gzip.compress(b'{"data": [{"id": "chat-7b"}]}'))
    with talking(THE_DESK, refusal, models=listing) as talk:
        assert talk.reply().usage.model == "chat-7b"
        assert "HTTP 401: who are you?" in talk.reason()


@pytest.mark.parametrize(
    ("behaviour", "reason"),
    [
        (streams(word(""), "[DONE]"), "its answer is empty"),
        (streams("[DONE]"), "its answer is empty"),
        (streams(word(" \n", "content_filter")), "its answer is empty (content_filter)"),
        (says("desk" * 50_001), "its answer is longer than 200000 characters"),
        (
            streams(word(None, "tool_calls", tool_calls=[{"function": {"arguments": "{}"}}])),
            "it called a tool, which it does not have, instead of an answer",
        ),
    ],
)
def test_an_answer_with_nothing_or_too_much_in_it_is_a_failure_that_is_told(
    behaviour: Behaviour, reason: str
) -> None:
    with talking(behaviour) as talk:
        assert talk.reason() == reason


def test_a_reply_of_another_interface_is_told() -> None:
    with talking(sends(b'{"content": [{"text": "the desk"}], "stop_reason": "end_turn"}')) as talk:
        assert talk.reason() == (
            "it does not answer as /chat/completions does: its reply has only content, stop_reason"
        )


def test_a_redirection_to_nowhere_is_a_refusal() -> None:
    with talking(lambda handler, _: answer(handler, 302, {})) as talk:
        assert "HTTP 302 Found" in talk.reason()


def test_a_text_that_is_no_reply_is_told() -> None:
    with talking(sends(b"hello\nworld\n")) as talk:
        assert "is no JSON object in UTF-8: hello" in talk.reason()


@pytest.mark.parametrize("status", [400, 422, 500])
@pytest.mark.parametrize(
    "words",
    [
        "jinja2.exceptions.TemplateError: system",
        "Unsupported message type: system",
        "Conversation must start with a user message",
        "The first message must be from the user",
        "invalid role",
        "'system' is not one of ['user', 'assistant']",
        "Roles must be strictly alternating",
        "Failed to apply chat template",
    ],
)
def test_a_server_without_a_system_turn_is_given_none_however_it_says_so(
    status: int, words: str
) -> None:
    with talking(dislikes("system", status, {"error": {"message": words}})) as talk:
        assert talk.reply().text == "desk"


@pytest.mark.parametrize("key", ["system", "max_tokens", "seed", "top_p"])
def test_what_a_server_dislikes_without_saying_what_is_found(key: str) -> None:
    with talking(dislikes(key, 400, "Bad request")) as talk:
        assert talk.reply().text == "desk"


def test_what_did_not_help_is_asked_for_again_the_next_time() -> None:
    with talking(refuses(400, "no")) as talk:
        talk.ask()
        asked = len(talk.bodies)
        talk.ask()
    assert talk.bodies[asked].keys() == talk.bodies[0].keys()
    assert talk.bodies[asked]["messages"][0]["role"] == "system"


@pytest.mark.parametrize(
    "models",
    [
        {"data": [{"id": "kokoro-82m"}, {"id": "snowflake-arctic-l"}, {"id": "chat-7b"}]},
        {"data": [{"id": 5}, {"model_name": "chat-7b"}]},
        {"data": {"chat-7b": {"owner": "me"}}},
        refuses(400, "no listing here"),
    ],
)
def test_models_are_found_in_the_less_usual_listings_too(models: object) -> None:
    with talking(THE_DESK, models=models) as talk:
        assert talk.reply().usage.model == "chat-7b" or callable(models)


def test_no_part_of_the_key_is_told_where_a_refusal_is_cut() -> None:
    secret = "sk-0123456789abcdef"
    words = "x" * 190 + secret
    with talking(refuses(401, words), api_key=Key(secret)) as talk:
        assert "sk-0" not in talk.reason()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('<think type="deep">desk</think>sofa', "sofa"),
        ("<|START_THINKING|>desk<|END_THINKING|>sofa", "sofa"),
        ("<|begin_of_thought|>desk<|end_of_thought|>sofa", "sofa"),
        ("◁think▷desk◁/think▷sofa", "sofa"),
        ("<|channel|>analysis<|message|>desk<|end|><|start|>assistant<|channel|>final "
         "<|constrain|>json<|message|>sofa<|return|>", "sofa"),
        ("analysisThe desk?assistantfinalsofa", "sofa"),
        ("analysisThe desk", ""),
        ("analysis of the sofa", "analysis of the sofa"),
    ],
)  # fmt: skip
def test_thoughts_are_known_by_the_marks_of_other_models_too(text: str, said: str) -> None:
    assert answer_of(text)[0] == said


def test_a_second_mission_finds_the_server_again() -> None:
    def dies(handler: Handler, body: dict[str, Any]) -> None:
        handler.connection.close()

    with talking(THE_DESK, dies, dies, says("sofa")) as talk:
        assert talk.reply().text == "desk"
        assert "cannot be reached" in talk.reason()
        assert talk.reply().text == "sofa"


def test_closing_after_a_refused_reply_leaves_nothing_behind(
    capfd: pytest.CaptureFixture[str],
) -> None:
    with talking(streams({"error": {"message": "no"}}, word("desk"), "[DONE]")) as talk:
        talk.ask(ChatRequest("x", HELLO.messages))
    assert "destroyed" not in capfd.readouterr().err
