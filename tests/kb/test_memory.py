"""How much of the dialogue the language model is reminded of."""

from hypothesis import given
from hypothesis import strategies as st

from executive.events import Inbox
from executive.testing.bench import ontology
from executive.types import Message
from kb.advice.advisor import PlaceAdvisor
from kb.advice.history import DialogueHistory, history_budget
from kb.llm.scripted import Scripted


def words(text: str) -> int:
    return len(text.split())


def advisor(remembers: bool, context_tokens: int = 4096) -> PlaceAdvisor:
    model = Scripted([], Inbox(), context_tokens=context_tokens)
    return PlaceAdvisor(ontology(True), model, remembers=remembers)


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
    adviser = advisor(remembers=True)
    first = adviser.inquiry("mug", ())
    adviser.remember(first, "a reply")
    second = adviser.inquiry("hammer", ())
    assert second.messages[:3] == (*first.messages, Message("assistant", "a reply"))


def test_without_a_memory_it_does_not():
    adviser = advisor(remembers=False)
    adviser.remember(adviser.inquiry("mug", ()), "a reply")
    assert [m.role for m in adviser.inquiry("hammer", ()).messages] == ["system", "user"]


def test_a_small_context_window_forgets_sooner():
    small, large = advisor(True, context_tokens=512), advisor(True, context_tokens=4096)
    for adviser in (small, large):
        for _ in range(9):
            adviser.remember(adviser.inquiry("mug", ()), "word " * 20)
    assert len(small.inquiry("mug", ()).messages) < len(large.inquiry("mug", ()).messages) == 20
