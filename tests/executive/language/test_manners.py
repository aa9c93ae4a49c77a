"""What is said for the sake of manners, and other ways to say what the grammar knows."""

import pytest

from executive.language.grammar import EnglishInterpreter
from executive.language.meaning import About, Choice, Courtesy, Question, Refusal, Request
from executive.language.spoken import Spoken

read = EnglishInterpreter()


@pytest.mark.parametrize(
    "words",
    [
        "could you be so kind as to bring me the banana",
        "Be a dear and bring me the banana",
        "Could you be a star and bring me the banana",
        "I'd be ever so grateful if you could bring me the banana",
        "Sorry to bother you, but could you bring me the banana",
        "Sorry for disturbing you, bring me the banana",
        "hey robot would you mind bringing me the banana",
        "Would you be able to bring me the banana, please?",
        "um can you uh get me the uh banana",
        "i would really love the banana right now",
        "I was wondering if you could bring me the banana",
        "It would be great if you could bring me the banana.",
        "Do me a favour and bring me the banana",
        "Bring me the banana if you don't mind",
        "Bring me the banana when you have a minute",
        "bring me the banana asap",
        "So, bring me the banana or something",
        "Don't forget to bring me the banana",
        "Would you mind getting me the banana?",
        "would you mind grabbing me the banana",
        "lemme have the banana",
        "Can't you bring me the banana?",
        "Couldn't you please bring me the banana",
        "Won't you bring the banana?",
        "Why don't you just bring me the banana?",
        "Bring me the banana, won't you?",
    ],
)
def test_manners_and_hesitation_change_nothing(words: str) -> None:
    command = read.command(words)
    assert command
    assert (command.kind, command.target) == ("bring", "banana")


@pytest.mark.parametrize(
    ("words", "same"),
    [
        ("where did i leave my drill", "Where is my drill?"),
        ("where's the mug at", "Where is the mug?"),
        ("Where has the mug gone?", "Where is the mug?"),
        ("Where could the mug be?", "Where is the mug?"),
        ("whats in the kitchen", "What is in the kitchen?"),
        ("Is the fridge empty?", "What is at the fridge?"),
        ("Are you able to lift a hammer?", "Lift a hammer"),
        ("Put the mug where it belongs", "Put the mug back"),
        ("When you find the mug, bring it", "If you find the mug, bring it"),
        ("Take the mug only if it is on the desk", "Take the mug if it is on the desk"),
        ("Go to the desk and wait there", "Go to the desk"),
        ("Bring me the mug that is on the desk", "Bring me the mug on the desk"),
        ("Find the mug which is in the kitchen", "Find the mug in the kitchen"),
    ],
)
def test_other_ways_to_say_it_mean_the_same(words: str, same: str) -> None:
    assert read.read(words) == read.read(same)


def test_who_says_do_not_in_many_words_is_not_obeyed_as_if_they_asked() -> None:
    for words in ("um, please do not bring it", "so don't bring the mug", "hey, don't take it"):
        assert isinstance(read.read(words), Refusal)


@pytest.mark.parametrize(
    "words",
    [
        "Can't you not bring the apple",
        "Don't you bring the apple",
        "You can't bring the apple",
        "Why don't you leave the apple",
        "Can't you leave the apple on the desk?",
        "Why don't you not bring the apple",
        "Can you not bring the apple",
        "Don't bring the apple, won't you",
        "Don't forget not to bring the apple",
        "Don't forget that I told you to leave the apple",
        "Don't forget the apple must stay",
        "Never mind the apple",
    ],
)
def test_a_negation_beside_that_of_manners_is_one(words: str) -> None:
    assert read.commands(words) == read.without_slips(words) == ()


@pytest.mark.parametrize("words", ["Don't forget the mug", "Do not forget about the mug, please"])
def test_what_is_not_to_be_forgotten_is_a_thing_without_a_verb(words: str) -> None:
    assert read.read(words) == read.read("the mug")
    [[command]] = read.without_slips(words)
    assert (command.kind, command.target) == ("bring", "mug")


def test_what_is_to_be_done_later_may_follow_what_is_under_way() -> None:
    said = read.read("Bring the mug later")
    assert isinstance(said, Request)
    assert said.later


@pytest.mark.parametrize("when", ["Later,", "When I am back,", "Tomorrow"])
def test_a_set_time_may_come_first(when: str) -> None:
    assert read.command(f"{when} bring me the mug") is None
    assert "set time" in read.remark(f"{when} bring me the mug")


def test_a_thing_to_do_at_a_place_is_not_passed_over() -> None:
    assert read.command("Go to the desk and dance there") is None


@pytest.mark.parametrize(
    "when",
    [
        "in ten minutes",
        "tomorrow",
        "at 5 o'clock",
        "at 5pm",
        "every day",
        "before lunch",
        "tonight",
        "later",
        "later on",
        "in a while",
        "when I am back",
        "once we get home",
        "after my meeting",
    ],
)
def test_what_is_to_be_done_at_a_set_time_is_not_done_at_once(when: str) -> None:
    assert read.command(f"Bring me the mug {when}") is None
    assert "set time" in read.remark(f"Bring me the mug {when}")


@pytest.mark.parametrize(
    ("words", "about"),
    [
        ("What is a spatula?", About.KNOWN),
        ("what colour is the mug", About.KNOWN),
        ("is the mug red or green", About.KNOWN),
        ("are the scissors clean or dirty", About.KNOWN),
        ("What is the hammer for?", About.KNOWN),
        ("Where do you keep the mugs?", About.KNOWN),
        ("Where does the mug belong?", About.KNOWN),
        ("Which fruits do you know?", About.KNOWN),
        ("Tell me about the mug", About.KNOWN),
        ("Where are you?", About.WHERE),
        ("Are you busy?", About.DOING),
    ],
)
def test_questions_that_need_no_looking(words: str, about: About) -> None:
    said = read.read(words)
    assert isinstance(said, Question)
    assert said.about == about


@pytest.mark.parametrize("words", ["I don't care", "I don't mind", "whatever you like", "any"])
def test_who_does_not_mind_declines_nothing(words: str) -> None:
    assert not read.declines(words)
    assert getattr(read.read(words), "choice", None) == Choice.ANY


@pytest.mark.parametrize("words", ["thanks a lot mate", "cheers", "good job", "thank you so much"])
def test_thanks_are_thanks(words: str) -> None:
    assert read.read(words) == Courtesy.THANKS


@pytest.mark.parametrize(
    "words",
    [
        "Bring all tools but one",
        "Bring me 0 apples",
    ],
)
def test_how_many_are_left_out_is_not_passed_over(words: str) -> None:
    assert read.command(words) is None


@pytest.mark.parametrize(
    "words",
    [
        "how about bringing me a banana",
        "any chance of a banana",
        "Why don't you bring me a banana?",
        'bring me a "banana"',
        "🙏 bring me a banana",
        "bring only a banana",
        "i'll have a banana",
    ],
)
def test_wishes_in_other_words_are_wishes(words: str) -> None:
    command = read.command(words)
    assert command
    assert (command.kind, command.target) == ("bring", "banana")


def test_as_well_as_is_and() -> None:
    words = "Bring the apple as well as the pear"
    assert read.read(words) == read.read("Bring the apple and the pear")


@pytest.mark.parametrize(
    "words",
    [
        "Mind fetching me the mug?",
        "I was hoping you could bring me the mug",
        "Would it be too much to ask for the mug?",
        "How about you bring the mug?",
        "A mug would be nice",
        "Alexa, bring me the mug",
        "Bring me that mug",
        "Bring the mug, wherever it is",
    ],
)
def test_an_indirect_wish_is_one(words: str) -> None:
    [[command]] = read.commands(words)
    assert (command.kind, command.target) == ("bring", "mug")


@pytest.mark.parametrize(
    "words",
    [
        "Can you carry two things at once?",
        "Can you lift heavy things?",
        "Are you able to find things?",
    ],
)
def test_what_it_can_do_is_asked_and_not_commanded(words: str) -> None:
    assert read.commands(words) == ()
    assert read.talk(words).startswith("I can find")


@pytest.mark.parametrize("words", ["Have you got the mug?", "Do you have my mug?"])
def test_whether_it_has_a_certain_thing_is_a_question(words: str) -> None:
    assert read.commands(words) == ()
    assert read.read(words) == Question(About.HAND)


@pytest.mark.parametrize("this", ["this", "that", "these", "those"])
def test_a_thing_that_is_pointed_to_is_named_all_the_same(this: str) -> None:
    [[named]] = read.commands(f"Put {this} red mugs on the desk")
    assert (named.target, named.goal) == ("red mugs", "desk")
    [[other]] = read.commands(f"Put {this} on the desk", Spoken(("pear",)))
    assert (other.target, other.goal) == ("pear", "desk")
