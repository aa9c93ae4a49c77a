"""Lets the language model read commands that the grammar cannot.

The model can only choose from existing deeds, things and places. The result is turned into a plain
sentence, which the grammar parses, so that it means the same as if the person had said it. The
person has to confirm it before anything is done.
"""

from collections.abc import Sequence
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, StrictInt, ValidationError, field_validator

from executive.language.phrases import spoken
from executive.types.commands import SEARCHING, CommandKind
from executive.types.llm import ChatRequest, RankRequest
from executive.types.results import Scored
from kb.advice.prompts import Understanding
from kb.advice.verification import last_first

MOST_TASKS = 5
ALL = "all"
"""As a number: all things."""
MOST_THINGS = 9
ME = "me"
"""As a goal: the person."""


class Asked(BaseModel):
    """One task of the output format: what to do, with what, from where and to where."""

    model_config = ConfigDict(frozen=True, populate_by_name=True)

    kind: CommandKind
    object: str = ""
    number: StrictInt | str = 1
    source: str = Field("", alias="from")
    goal: str = Field("", alias="to")

    @field_validator("kind", mode="before")
    @classmethod
    def _in_any_case(cls, kind: Any) -> Any:
        return kind.strip().lower().replace(" ", "_") if isinstance(kind, str) else kind

    @field_validator("number")
    @classmethod
    def _can_be_counted(cls, number: int | str) -> int | str:
        if number != ALL and not (type(number) is int and 1 <= number <= MOST_THINGS):
            raise ValueError("no number of things")
        return number

    @field_validator("object", "source", "goal", mode="before")
    @classmethod
    def _null_is_empty(cls, name: Any) -> Any:
        return "" if name is None else name

    @property
    def sentence(self) -> str:
        """The task as a person would say it to the robot."""
        thing = self._thing
        source = f" from the {spoken(self.source)}" if self.source else ""
        goal = f" to the {spoken(self.goal)}" if self.goal not in ("", ME) else ""
        match self.kind:
            case CommandKind.GO:
                return f"go{goal}" if goal else "come here"
            case CommandKind.PUT_DOWN:
                return f"put {thing or 'it'} down"
            case CommandKind.PUT_BACK:
                return f"put {thing or 'it'} back"
            case CommandKind.PUT:
                return f"bring {thing}{source}{goal or ' to me'}"
            case CommandKind.BRING:
                return f"bring {thing}{source}{goal}" if goal else f"bring me {thing}{source}"
            case _:
                return f"{self.kind} {thing}{source}{goal}"

    @property
    def _thing(self) -> str:
        if not self.object or self.number == 1:
            return f"the {spoken(self.object)}" if self.object else ""
        every = "all the" if self.number == ALL else self.number
        return f"{every} {spoken(self.object).removesuffix('s')}s"

    @property
    def makes_sense(self) -> bool:
        """Whether the task has everything its deed needs, and nothing that the deed cannot use."""
        means = self.kind.means
        if self.kind == CommandKind.GO:
            return bool(self.goal) and not (self.object or self.source)
        if not means.searches:
            return not (self.source or self.goal) and self.number == 1
        if self.kind == CommandKind.FIND:
            return bool(self.object) and not self.goal
        if self.kind == CommandKind.PUT_BACK:
            return bool(self.object) and not (self.goal or self.source)
        return bool(self.object) and (bool(self.goal) or self.kind != CommandKind.PUT)


DEEDS = (*SEARCHING, CommandKind.PUT, CommandKind.PUT_BACK, CommandKind.PUT_DOWN, CommandKind.GO)
"""The deeds that a model may choose."""


def schema(objects: Sequence[str], places: Sequence[str]) -> dict[str, Any]:
    """JSON schema of a reply that can name only these objects and places; "" means none."""

    def one_of(names: Sequence[str]) -> dict[str, Any]:
        return {"type": "string", "enum": list(names)}

    task = {
        "type": "object",
        "properties": {
            "kind": one_of([str(kind) for kind in DEEDS]),
            "number": {"enum": [*range(1, MOST_THINGS + 1), ALL]},
            "object": one_of(["", *objects]),
            "from": one_of(["", *places]),
            "to": one_of(["", ME, *places]),
        },
        "required": ["kind", "number", "object", "from", "to"],
        "additionalProperties": False,
    }
    tasks = {"type": "array", "items": task, "maxItems": MOST_TASKS}
    return {
        "type": "object",
        "properties": {"tasks": tasks},
        "required": ["tasks"],
        "additionalProperties": False,
    }


def read(reply: str) -> tuple[Asked, ...]:
    """The tasks in the last valid JSON value of the reply; empty if there is none. Never raises.

    A single task without a list, an earlier format, is accepted, too.
    """
    for value in last_first(reply):
        listed = value.get("tasks") if isinstance(value, dict) and "tasks" in value else [value]
        if not isinstance(listed, list) or len(listed) > MOST_TASKS:
            continue
        try:
            tasks = tuple(map(Asked.model_validate, listed))
        except ValidationError:
            continue
        if all(task.kind in DEEDS and task.makes_sense for task in tasks):
            return tasks
    return ()


def rank_request(words: str, texts: Understanding) -> RankRequest:
    """A request for the score of each kind of command in `SEARCHING`."""
    return RankRequest(
        label="command",
        messages=texts.chat(words),
        neutral=texts.chat(texts.neutral),
        options=tuple(texts.answers[kind] for kind in SEARCHING),
        places=SEARCHING,
    )


def chat_request(
    words: str, objects: Sequence[str], places: Sequence[str], texts: Understanding
) -> ChatRequest:
    """A request for the tasks as JSON."""
    held = schema(objects, places)
    return ChatRequest("command", texts.inquiry(words, objects, places, held), held)


def likeliest(scored: Scored) -> CommandKind:
    """The kind with the highest score; the first of equals."""
    best = max(range(len(scored.scores)), key=scored.scores.__getitem__)
    return CommandKind(scored.request.places[best])
