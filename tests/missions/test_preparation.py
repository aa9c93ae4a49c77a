"""What the model works out before it is asked, so that the first answer comes sooner."""

import io
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from patience import PATIENCE_S, until

from executive.app.session import Session
from executive.config import load_settings
from executive.events import Ended, Inbox
from executive.testing.bench import ontology
from executive.types.llm import ChatRequest, Message, RankRequest, Usage
from executive.types.results import Replied, Scored
from kb.advice.lister import Lister
from kb.advice.ranker import Ranker
from kb.llm.context import Context
from kb.llm.llama import LlamaCpp, embedded_model
from kb.llm.options import ModelOptions
from kb.llm.scripted import Scripted


class Preparing(Scripted):
    """Keeps what it is to prepare for."""

    def __init__(self, inbox: Inbox) -> None:
        super().__init__([], inbox)
        self.prepared: list[ChatRequest | RankRequest] = []

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        self.prepared.append(request)


@pytest.mark.parametrize(("elicit", "kind"), [("rank", RankRequest), ("generate", ChatRequest)])
def test_the_model_prepares_as_soon_as_a_session_begins(tmp_path: Path, elicit, kind):
    model = Preparing(inbox := Inbox())
    settings = load_settings(world="fake", user="none", elicit=elicit, runs=tmp_path)
    session = Session(settings, inbox=inbox, model=model, out=io.StringIO())
    session.close()
    [request] = model.prepared
    assert isinstance(request, kind)
    assert not inbox.awaits_anything


def test_it_prepares_for_every_place_and_all_things_that_are_known(tmp_path: Path):
    model = Preparing(inbox := Inbox())
    settings = load_settings(world="fake", user="none", elicit="rank", runs=tmp_path)
    session = Session(settings, inbox=inbox, model=model, out=io.StringIO())
    asked = session.parts.advice.ranker.ranking("hammer", ())
    session.close()
    [request] = model.prepared
    assert (request.neutral, request.options) == (asked.neutral, asked.options)
    assert set(request.precedents) > set(asked.precedents)


@pytest.fixture
def no_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is kept for other processes."""
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))


@pytest.fixture
def fresh(no_cache: None) -> Iterator[tuple[LlamaCpp, Inbox]]:
    model = LlamaCpp(
        embedded_model(), inbox := Inbox(), ModelOptions(context_tokens=1024, max_tokens=8)
    )
    yield model, inbox
    model.close()


def end_of(inbox: Inbox, request: int) -> Replied | Scored:
    assert inbox.wait(PATIENCE_S)
    [event] = inbox.take_all()
    assert isinstance(event, Ended)
    assert event.request == request
    assert isinstance(event.result, Replied | Scored)
    return event.result


def prepare(model: LlamaCpp, request: ChatRequest | RankRequest, caplog) -> None:
    """To its end."""
    caplog.set_level("INFO", logger="kb.llm.llama")
    model.prepare(request)
    until(lambda: "ahead" in caplog.text, "what is prepared")


def whole(usage: Usage) -> int:
    return usage.evaluated_tokens + usage.prepared_tokens


@pytest.mark.llm
def test_what_was_prepared_is_not_evaluated_again_and_changes_no_score(fresh, caplog):
    model, inbox = fresh
    ranker = Ranker(ontology(True))
    prepare(model, ranker.ranking("thing", ()), caplog)
    assert not inbox.awaits_anything
    assert not inbox.has_events
    first = end_of(inbox, model.rank(ranker.ranking("hammer", ())))
    later = end_of(inbox, model.rank(ranker.ranking("mug", ())))
    assert first.usage.evaluated_tokens < 70 < 300 < first.usage.prepared_tokens
    assert first.usage.prepared_s > 0
    assert (later.usage.prepared_tokens, later.usage.prepared_s) == (0, 0.0)
    unprepared = LlamaCpp(embedded_model(), inbox := Inbox(), ModelOptions(context_tokens=1024))
    cold = end_of(inbox, unprepared.rank(ranker.ranking("hammer", ())))
    unprepared.close()
    assert cold.scores == first.scores
    assert cold.usage.prepared_tokens == 0 < cold.usage.evaluated_tokens <= whole(first.usage)
    assert cold.usage.input_tokens == first.usage.input_tokens


@pytest.mark.llm
def test_what_all_prompts_begin_with_is_prepared_for_writing(fresh, caplog):
    model, inbox = fresh
    lister = Lister(ontology(True), model, remembers=False)
    prepare(model, lister.inquiry("thing", ()), caplog)
    first = end_of(inbox, model.chat(lister.inquiry("hammer", ()))).usage
    assert first.evaluated_tokens < 40 < 300 < first.prepared_tokens
    assert whole(first) == first.input_tokens


@pytest.mark.llm
def test_a_request_takes_over_after_one_batch_what_was_prepared(fresh, monkeypatch):
    model, inbox = fresh
    ranker, requests = Ranker(ontology(True)), []
    read = Context._decode

    def read_and_ask(context: Context, rows) -> None:
        read(context, rows)
        if not requests:
            requests.append(model.rank(ranker.ranking("hammer", ())))

    monkeypatch.setattr(Context, "_decode", read_and_ask)
    model.prepare(ranker.ranking("thing", ()))
    until(lambda: requests, "the request")
    usage = end_of(inbox, requests[0]).usage
    assert 0 < usage.prepared_tokens <= 128
    monkeypatch.setattr(Context, "_decode", read)
    unprepared = LlamaCpp(embedded_model(), inbox := Inbox(), ModelOptions(context_tokens=1024))
    cold = end_of(inbox, unprepared.rank(ranker.ranking("hammer", ()))).usage
    unprepared.close()
    assert whole(usage) == cold.evaluated_tokens


@pytest.mark.llm
def test_what_cannot_be_prepared_fails_when_it_is_asked_for(fresh):
    model, inbox = fresh
    request = ChatRequest("long", (Message("system", "word " * 2000), Message("user", "Hello")))
    model.prepare(request)
    number = model.chat(request)
    assert inbox.wait(PATIENCE_S)
    [event] = inbox.take_all()
    assert event.request == number
    assert "but the context window has 1024" in event.result.reason


@pytest.mark.llm
def test_closing_while_it_prepares_ends_the_models_thread(no_cache, monkeypatch):
    batches, read = [], Context._decode
    monkeypatch.setattr(Context, "_decode", lambda *given: batches.append(read(*given)) or None)
    before = set(threading.enumerate())
    model = LlamaCpp(embedded_model(), Inbox(), ModelOptions(context_tokens=1024))
    model.prepare(Ranker(ontology(True)).ranking("thing", ()))
    until(lambda: batches, "the preparation")
    by_then = len(batches)
    model.close()
    assert len(batches) <= by_then + 2
    assert not set(threading.enumerate()) - before
