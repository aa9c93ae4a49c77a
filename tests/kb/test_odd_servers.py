"""A server's language model, with servers as people have them."""

import json
import logging
import threading
import time
from datetime import UTC, datetime, timedelta
from email.utils import format_datetime
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from odd_server import (
    HELLO,
    SCHEMA,
    THE_DESK,
    Handler,
    answer,
    dislikes,
    end_of,
    refuses,
    says,
    send,
    sends,
    serving,
    streams,
    talking,
    word,
)
from patience import PATIENCE_S, until

from executive.config import load_settings
from executive.errors import InputError
from executive.events import Inbox
from executive.servers.address import bases_of
from executive.servers.key import Key
from executive.servers.refusal import Refused, refusal
from executive.types.llm import ChatRequest, Message, RankRequest
from executive.types.results import Failed
from kb.llm.options import ModelOptions
from kb.llm.server import asking, lines, wire
from kb.llm.server.dialect import Dialect
from kb.llm.server.server import Server
from kb.llm.thinking import answer_of

RANK = RankRequest("rank", HELLO.messages, (), ("here",), ("here",))


@pytest.fixture(autouse=True)
def no_pauses(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(asking, "PAUSE_S", 0.0)


# --- replies ---


def test_a_servers_streamed_words_become_the_reply() -> None:
    with talking(says("on ", "the ", "desk"), options=ModelOptions(seed=7)) as talk:
        reply = talk.reply()
    assert (reply.text, reply.finish_reason) == ("on the desk", "stop")
    assert (reply.usage.input_tokens, reply.usage.output_tokens) == (40, 7)
    assert (reply.usage.model, reply.usage.parameters["seed"]) == ("tiny-model", 7)
    assert 0 < reply.usage.first_token_s <= reply.usage.total_s
    assert talk.bodies[0]["model"] == "tiny-model"
    assert talk.bodies[0]["messages"][1] == {"role": "user", "content": "The mug?"}


def test_a_character_that_a_server_cuts_in_two_is_whole_in_the_reply() -> None:
    with talking(says("on \ud83d", "\ude00 and \ud83d")) as talk:
        assert talk.reply().text == "on \N{GRINNING FACE} and \N{REPLACEMENT CHARACTER}"


WHOLE = {"choices": [{"message": {"content": "desk"}, "finish_reason": "stop"}]}


@pytest.mark.parametrize(
    "behaviour",
    [
        streams(word("desk"), "[DONE]"),
        streams(word("desk"), word("", "stop")),
        streams(word("de", error=None), {**word("sk", "stop"), "error": None}, "[DONE]"),
        streams(word([{"type": "text", "text": "de"}, {"type": "text", "text": "sk"}]), "[DONE]"),
        streams(word(None, role="assistant"), word("desk"), {"choices": []}, "[DONE]"),
        streams(word("desk"), {"choices": None, "usage": None}, {"choices": [None]}, "[DONE]"),
        streams({"choices": [{"text": "desk", "finish_reason": "stop"}]}),
        sends(json.dumps(WHOLE).encode()),
        sends(json.dumps(WHOLE, indent=2).replace("\n", "\r\n").encode()),
        sends(b"\xef\xbb\xbfdata:" + json.dumps(word("desk", "stop")).encode() + b"\r\n\r\n"),
        sends(
            b": hello\nevent: message\rid: 1\r\rdata: "
            + json.dumps(word("desk")).encode()
            + b"\n\n: still here\n\ndata:[DONE]\n\ndata: {garbage"
        ),
    ],
)
def test_a_reply_is_read_as_servers_write_it(behaviour: Any) -> None:
    with talking(behaviour) as talk:
        assert talk.reply().text == "desk"


@pytest.mark.parametrize(
    "count", [2.5, -3, None, "7", True, [], 10**30, 1e300, float("nan"), float("-inf")]
)
def test_a_count_of_tokens_that_is_none_costs_nothing_but_itself(count: object) -> None:
    usage = {"prompt_tokens": count, "completion_tokens": count, "prompt_tokens_details": count}
    with talking(streams(word("desk"), {"choices": [], "usage": usage}, "[DONE]")) as talk:
        reply = talk.reply()
    assert reply.text == "desk"
    assert reply.usage.output_tokens == 1
    assert isinstance(reply.usage.input_tokens, int)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("<think>desk? no</think>\nsofa", "sofa"),
        ("<Thinking>desk? <think> no</THINKING> sofa", "sofa"),
        ("desk, no</think>sofa", "sofa"),
        ("sofa<think>or the desk", "sofa"),
        ("[THINK]desk[/THINK]sofa", "sofa"),
        ("<think>a</think>sofa<think>b</think>", "sofa"),
        ("<|channel|>analysis<|message|>desk<|end|><|start|>assistant<|channel|>final<|message|>"
         "sofa<|return|>", "sofa"),
        ("<|channel|>analysis<|message|>desk", ""),
        (" a < b and [b] > a ", " a < b and [b] > a "),
    ],
)  # fmt: skip
def test_what_is_thought_is_no_part_of_the_answer(text: str, said: str) -> None:
    assert answer_of(text)[0] == said


@pytest.mark.parametrize("key", ["reasoning_content", "reasoning", "thinking"])
def test_thoughts_in_a_field_of_their_own_are_left_out(key: str) -> None:
    with talking(streams(word(None, **{key: "the sofa?"}), word("desk"), "[DONE]")) as talk:
        assert talk.reply().text == "desk"


@pytest.mark.parametrize(
    "thought", [word("<think>hm"), word(None, reasoning_content="hm"), word("")]
)
def test_tokens_that_were_used_up_while_thinking_are_told(thought: dict[str, Any]) -> None:
    usage = {"choices": [], "usage": {"completion_tokens": 30}}
    with talking(
        streams(thought, word("", "length"), usage, "[DONE]"), options=ModelOptions(max_tokens=30)
    ) as talk:
        assert talk.reason() == "it used up its 30 tokens while thinking; raise max_tokens"


def test_a_server_that_dies_in_its_reply_has_failed() -> None:
    with talking(streams(word("on the"))) as talk:
        assert "broke off in the middle of its reply" in talk.reason()


@pytest.mark.parametrize("chunk", ["{garbage", "[1]", "5", "true", "[" * 100_000, "1" * 5000])
def test_a_stream_of_something_else_has_failed(chunk: str) -> None:
    with talking(streams(chunk)) as talk:
        assert "is no JSON object in UTF-8: " + chunk[:50] in talk.reason()


@pytest.mark.parametrize("mark", ['data: {"error": %s}', "error: %s", "event: error\ndata: %s"])
def test_an_error_in_a_stream_is_told(mark: str) -> None:
    with talking(sends((mark % r'{"message": "out of\nmemory"}' + "\n\n").encode())) as talk:
        assert talk.reason() == "out of memory"


def test_a_page_instead_of_a_reply_is_told() -> None:
    with talking(sends(b"<!doctype html><html>Sign in</html>")) as talk:
        assert "is no JSON object in UTF-8: <!doctype html>" in talk.reason()


@pytest.mark.parametrize("unit", [b"x", b"data: {}\n\n"])
def test_a_reply_without_an_end_is_bounded(unit: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lines, "MOST_BYTES", 1 << 20)
    with talking(sends(unit * (1 << 21))) as talk:
        assert "it is longer than 1 MiB" in talk.reason()


def test_a_reply_in_drips_ends_at_the_time_out() -> None:
    def drips(handler: Handler, body: dict[str, Any]) -> None:
        send(handler)
        try:
            while True:
                handler.wfile.write(b": wait\n\n")
                time.sleep(0.02)
        except OSError:
            pass

    with talking(drips, timeout_s=0.3) as talk:
        assert "did not answer within 0.3 s" in talk.reason()


# --- what is asked, and how ---


PYDANTIC = {"type": "extra_forbidden", "loc": ["body", "seed"], "msg": "not permitted", "input": {}}


@pytest.mark.parametrize(
    ("key", "status", "words"),
    [
        ("system", 400, "System role not supported"),
        ("system", 500, {"error": {"code": 500, "message": "Jinja: System role not supported"}}),
        ("system", 400, {"detail": "Conversation roles must alternate user/assistant/user/..."}),
        ("system", 400, {"error": {"message": "Developer instruction is not enabled"}}),
        (
            "system",
            422,
            {
                "detail": [
                    {
                        "loc": ["body", "messages", 0, "role"],
                        "msg": "Input should be 'user' or 'assistant'",
                    }
                ]
            },
        ),
        ("system", 400, "Only user, assistant and tool roles are supported, got system."),
        ("max_tokens", 400, {"error": {"message": "Unsupported parameter", "param": "max_tokens"}}),
        ("max_tokens", 400, "'max_tokens' is not supported. Use 'max_completion_tokens' instead."),
        ("temperature", 400, {"error": {"message": "'temperature' does not support 0.6 here."}}),
        ("seed", 422, {"detail": [PYDANTIC]}),
        ("stream_options", 400, {"object": "error", "message": "{'loc': ('stream_options')}"}),
        ("top_p", 400, {"error": "unknown field `top_p`", "error_type": "validation"}),
        ("seed", 400, "UnsupportedParamsError: m does not support parameters: ['seed']"),
        ("response_format", 400, {"error": "json_schema is not supported"}),
        ("response_format", 500, ""),
        ("seed", 400, ""),
        ("top_p", 422, {"errors": ["bad"]}),
    ],
)
def test_what_is_refused_is_left_out_or_said_otherwise_from_then_on(
    key: str, status: int, words: object
) -> None:
    with talking(dislikes(key, status, words), options=ModelOptions(grammar=True)) as talk:
        assert talk.reply().text == "desk"
        tries = len(talk.bodies)
        assert talk.reply().text == "desk"
    assert tries <= 4
    assert len(talk.bodies) == tries + 1
    last = talk.bodies[-1]
    assert ("max_completion_tokens" if key == "max_tokens" else "max_tokens") in last
    assert "mug" in last["messages"][-1]["content"]
    assert any("You know a home." in turn["content"] for turn in last["messages"])


def test_only_what_is_refused_is_left_out() -> None:
    with talking(dislikes("seed", 400, "seed: unknown"), options=ModelOptions(seed=3)) as talk:
        talk.reply()
    first, second = talk.bodies
    assert {*first} - {*second} == {"seed"}


def test_a_server_that_refuses_one_thing_after_the_other_gets_its_reply_out() -> None:
    refused = ("temperature", "top_p", "seed", "stream_options", "max_tokens")

    def picky(handler: Handler, body: dict[str, Any]) -> None:
        for key in (*refused, "max_completion_tokens"):
            if key in body:
                answer(handler, 400, f"unknown parameter {key}")
                return
        THE_DESK(handler, body)

    with talking(picky) as talk:
        assert talk.reply().text == "desk"
    assert len(talk.bodies) == 7


def test_a_server_that_cannot_stream_answers_at_once() -> None:
    def whole(handler: Handler, body: dict[str, Any]) -> None:
        if body["stream"]:
            answer(handler, 400, "Streaming is not supported by this model")
        else:
            answer(handler, 200, WHOLE)

    with talking(whole) as talk:
        assert talk.reply().text == "desk"


def test_a_server_is_asked_to_keep_to_the_schema_if_so_set() -> None:
    with talking(says("{}"), options=ModelOptions(grammar=True)) as talk:
        talk.reply()
    assert talk.bodies[0]["response_format"]["json_schema"]["schema"] == SCHEMA


@pytest.mark.parametrize("status", [400, 422, 500])
def test_a_server_that_dislikes_the_schema_is_given_it_in_the_other_way(status: int) -> None:
    with talking(refuses(status), THE_DESK, options=ModelOptions(grammar=True)) as talk:
        talk.reply()
        talk.reply()
    ways = [body["response_format"]["type"] for body in talk.bodies]
    assert ways == ["json_schema", "json_object", "json_object"]
    assert talk.bodies[1]["response_format"]["schema"] == SCHEMA


def test_a_server_that_refuses_everything_has_refused() -> None:
    with talking(
        refuses(400, {"error": {"message": "no"}}), options=ModelOptions(grammar=True)
    ) as talk:
        assert talk.reason() == "HTTP 400: no"
        assert talk.bodies[-1].keys() == {"model", "messages", "stream"}


def test_a_chat_that_is_too_long_is_not_tried_with_less() -> None:
    words = "'max_tokens' is too large: 256. This model's maximum context length is 512 tokens"
    with talking(refuses(400, words)) as talk:
        assert "maximum context length is 512" in talk.reason()
    assert len(talk.bodies) == 1


OPTIONS = ["temperature", "top_p", "seed", "stream_options", "max_tokens", "response_format"]


refused = st.builds(
    Refused,
    st.sampled_from([200, 400, 404, 422, 500]),
    st.sampled_from([*OPTIONS, "system role", ""]) | st.text(),
)


@given(st.lists(refused, min_size=12, max_size=20))
def test_there_is_an_end_to_what_a_server_may_refuse(refusals: list[Refused]) -> None:
    dialect = Dialect({"temperature": 1, "top_p": 1, "seed": 1}, 9, grammar=True)
    learned = 0
    for refused in refusals:
        body = dialect.body(HELLO, "m")
        learned += dialect.learns(refused, body) or dialect.guesses(refused, body)
        assert {"model", "messages"} <= dialect.body(HELLO, "m").keys()
    assert learned <= 10


# --- which model, where ---


@pytest.mark.parametrize(
    "models",
    [
        ("text-embedding-3-small", "chat-7b"),
        ("BAAI/bge-m3", "ms-marco-reranker", "whisper-large-v3", "tts-1", "dall-e-3", "chat-7b"),
        {"models": [{"name": "nomic_embed_text:latest"}, {"name": "chat-7b"}]},
        [{"id": "x", "type": "embedding"}, {"id": None}, 3, {"id": "chat-7b", "type": "chat"}],
    ],
)
def test_a_model_that_does_not_chat_is_not_taken(models: object) -> None:
    with talking(THE_DESK, models=models) as talk:
        assert talk.reply().usage.model == "chat-7b"


@pytest.mark.parametrize(
    ("status", "words"),
    [
        (400, "Model does not support chat completion"),
        (404, {"error": {"message": "This is not a chat model and thus not supported here."}}),
        (400, {"error": '"granite" does not support chat'}),
        (400, {"error": '"granite" does not support generate'}),
        (400, "The model `a` does not exist or you do not have access to it."),
        (501, {"error": {"message": "This server does not support chat completions."}}),
    ],
)
def test_the_next_model_is_asked_if_one_does_not_chat(status: int, words: object) -> None:
    def behave(handler: Handler, body: dict[str, Any]) -> None:
        refuses(status, words)(handler, body) if body["model"] != "c" else THE_DESK(handler, body)

    with talking(behave, models=("a", "b", "c")) as talk:
        assert talk.reply().usage.model == "c"
        assert talk.reply().text == "desk"
    assert len(talk.bodies) == 4


def test_a_named_model_is_asked_for_and_no_other() -> None:
    words = {"error": {"message": 'model "mine" not found, try pulling it first'}}
    with talking(refuses(404, words), models=("a", "b"), model="mine") as talk:
        said = 'HTTP 404: model "mine" not found, try pulling it first; the server has a, b'
        assert talk.reason() == said
    assert [body["model"] for body in talk.bodies] == ["mine"]


@pytest.mark.parametrize(
    "models", [{"data": []}, "", [], {"data": 3}, {"data": [{"id": "\x1b[2J"}]}]
)
def test_a_server_of_one_model_need_not_list_it(models: object) -> None:
    with talking(THE_DESK, models=models) as talk:
        assert talk.reply().text == "desk"
        assert talk.model.name.startswith("http://127.0.0.1")


def test_a_server_that_is_too_busy_to_list_its_models_is_waited_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(asking, "LOOKING_S", 0.05)

    def lists_late(handler: Handler, _: bytes) -> None:
        time.sleep(0.5)
        answer(handler, 200, '{"data": [{"id": "late-model"}]}')

    with talking(THE_DESK, models=lists_late) as talk:
        assert talk.reply().usage.model == "late-model"


@pytest.mark.parametrize("end", ["", "/", "/v1/", "/v1//", "/v1/chat/completions", "/v1/models"])
def test_an_address_may_be_written_in_several_ways(end: str) -> None:
    with serving(THE_DESK) as odd:
        model = Server(odd.url + end, inbox := Inbox())
        model.chat(HELLO)
        assert inbox.wait(PATIENCE_S)
        model.close()
    assert odd.bodies


@pytest.mark.parametrize("under", ["", "/api", "/api/v1", "/v1beta/openai"])
def test_endpoints_may_be_anywhere(under: str) -> None:
    for models in (("m",), lambda handler, _: answer(handler, 404, "")):
        with talking(THE_DESK, models=models, under=under) as talk:
            assert talk.reply().text == "desk"


def test_a_version_is_added_only_where_there_is_none() -> None:
    assert bases_of("http://h:1/") == ("http://h:1/v1", "http://h:1")
    assert bases_of("https://h/openai") == ("https://h/openai", "https://h/openai/v1")
    assert bases_of("https://h/api/v3/") == ("https://h/api/v3",)


# --- a key ---

SECRET = "sk-4f5e6d7c"


def needs_a_key(handler: Handler, body: dict[str, Any]) -> None:
    if handler.headers["Authorization"] == f"Bearer {SECRET}":
        says(f"desk {SECRET}")(handler, body)
    else:
        answer(handler, 401, {"error": {"message": "Missing bearer authentication in header"}})


def test_a_key_is_sent_and_told_nobody(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.DEBUG)
    monkeypatch.setenv("EXECUTIVE_LLM_API_KEY", f" {SECRET}\n")
    key = Key.from_environment()
    with talking(needs_a_key, api_key=key, models=(SECRET,)) as talk:
        reply = talk.reply()
    assert reply.text == "desk ***"
    assert SECRET not in f"{reply} {vars(talk.model)} {vars(talk.model._asking)} {key}"
    assert caplog.text
    assert SECRET not in caplog.text


def test_a_refusal_that_repeats_the_key_does_not_tell_it() -> None:
    words = {"error": {"message": f"Incorrect API key provided: {SECRET}"}}
    with talking(refuses(401, words), api_key=Key(SECRET)) as talk:
        said = "HTTP 401: Incorrect API key provided: ***; check EXECUTIVE_LLM_API_KEY"
        assert talk.reason() == said


def test_a_missing_key_is_asked_for() -> None:
    with talking(needs_a_key) as talk:
        said = "HTTP 401: Missing bearer authentication in header; set EXECUTIVE_LLM_API_KEY"
        assert talk.reason() == said


def test_a_key_that_cannot_be_sent_is_refused_and_not_shown() -> None:
    with pytest.raises(InputError, match="^EXECUTIVE_LLM_API_KEY: has characters") as refused:
        Key("sk-one sk-two")
    assert "sk-" not in str(refused.value)


def test_a_key_is_not_carried_on_to_another_address() -> None:
    with serving(THE_DESK) as other:

        def moves(handler: Handler, body: dict[str, Any]) -> None:
            handler.send_response(307)
            handler.send_header("Location", f"{other.url}/v1/chat/completions?key=1")
            handler.end_headers()

        with talking(moves, models=moves, api_key=Key(SECRET)) as talk:
            assert f"HTTP 307: it sends to {other.url}/v1/chat/completions;" in talk.reason()
    assert not other.paths


@pytest.mark.parametrize(
    "url",
    ["http://me:secret@host/v1", "http://host/v1?api_key=secret", "http://host/v1#secret"]
    + ["http://secret@host", "http://:secret", "http://host:secret/v1", "http://[secret/v1"],
)
def test_an_address_with_a_secret_in_it_is_refused_and_not_shown(url: str) -> None:
    with pytest.raises(InputError, match="setting 'llm': ") as refused:
        load_settings(llm=url)
    assert "secret" not in str(refused.value)


def test_an_address_with_a_password_is_never_used() -> None:
    with pytest.raises(InputError, match="^http://host/v1: is given with user") as refused:
        Server("http://me:secret@host/v1", Inbox())
    assert "secret" not in str(refused.value)


def test_a_proxy_that_cannot_be_one_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("HTTP_PROXY", "http_proxy"):
        monkeypatch.setenv(name, "nonsense://[")
    monkeypatch.delenv("NO_PROXY", raising=False)
    model = Server("http://host.invalid/v1", inbox := Inbox())
    model.prepare(HELLO)
    result = end_of(inbox, model.chat(HELLO))
    model.close()
    assert isinstance(result, Failed)


# --- trouble ---


def test_a_server_that_fails_once_is_tried_again() -> None:
    with talking(refuses(500), THE_DESK) as talk:
        assert talk.reply().text == "desk"
    assert len(talk.bodies) == 2


def test_a_server_that_fails_twice_has_failed() -> None:
    with talking(refuses(502, "<html><body>Bad gateway</body></html>")) as talk:
        assert talk.reason() == "HTTP 502 Bad Gateway"
    assert len(talk.bodies) == 2


def test_a_refusal_is_passed_on_on_one_line_and_not_repeated() -> None:
    with talking(refuses(404, "no\n such \x1b[2Jmodel" + "x" * 10_000)) as talk:
        reason = talk.reason()
    assert reason.startswith(r"HTTP 404: no such \x1b[2Jmodelxx")
    assert len(reason) < 250
    assert len(talk.bodies) == 1


def test_a_busy_server_is_waited_for() -> None:
    soon = format_datetime(datetime.now(UTC) + timedelta(seconds=1), usegmt=True)
    for wait in ({"Retry_After": "0.05"}, {"Retry_After": soon}, {"Retry_After": "later"}, {}):
        with talking(refuses(429, **wait), refuses(503, **wait), THE_DESK) as talk:
            assert talk.reply().text == "desk"


@pytest.mark.parametrize("wait", [{"Retry_After": "3600"}, {"Retry_After": "1e999"}])
def test_a_server_that_is_busy_for_longer_than_there_is_time_has_failed(
    wait: dict[str, str],
) -> None:
    with talking(refuses(429, {"error": "Rate limit reached"}, **wait)) as talk:
        assert talk.reason() == "HTTP 429: Rate limit reached"
    assert len(talk.bodies) == 1


def test_a_server_that_stays_busy_has_failed() -> None:
    with talking(refuses(429, "", Retry_After="0")) as talk:
        assert talk.reason() == "HTTP 429 Too Many Requests"
    assert len(talk.bodies) == 5


def test_waiting_for_a_busy_server_ends_at_once_when_it_is_called_off() -> None:
    with talking(refuses(429, "", Retry_After="30"), THE_DESK) as talk:
        number = talk.model.chat(HELLO)
        until(lambda: talk.bodies, "the request")
        talk.model.cancel(number)
        assert talk.reply().text == "desk"
        assert not talk.inbox.awaits_anything


def test_a_server_that_is_not_there_has_failed() -> None:
    with serving(THE_DESK) as odd:
        pass
    model = Server(odd.url, inbox := Inbox())
    model.chat(HELLO)
    assert inbox.wait(PATIENCE_S)
    (event,) = inbox.take_all()
    model.close()
    assert event.result == Failed(f"{odd.url} cannot be reached: Connection refused")  # type: ignore[union-attr]


def test_a_server_that_does_not_speak_https_is_told() -> None:
    with serving(THE_DESK) as odd:
        model = Server(odd.url.replace("http", "https"), inbox := Inbox())
        model.chat(HELLO)
        assert inbox.wait(PATIENCE_S)
        (event,) = inbox.take_all()
        model.close()
    assert "it does not speak HTTPS; try http://" in event.result.reason  # type: ignore[union-attr]


def test_a_silent_server_fails_after_the_time_out() -> None:
    over = threading.Event()
    with talking(lambda *_: over.wait(PATIENCE_S), timeout_s=0.2) as talk:
        reason = talk.reason()
        over.set()
    assert "did not answer within 0.2 s" in reason


def test_a_cancelled_request_is_hung_up_on_and_the_next_is_served() -> None:
    hung_up = threading.Event()

    def talks_on(handler: Handler, body: dict[str, Any]) -> None:
        try:
            send(handler, word("on"))
            while True:
                handler.wfile.write(f"data: {json.dumps(word('and on'))}\n\n".encode())
                time.sleep(0.01)
        except OSError:
            hung_up.set()

    with talking(talks_on, THE_DESK) as talk:
        first = talk.model.chat(HELLO)
        until(lambda: talk.bodies, "the request")
        talk.model.cancel(first)
        assert hung_up.wait(PATIENCE_S)
        assert talk.reply().text == "desk"


def test_a_server_cannot_score_and_says_so() -> None:
    model = Server("http://127.0.0.1:1/v1", inbox := Inbox())
    assert not model.can_rank
    model.rank(RANK)
    (event,) = inbox.take_all()
    model.close()
    assert isinstance(event.result, Failed)  # type: ignore[union-attr]


def test_closing_in_the_middle_of_a_reply_ends_the_thread() -> None:
    over = threading.Event()
    with talking(lambda *_: over.wait(PATIENCE_S)) as talk:
        talk.model.chat(HELLO)
        talk.model.close()
        over.set()
    assert not [t for t in threading.enumerate() if t.name == "language model server"]


def test_a_stuck_thread_is_left_behind(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kb.llm.server.server.CLOSING_S", 0.05)
    over = threading.Event()
    model = Server("http://127.0.0.1:1/v1", Inbox())
    model._loop.call_soon_threadsafe(over.wait)
    model.close()
    assert model._thread.is_alive()
    assert model._thread.daemon
    over.set()
    model._thread.join()
    model.close()


def test_a_servers_tokens_are_estimated_rather_too_high() -> None:
    model = Server("http://127.0.0.1:1/v1", Inbox())
    assert model.count_tokens("dining_table, coffee_table") >= 8
    assert model.count_tokens("") == 0
    model.close()


@pytest.mark.parametrize(
    ("models", "warning"),
    [
        (refuses(401, "who are you?"), "HTTP 401: who are you?; set EXECUTIVE_LLM_API_KEY"),
        (("m",), ""),
    ],
)
def test_at_start_it_is_seen_whether_the_server_answers(
    models: object, warning: str, caplog: pytest.LogCaptureFixture
) -> None:
    with talking(THE_DESK, models=models) as talk:
        talk.model.prepare(HELLO)
        talk.model.prepare(HELLO)
        talk.ask()
    assert [r.getMessage() for r in caplog.records if r.levelno >= logging.WARNING] == (
        [f"the language model does not answer: {warning}"] if warning else []
    )


# --- whatever comes ---

_json = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3)
    | st.dictionaries(
        st.sampled_from(["error", "message", "detail", "loc", "msg", "param", "choices", "delta"]
                        + ["content", "usage", "prompt_tokens", "text", "finish_reason", "code"]),
        inner, max_size=4),
    max_leaves=12,
)  # fmt: skip


@given(st.integers(100, 599), st.binary(max_size=50) | _json.map(lambda v: json.dumps(v).encode()))
def test_whatever_a_refusal_says_it_is_one_short_line(status: int, body: bytes) -> None:
    line = str(refusal(status, {"Retry-After": body[:20].decode(errors="replace")}, body))
    assert line.isprintable() or "\N{NO-BREAK SPACE}" in line or not line.isascii()
    assert "\n" not in line
    assert len(line) < 250


@given(_json)
def test_whatever_an_object_holds_it_is_taken_in_or_refused(value: Any) -> None:
    got = wire.Written()
    try:
        got.add(value if isinstance(value, dict) else {"choices": [value]}, 1.0)
    except Refused:
        return
    assert isinstance(got.text, str)
    assert isinstance(got.finish_reason, str)


@given(st.text() | st.lists(st.sampled_from(["<think>", "</think>", "[/THINK]", "a"])).map("".join))
def test_whatever_is_thought_nothing_is_added_to_it(text: str) -> None:
    answer, thought = answer_of(text)
    assert len(answer) <= len(text)
    assert thought or answer == text


def test_a_chat_without_a_system_turn_says_the_same() -> None:
    chat = (Message("system", "A."), Message("user", "B"), Message("assistant", "C"))
    request = ChatRequest("x", chat)
    dialect = Dialect({}, 9, grammar=False)
    assert dialect.learns(Refused(400, "System role not supported"), dialect.body(request, "m"))
    assert dialect.body(request, "m")["messages"] == [
        {"role": "user", "content": "A.\n\nB"},
        {"role": "assistant", "content": "C"},
    ]
