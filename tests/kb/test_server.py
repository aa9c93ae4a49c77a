"""A real server process, llama_cpp.server, with the embedded model behind it."""

import io
import threading
from collections.abc import AsyncIterator, Iterator
from pathlib import Path
from typing import Any

import httpx2
import pytest
from llama_server import ALIAS, llama_server
from patience import PATIENCE_S

from executive.app.session import Session
from executive.config import load_settings
from executive.events import Ended, Inbox
from executive.types.llm import ChatRequest, Message
from executive.types.outcome import MissionStatus
from executive.types.results import Failed, Replied, Result
from kb.advice.lister import Lister
from kb.llm.options import ModelOptions
from kb.llm.server import asking
from kb.llm.server.server import Server
from kb.ontology.ontology import Ontology
from sim.home.home_file import load_home

pytestmark = pytest.mark.llm


@pytest.fixture(scope="module")
def url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    with llama_server(tmp_path_factory.mktemp("server") / "log") as server:
        yield server.url


def lister(model: Server) -> Lister:
    return Lister(Ontology(load_home("four_rooms").places()), model, remembers=True)


def answer(model: Server, inbox: Inbox, *among: str) -> Result:
    request = model.chat(lister(model).inquiry("mug", among))
    assert inbox.wait(PATIENCE_S)
    [event] = inbox.take_all()
    assert isinstance(event, Ended)
    assert event.request == request
    return event.result


def test_a_real_server_replies_and_says_who_it_is(url: str) -> None:
    inbox = Inbox()
    model = Server(url, inbox, ModelOptions(max_tokens=24))
    result = answer(model, inbox)
    model.close()
    assert isinstance(result, Replied)
    assert result.text
    assert result.usage.model == ALIAS
    assert 0 < result.usage.output_tokens <= 24
    assert 0 < result.usage.first_token_s < result.usage.total_s


def test_a_real_server_is_held_to_the_schema(url: str) -> None:
    inbox = Inbox()
    model = Server(url, inbox, ModelOptions(max_tokens=100, grammar=True))
    result = answer(model, inbox, "desk", "sofa")
    asks = lister(model)
    model.close()
    assert isinstance(result, Replied)
    names = asks.read(result.text)
    assert names
    assert set(names) <= {"desk", "sofa"}


def test_a_real_server_that_is_hung_up_on_answers_the_next(url: str) -> None:
    inbox = Inbox()
    model = Server(url, inbox, ModelOptions(max_tokens=8))
    model.cancel(model.chat(lister(model).inquiry("apple", ())))
    result = answer(model, inbox)
    model.close()
    assert isinstance(result, Replied)


def test_a_prompt_that_is_too_long_for_a_real_server_fails_in_words(url: str) -> None:
    inbox = Inbox()
    model = Server(url, inbox)
    model.chat(ChatRequest("long", (Message("user", "word " * 6000),)))
    assert inbox.wait(PATIENCE_S)
    [event] = inbox.take_all()
    model.close()
    assert isinstance(event, Ended)
    assert isinstance(event.result, Failed)
    assert url in event.result.reason


def test_a_mission_is_done_with_a_real_server(url: str, tmp_path: Path) -> None:
    settings = load_settings(
        llm=url, grammar=True, defaults=False, world="fake", user="oracle", runs=tmp_path
    )
    session = Session(settings, out=io.StringIO())
    outcome = session.run("Find an apple.")
    session.close()
    assert outcome.status == MissionStatus.DONE
    assert outcome.llm_calls >= 1


def test_a_real_server_that_dies_in_the_middle_of_its_reply_fails_in_words(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun, objects = threading.Event(), asking.objects

    async def noted(response: httpx2.Response) -> AsyncIterator[dict[str, Any]]:
        async for chunk in objects(response):
            yield chunk
            if chunk["choices"][0]["delta"].get("content"):
                begun.set()

    monkeypatch.setattr(asking, "objects", noted)
    inbox = Inbox()
    with llama_server(tmp_path / "log") as dying:
        model = Server(dying.url, inbox, ModelOptions(max_tokens=2000, temperature=0))
        model.chat(ChatRequest("count", (Message("user", "Count to 500, as 1, 2, 3, ..."),)))
        assert begun.wait(PATIENCE_S)
        assert not inbox.has_events, "the reply was too short for this test"
        dying.process.kill()
    assert inbox.wait(PATIENCE_S)
    [event] = inbox.take_all()
    model.close()
    assert isinstance(event, Ended)
    assert event.result == Failed(f"{dying.url} broke off in the middle of its reply")
