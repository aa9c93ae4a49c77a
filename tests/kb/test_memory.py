"""How much of the dialogue the language model is reminded of."""

from hypothesis import given
from hypothesis import strategies as st

from executive.events import Inbox
from executive.testing.bench import ontology
from executive.types.llm import Message
from kb.advice.history import DialogueHistory, history_budget
from kb.advice.lister import Lister
from kb.llm.scripted import Scripted


def words(text: str) -> int:
    return len(text.split())


def lister(remembers: bool, context_tokens: int = 4096) -> Lister:
    model = Scripted([], Inbox(), context_tokens=context_tokens)
    return Lister(ontology(True), model, remembers=remembers)


def test_the_budget_is_the_papers():
    assert history_budget(context_tokens=4096, system_tokens=448) == 1280


def test_a_system_prompt_that_fills_half_the_window_leaves_no_memory():
    assert history_budget(context_tokens=512, system_tokens=400) == 0


def test_the_oldest_exchange_is_forgotten_first_and_as_a_whole():
    memory = DialogueHistory(6, words)
    memory.add("a b", "c")
    memory.add("d", "e f")
    memory.add("g", "h i")
    assert memory.messages() == (
        Message("user", "d"),
        Message("assistant", "e f"),
        Message("user", "g"),
        Message("assistant", "h i"),
    )


@given(st.integers(0, 30), st.lists(st.tuples(st.text("a "), st.text("b "))))
def test_the_history_keeps_to_the_budget_and_to_whole_exchanges(budget, exchanges):
    memory = DialogueHistory(budget, words)
    for inquiry, reply in exchanges:
        memory.add(inquiry, reply)
    turns = memory.messages()
    assert sum(words(turn.content) for turn in turns) == memory.tokens <= budget
    assert [turn.role for turn in turns] == ["user", "assistant"] * (len(turns) // 2)
    latest = [turn for inquiry, reply in exchanges for turn in (inquiry, reply)]
    assert [turn.content for turn in turns] == latest[len(latest) - len(turns) :]


def test_with_a_memory_the_next_prompt_holds_the_exchange():
    asks = lister(remembers=True)
    first = asks.inquiry("mug", ())
    asks.remember(first, "a reply")
    second = asks.inquiry("hammer", ())
    assert second.messages[:3] == (*first.messages, Message("assistant", "a reply"))


def test_without_a_memory_it_does_not():
    asks = lister(remembers=False)
    asks.remember(asks.inquiry("mug", ()), "a reply")
    assert [m.role for m in asks.inquiry("hammer", ()).messages] == ["system", "user"]


def test_a_small_context_window_forgets_sooner():
    small, large = lister(True, context_tokens=512), lister(True, context_tokens=4096)
    for asks in (small, large):
        for _ in range(9):
            asks.remember(asks.inquiry("mug", ()), "word " * 20)
    assert len(small.inquiry("mug", ()).messages) < len(large.inquiry("mug", ()).messages) == 20
