"""The contract of every LanguageModel. An adapter's tests subclass `LanguageModelContract`.

Provide a fixture `model_bench` that yields a fresh `ModelBench`, and closes the model afterwards.
"""

from dataclasses import dataclass

import numpy as np

from executive.events import Ended, Inbox
from executive.interfaces.llm import LanguageModel
from executive.testing.contracts.requests import PATIENCE_S, end_of, is_silent, next_event
from executive.types.llm import ChatRequest, Message, RankRequest
from executive.types.results import Failed, Replied, Scored

SYSTEM = Message("system", "You know a home. Answer in a few words.")
CHAT = ChatRequest("general_pos", (SYSTEM, Message("user", "Where is the mug?")))
RANK = RankRequest(
    "rank",
    (SYSTEM, Message("user", "Where is the milk?")),
    (SYSTEM, Message("user", "Where is the thing?")),
    ("in the refrigerator", "on the bed", "in the garage"),
    ("refrigerator", "bed", "garage"),
)


@dataclass
class ModelBench:
    """A working model, and the inbox where its requests end."""

    model: LanguageModel
    inbox: Inbox


class LanguageModelContract:
    """Each method tests one requirement of `LanguageModel`."""

    def test_it_has_a_name_and_a_window(self, model_bench: ModelBench) -> None:
        assert model_bench.model.name
        assert model_bench.model.context_tokens > 0

    def test_it_replies_and_says_what_it_cost(self, model_bench: ModelBench) -> None:
        result = end_of(model_bench.inbox, model_bench.model.chat(CHAT))
        assert isinstance(result, Replied)
        assert result.request == CHAT
        assert result.text
        assert result.usage.model
        assert result.usage.output_tokens > 0
        assert 0.0 <= result.usage.first_token_s <= result.usage.total_s

    def test_what_is_asked_at_once_is_all_answered_and_once(self, model_bench: ModelBench) -> None:
        asked = {model_bench.model.chat(CHAT) for _ in range(3)}
        ended: list[int] = []
        while len(ended) < 3 and model_bench.inbox.wait(PATIENCE_S):
            ended += [e.request for e in model_bench.inbox.take_all() if isinstance(e, Ended)]
        assert sorted(ended) == sorted(asked)
        assert is_silent(model_bench.inbox)

    def test_it_scores_every_option_or_says_that_it_cannot(self, model_bench: ModelBench) -> None:
        result = end_of(model_bench.inbox, model_bench.model.rank(RANK))
        if not model_bench.model.can_rank:
            assert isinstance(result, Failed)
            assert result.reason
            return
        assert isinstance(result, Scored)
        assert result.request == RANK
        assert len(result.scores) == len(RANK.options)
        assert np.isfinite(result.scores).all()

    def test_the_reply_to_a_cancelled_request_is_not_delivered(
        self, model_bench: ModelBench
    ) -> None:
        model_bench.model.cancel(model_bench.model.chat(CHAT))
        assert is_silent(model_bench.inbox)

    def test_after_a_cancelled_request_it_replies_on(self, model_bench: ModelBench) -> None:
        model_bench.model.cancel(model_bench.model.chat(CHAT))
        assert isinstance(end_of(model_bench.inbox, model_bench.model.chat(CHAT)), Replied)

    def test_cancelling_what_has_ended_or_never_was_does_nothing(
        self, model_bench: ModelBench
    ) -> None:
        request = model_bench.model.chat(CHAT)
        end_of(model_bench.inbox, request)
        model_bench.model.cancel(request)
        model_bench.model.cancel(request + 1000)
        assert isinstance(end_of(model_bench.inbox, model_bench.model.chat(CHAT)), Replied)

    def test_to_prepare_is_no_request(self, model_bench: ModelBench) -> None:
        model_bench.model.prepare(CHAT)
        if model_bench.model.can_rank:
            model_bench.model.prepare(RANK)
        assert is_silent(model_bench.inbox)
        assert isinstance(end_of(model_bench.inbox, model_bench.model.chat(CHAT)), Replied)

    def test_longer_texts_have_more_tokens(self, model_bench: ModelBench) -> None:
        counts = [model_bench.model.count_tokens("the mug " * times) for times in (0, 1, 50)]
        assert 0 <= counts[0] < counts[1] < counts[2]

    def test_closing_ends_what_is_under_way(self, model_bench: ModelBench) -> None:
        model_bench.model.chat(CHAT)
        model_bench.model.close()
        event = next_event(model_bench.inbox, 0.0)
        assert event is None or isinstance(event, Ended)
