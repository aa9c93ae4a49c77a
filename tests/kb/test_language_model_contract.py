"""Every language model keeps the contract: a script, a server, llama.cpp in this process."""

from collections.abc import Iterator

import pytest
from llama_server import llama_server
from odd_server import says, serving

from executive.events import Inbox
from executive.testing.contracts.language_model import LanguageModelContract, ModelBench
from executive.types.llm import ChatRequest, RankRequest
from kb.llm.llama import LlamaCpp, embedded_model
from kb.llm.options import ModelOptions
from kb.llm.scripted import Scripted
from kb.llm.server.server import Server


class Obliging(Scripted):
    """A script that has a reply to whatever it is asked."""

    def __init__(self, inbox: Inbox) -> None:
        super().__init__([], inbox)

    def chat(self, request: ChatRequest) -> int:
        self._replies.append("on the desk")
        return super().chat(request)

    def rank(self, request: RankRequest) -> int:
        self._replies.append([-1.0] * len(request.options))
        return super().rank(request)


class TestScripted(LanguageModelContract):
    @pytest.fixture
    def model_bench(self) -> ModelBench:
        inbox = Inbox()
        return ModelBench(Obliging(inbox), inbox)


class TestServer(LanguageModelContract):
    @pytest.fixture
    def model_bench(self) -> Iterator[ModelBench]:
        with serving(says("on ", "the desk")) as odd:
            model = Server(odd.url, inbox := Inbox())
            yield ModelBench(model, inbox)
            model.close()


@pytest.fixture(scope="module")
def url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    with llama_server(tmp_path_factory.mktemp("server") / "log") as server:
        yield server.url


@pytest.mark.llm
class TestRealServer(LanguageModelContract):
    @pytest.fixture
    def model_bench(self, url: str) -> Iterator[ModelBench]:
        model = Server(url, inbox := Inbox(), ModelOptions(max_tokens=8))
        yield ModelBench(model, inbox)
        model.close()


@pytest.mark.llm
class TestLlamaCpp(LanguageModelContract):
    @pytest.fixture
    def model_bench(self) -> Iterator[ModelBench]:
        model = LlamaCpp(embedded_model(), inbox := Inbox(), ModelOptions(max_tokens=8))
        yield ModelBench(model, inbox)
        model.close()
