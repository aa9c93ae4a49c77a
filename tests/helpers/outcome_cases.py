from dataclasses import dataclass, field
from typing import Any

from executive.testing.bench import four_rooms
from executive.types.commands import SEARCHING, CommandKind
from executive.types.knowledge import Source
from executive.types.outcome import MissionStatus

ALL = tuple(place.name for place in four_rooms().places())


def favouring(*best: str, among: tuple[str, ...] = ALL) -> tuple[float, ...]:
    """Scores of a ranking in which these places come first, in this order."""
    return tuple(float(len(best) - best.index(p)) if p in best else -1.0 for p in among)


def listing(*places: str) -> str:
    """A reply in the output format."""
    return '{"places": [' + ", ".join(f'"{p}"' for p in places) + "]}"


@dataclass(frozen=True)
class Case:
    """A mission and what must come of it."""

    says: str
    words: str
    given: dict[str, Any] = field(default_factory=dict)
    status: MissionStatus = MissionStatus.DONE
    object: str | None = None
    kind: CommandKind | None = None
    location: str | None = None
    source: Source | None = None
    visited: tuple[str, ...] | None = None
    inquiries: int = 0
    llm_calls: int = 0
    reason: str = ""


NO_DEFAULTS = {"defaults": False}


OKB = {"llm": False}


GENERATE = {"elicit": "generate"}


FRUIT_DEFAULTS = ("dining_table", "counter_wagon", "high_table")


SUGAR_DEFAULTS = ("cabinet_kitchen", "counter_wagon", "high_table")


CASES = [
    Case(
        "the ontology's one place is visited without asking anyone",
        "Find a power_drill.",
        object="power_drill",
        location="shelf_lobby",
        source=Source.ONTOLOGY,
        visited=("shelf_lobby",),
    ),
    Case(
        "the person is asked if the ontology's one place is wrong",
        "Find a power_drill.",
        {"place": {"power_drill": "desk"}},
        location="desk",
        source=Source.USER,
        visited=("shelf_lobby", "desk"),
        inquiries=1,
    ),
    Case(
        "okb asks where without defaults",
        "Find an apple.",
        OKB | NO_DEFAULTS,
        location="dining_table",
        source=Source.USER,
        visited=("dining_table",),
        inquiries=1,
    ),
    Case(
        "okb asks where if there are several defaults",
        "Bring a sugar_box.",
        OKB,
        location="counter_wagon",
        source=Source.USER,
        visited=("counter_wagon",),
        inquiries=1,
    ),
    Case(
        "a ranking of all places is visited in its order until the thing is seen",
        "Take a mug.",
        NO_DEFAULTS | {"replies": [favouring("dining_table", "coffee_table")]},
        location="coffee_table",
        source=Source.LLM,
        visited=("dining_table", "coffee_table"),
        llm_calls=1,
    ),
    Case(
        "several defaults are ranked, and no other place",
        "Bring a sugar_box.",
        {"replies": [favouring("high_table", "counter_wagon", among=SUGAR_DEFAULTS)]},
        location="counter_wagon",
        source=Source.LLM,
        visited=("high_table", "counter_wagon"),
        llm_calls=1,
    ),
    Case(
        "only the top five of a ranking are visited, then the person is asked",
        "Find an apple.",
        NO_DEFAULTS | {"replies": [favouring("bed", "sofa", "desk", "sideboard", "high_table")]},
        location="dining_table",
        source=Source.USER,
        visited=("bed", "sofa", "desk", "sideboard", "high_table", "dining_table"),
        inquiries=1,
        llm_calls=1,
    ),
    Case(
        "a list is taken in the model's order",
        "Find an apple.",
        NO_DEFAULTS | GENERATE | {"replies": [listing("high_table", "dining_table")]},
        location="dining_table",
        source=Source.LLM,
        visited=("high_table", "dining_table"),
        llm_calls=1,
    ),
    Case(
        "an invented place never reaches the robot",
        "Find an apple.",
        NO_DEFAULTS | GENERATE | {"replies": [listing("pantry", "dining_table", "fruit bowl")]},
        location="dining_table",
        source=Source.LLM,
        visited=("dining_table",),
        llm_calls=1,
    ),
    Case(
        "a real place outside the defaults is not visited",
        "Bring a sugar_box.",
        GENERATE | {"replies": [listing("bed", "counter_wagon")]},
        location="counter_wagon",
        source=Source.LLM,
        visited=("counter_wagon",),
        llm_calls=1,
    ),
    Case(
        "a reply that is no JSON is summarized",
        "Find an apple.",
        NO_DEFAULTS | GENERATE | {"replies": ["On the table, I guess.", listing("dining_table")]},
        location="dining_table",
        source=Source.LLM,
        visited=("dining_table",),
        llm_calls=2,
    ),
    Case(
        "a room is expanded into its furniture",
        "Find an apple.",
        NO_DEFAULTS | GENERATE | {"replies": [listing("living_room"), listing("dining_table")]},
        location="dining_table",
        source=Source.LLM,
        visited=("dining_table",),
        llm_calls=2,
    ),
    Case(
        "the model is asked again if nothing it named exists",
        "Find an apple.",
        NO_DEFAULTS | GENERATE | {"replies": [listing("pantry"), listing("dining_table")]},
        location="dining_table",
        source=Source.LLM,
        visited=("dining_table",),
        llm_calls=2,
    ),
    Case(
        "the person is asked if the model invents twice",
        "Find an apple.",
        NO_DEFAULTS | GENERATE | {"replies": [listing("pantry"), listing("cellar")]},
        location="dining_table",
        source=Source.USER,
        visited=("dining_table",),
        inquiries=1,
        llm_calls=2,
    ),
    Case(
        "the person is asked if the model never answers in the format",
        "Find an apple.",
        NO_DEFAULTS | GENERATE | {"replies": ["Hm.", "Well."]},
        location="dining_table",
        source=Source.USER,
        visited=("dining_table",),
        inquiries=1,
        llm_calls=2,
    ),
    Case(
        "the person is asked if the model does not answer in time",
        "Find an apple.",
        NO_DEFAULTS | {"replies": [None]},
        location="dining_table",
        source=Source.USER,
        inquiries=1,
    ),
    Case(
        "the person is asked if the model fails",
        "Find an apple.",
        NO_DEFAULTS | {"replies": []},
        location="dining_table",
        source=Source.USER,
        inquiries=1,
    ),
    Case(
        "a class is asked of the person, never of the model",
        "Find a fruit.",
        NO_DEFAULTS | {"answers": ["peach", "high table"], "replies": [None]},
        object="peach",
        location="high_table",
        inquiries=2,
    ),
    Case(
        "an answer that is still a class is narrowed down",
        "Find some food.",
        OKB | {"answers": ["a fruit", "the pear", "on the high table"]},
        object="pear",
        location="high_table",
        inquiries=3,
    ),
    Case(
        "a synonym names the object",
        "Find a pitcher.",
        OKB,
        object="pitcher_base",
        location="counter_wagon",
        inquiries=1,
    ),
    Case(
        "an unknown thing is asked about, and the answer is taken",
        "Bring a suger_box.",
        OKB | {"answers": ["sugar box", "counter wagon"]},
        object="sugar_box",
        location="counter_wagon",
        inquiries=2,
    ),
    Case(
        "a slip is asked about, and yes is understood",
        "Take a hamer.",
        OKB | {"answers": ["Yes, please."]},
        object="hammer",
        inquiries=1,
    ),
    Case(
        "a slip was none, and the person says so and then what is meant",
        "Take a hamer.",
        OKB | {"answers": ["no", "the power drill"]},
        object="power_drill",
        inquiries=2,
    ),
    Case(
        "what is meant is said with the no",
        "Take a hamer.",
        OKB | {"answers": ["No, the drill!"]},
        object="power_drill",
        inquiries=1,
    ),
    Case(
        "no and the guess is a no",
        "Take a hamer.",
        OKB | {"answers": ["not the hammer", "power drill"]},
        object="power_drill",
        inquiries=2,
    ),
    Case(
        "a slip of a class is a class",
        "Find a fruti.",
        {"answers": ["yes", "pear"], "replies": [favouring("high_table", among=FRUIT_DEFAULTS)]},
        object="pear",
        inquiries=2,
        llm_calls=1,
    ),
    Case(
        "words beside a known name are asked about",
        "Take the red hammer.",
        OKB | {"answers": ["yes"]},
        object="hammer",
        inquiries=1,
    ),
    Case(
        "of two things of which one is enough, one is taken",
        "Take the hammer or a power drill.",
        OKB | {"answers": []},
        object="hammer",
    ),
    Case(
        "of several things each is found",
        "Find a power drill and the hammer.",
        OKB,
        object="hammer",
    ),
    Case(
        "a wish is a command",
        "I'd like a hammer, please.",
        OKB,
        object="hammer",
    ),
    Case(
        "what the grammar cannot read is ranked, and done if the person agrees",
        "Come with the hammer!",
        {"answers": ["yes"], "replies": [favouring("bring", among=SEARCHING)]},
        object="hammer",
        kind=CommandKind.BRING,
        inquiries=1,
        llm_calls=1,
    ),
    Case(
        "what the grammar cannot read is written by the model, and done if the person agrees",
        "My nails need driving in with a hammer.",
        GENERATE | {"answers": ["yes"], "replies": ['{"kind": "take", "object": "hammer"}']},
        object="hammer",
        kind=CommandKind.TAKE,
        inquiries=1,
        llm_calls=1,
    ),
    Case(
        "of several things in words that no grammar reads the person chooses one",
        "Has anyone seen hammer and drill?",
        {"answers": ["yes", "drill"], "replies": [favouring("find", among=SEARCHING)]},
        object="power_drill",
        kind=CommandKind.FIND,
        inquiries=2,
        llm_calls=1,
    ),
    Case(
        "a room as an answer means its furniture",
        "Find a peach.",
        OKB | {"answers": ["in the kitchen"]},
        location="high_table",
        source=Source.USER,
        visited=("cabinet_kitchen", "counter_wagon", "high_table"),
        inquiries=1,
    ),
    Case(
        "an answer that names no place is followed by the question again",
        "Find a peach.",
        OKB | {"answers": ["in the pantry", "high table"]},
        location="high_table",
        inquiries=2,
    ),
    Case(
        "a thing is on the delivery table, and the person says so",
        "Find a peach.",
        OKB | {"answers": ["On the delivery table!"], "place": {"peach": "delivery"}},
        location="delivery",
        source=Source.USER,
        visited=("delivery",),
        inquiries=1,
    ),
    Case(
        "a wrong answer is followed by the question again",
        "Find a peach.",
        OKB | {"answers": ["desk", "high table"]},
        location="high_table",
        visited=("desk", "high_table"),
        inquiries=2,
    ),
]
