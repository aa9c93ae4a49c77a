"""What was said and done before counts for what is said next; each mission replays as recorded."""

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from talking import session_in, session_of, told

from executive.app.session import Session
from executive.replay.replaying import replay
from executive.types.goals import DriveTo
from executive.types.home import DELIVERY
from executive.types.outcome import MissionStatus, Outcome

Talk = Callable[..., Session]


@pytest.fixture
def talk(tmp_path: Path) -> Iterator[Talk]:
    """Makes a session of a robot that knows where the mug is, and says all the words but the last.

    Whatever is recorded has to replay.
    """
    sessions: list[Session] = []

    def make(*words: str, answers: tuple[str, ...] = ()) -> Session:
        session, _ = session_in(tmp_path / str(len(sessions)), answers)
        sessions.append(session)
        session.run("The mug is on the coffee table")
        for said in words:
            session.run(said)
        return session

    yield make
    for session in sessions:
        session.close()
        runs = session.settings.runs
        for run in runs.iterdir() if runs.exists() else ():
            assert replay(run).parting is None


def done(outcome: Outcome) -> tuple[str, str | None, str | None]:
    assert outcome.status == MissionStatus.DONE, outcome.reason
    return outcome.kind or "", outcome.object, outcome.location


def test_it_is_what_was_found_before(talk: Talk) -> None:
    assert done(talk("Find the mug").run("Bring it")) == ("bring", "mug", "coffee_table")


@pytest.mark.parametrize(
    ("words", "where"),
    [
        ("Go to the sofa", "I am at the sofa in the living room."),
        ("Bring the mug", "I am at the delivery table."),
        ("Come here", "I am with you."),
    ],
)
def test_it_says_where_it_came_to(talk: Talk, words: str, where: str) -> None:
    assert talk(words, "Throw the ball").run("Where are you?").reason.startswith(where)


def test_there_is_where_something_was_put(talk: Talk) -> None:
    session = talk("Put the hammer on the sofa")
    assert session.run("Put the mug there").goals == ("sofa",)


def test_again_is_the_same_deed(talk: Talk) -> None:
    session = talk("Find the mug", "Bring it")
    assert done(session.run("Do it again")) == ("bring", "mug", DELIVERY)


def test_another_is_of_the_same_kind_and_not_the_one_before(talk: Talk) -> None:
    session = talk("Find a fruit", answers=("the second one", "I don't know"))
    session.run("Bring another one")
    asked = [text for text in told(session) if "Which fruit" in text]
    assert "banana" in asked[0]
    assert "banana" not in asked[1]


def test_what_there_is_no_other_of_is_said(talk: Talk) -> None:
    outcome = talk("Find the mug").run("Take the other one")
    assert outcome.reason.startswith("I know no other mug")


@pytest.mark.parametrize(
    ("before", "words", "said"),
    [
        ("Find the mug and the pear", "Bring both of them", ["the mug", "the pear"]),
        ("Find the mug and the pear", "Bring the second one", ["the pear"]),
        ("Where are the fruits?", "Bring two of them", ["both"]),
        ("What is on the coffee table?", "Bring them both to me", ["the mug", "the pudding box"]),
        ("How many fruits are on the dining table?", "Bring me one of them", ["the apple"]),
        ("How many fruits are on the dining table?", "Bring me one", ["the apple"]),
    ],
)
def test_they_are_all_that_was_spoken_of(
    talk: Talk, before: str, words: str, said: list[str]
) -> None:
    outcome = talk(before).run(words)
    assert outcome.status == MissionStatus.DONE
    assert [text for text in said if text in outcome.reason] == said


def test_more_of_them_than_there_are_is_told(talk: Talk) -> None:
    outcome = talk("Find the mug").run("Bring two of them")
    assert outcome.reason == "I brought one of two: the mug; I know of no more."


def test_it_looks_around_everywhere(talk: Talk) -> None:
    outcome = talk().run("Have a look around")
    assert (outcome.status, len(outcome.visited)) == (MissionStatus.DONE, 13)


@pytest.mark.parametrize("words", ["Go", "Put the mug"])
def test_nothing_is_between_furniture(talk: Talk, words: str) -> None:
    session = talk(answers=("On the sofa",))
    session.run(f"{words} between the sofa and the desk")
    [asked] = [text for text in told(session) if text.endswith("?")]
    assert "but not 'between the sofa and the desk'. Where shall I" in asked


def test_a_thing_is_looked_for_where_the_person_said_it_is(talk: Talk) -> None:
    session = talk()
    assert session.run("The hammer is on the sofa").reason == (
        "Thank you: I remember that the hammer is on the sofa."
    )
    assert session.run("Find it").visited[0] == "sofa"


def test_where_it_is_may_be_said_after_a_search_in_vain(talk: Talk) -> None:
    session = talk("Find the mustard_bottle")
    assert session.run("It is on the desk").status == MissionStatus.DONE
    assert session.run("Find it").visited[0] == "desk"


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        ("The dragon is on the sofa", "I know no 'dragon'."),
        ("The mug is on the moon", "I know no place 'moon', so I cannot remember that."),
        ("The fruit is on the sofa", "'fruit' may be the apple"),
        ("The mug is under the sofa", "I can remember what is on furniture, or in it"),
    ],
)
def test_what_cannot_be_remembered_is_said(talk: Talk, words: str, answer: str) -> None:
    assert talk().run(words).reason.startswith(answer)


@pytest.mark.parametrize(
    ("before", "question", "answer"),
    [
        ("Take the mug", "What do you hold?", "I hold the mug."),
        ("Find the mug", "What do you hold?", "My hand is empty."),
        ("Take the mug", "Where did you put it?", "I hold the mug."),
        (
            "Bring the mug",
            "Where did you find it?",
            "I took the mug from the coffee table in the living room.",
        ),
        ("Find the mug", "Where was it?", "As far as I know, the mug is on the coffee table."),
        ("Find the mug", "Did you find it?", "The mug is on the coffee table in the living room."),
        ("Find the mug", "What did I ask you to do?", "You said: 'Find the mug'."),
        (
            "Find the mug",
            "What do you remember?",
            "As far as I know, the mug is on the coffee table and the pudding box is on the coffee"
            " table.",
        ),
        (
            "Find the mug",
            "How many rooms are there?",
            "I know the kitchen, the living room, the bedroom and the lobby.",
        ),
        (
            "Bring the mug",
            "Where did you put it?",
            "As far as I know, the mug is on the delivery table.",
        ),
        (
            "Find the hammer",
            "Why did you go there?",
            "I went to the shelf in the lobby to look there: that is its place.",
        ),
        ("Find the hammer", "Why did you go to the kitchen?", "I was not there."),
        ("Find the mug", "What are you doing?", "Nothing: I wait for what you say."),
    ],
)
def test_answers_questions_about_itself_without_a_mission(
    talk: Talk, before: str, question: str, answer: str
) -> None:
    session = talk(before)
    runs = os.listdir(session.settings.runs)
    assert (session.run(question).reason, told(session)[-1]) == (answer, answer)
    assert os.listdir(session.settings.runs) == runs


def test_a_reason_that_is_asked_for_is_a_sentence(tmp_path: Path) -> None:
    with session_of(tmp_path) as session:
        blocked = lambda goal: "the way is blocked" if goal == DriveTo("person") else None  # noqa: E731
        session.world.fault = blocked  # type: ignore[attr-defined]
        session.run("Find the mug")
        assert session.run("What did you do?").reason == (
            "The mug is on the coffee table in the living room, but the way is blocked."
        )


@pytest.mark.parametrize(
    ("command", "place", "answer"),
    [
        ("Put the mug on the sofa", "sofa", "I put the mug on the sofa."),
        ("Go to the sofa", "sofa", "I am at the sofa."),
        ("Find the hammer, then find the mug", "shelf in the lobby", "1. The hammer is"),
    ],
)
def test_it_does_not_deny_where_it_was(
    command: str, place: str, answer: str, tmp_path: Path
) -> None:
    with session_of(tmp_path) as session:
        session.run(command)
        assert session.run(f"Why did you go to the {place}?").reason.startswith(answer)


def test_who_named_a_place_is_not_made_up(tmp_path: Path) -> None:
    with session_of(tmp_path, place={"mug": "sofa"}) as session:
        session.run("Find the mug")
        assert "it may be anywhere" in session.run("Why did you go to the sofa?").reason
