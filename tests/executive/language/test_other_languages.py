"""Words of languages that the robot does not speak: it says so, and a negation denies in any."""

import pytest

from executive.language.grammar import EnglishInterpreter
from executive.testing.bench import run_mission
from executive.types.outcome import MissionStatus

LABELS = ("taza de café", "pain sans gluten", "りんご", "caja de la cocina")
read = EnglishInterpreter(LABELS)
ONLY_ENGLISH = "I speak only English, and do not understand"


@pytest.mark.parametrize(
    "words",
    [
        "Bringe mir einen Apfel",
        "Bring mir den Hammer",
        "Wo ist der Hammer?",
        "Tráeme el tazón",
        "Apporte-moi la pomme",
        "Portami la mela",
        "Traga-me uma maçã",
        "Breng mij de appel",
        "Hent koppen til mig",
        "Przynieś mi kubek",
        "Принеси мне молоток",
        "ハンマーを持ってきて",
        "把锤子拿来",
        "Danke",
    ],
)
def test_what_is_of_another_language_is_no_command_and_it_is_told_so(words: str) -> None:
    assert not read.commands(words)
    assert not read.remark(words)
    assert read.not_understood(words).startswith(ONLY_ENGLISH)


@pytest.mark.parametrize("words", ["Gribble the wumpus", "Find the van in the den", "find van"])
def test_odd_english_is_not_called_another_language(words: str) -> None:
    assert read.not_understood(words) == f"I do not understand '{words}'"


@pytest.mark.parametrize("label", LABELS)
def test_a_label_of_the_ontology_is_known_in_any_language(label: str) -> None:
    command = read.command(f"bring the {label}")
    assert command
    assert command.target == label


@pytest.mark.parametrize(
    "words",
    [
        "bring keinen hammer",
        "bring the hammer nicht",
        "nicht the hammer",
        "bring mir nicht den hammer",
        "nunca toques el hammer",
        "n'apporte pas le hammer",
        "non toccare il hammer",
        "não traga o hammer",
        "breng de hammer niet",
        "rør ikke hammer",
        "не приноси hammer",
        "不要拿 hammer",
        "hammer を持ってこないで ない",
    ],
)
def test_a_negation_of_another_language_is_one(words: str) -> None:
    assert not read.commands(words)
    assert "I hear" in read.remark(words)


def test_a_model_is_asked_for_other_languages_and_without_one_the_robot_says_what_it_speaks() -> (
    None
):
    run = run_mission("Bringe mir einen Apfel", llm=False)
    assert run.outcome.status == MissionStatus.NOT_UNDERSTOOD
    assert run.outcome.reason.startswith(f"{ONLY_ENGLISH} 'Bringe mir einen Apfel'")
