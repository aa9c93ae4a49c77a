"""The prompt texts for the language model: read from prompts.toml, then filled in."""

import json
import re
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError, ValidationInfo, field_validator

from executive.errors import InputError
from executive.toml_file import in_words, read_toml
from executive.types.commands import SEARCHING, CommandKind
from executive.types.home import Place
from executive.types.llm import Message
from kb.advice.verification import Reply
from kb.ontology.names import unique

TEXTS = Path(__file__).parents[1] / "prompts.toml"

PLACEHOLDERS: Mapping[str, Sequence[str]] = {
    "inquiry_system": ("objects", "places", "format"),
    "system": ("rooms", "furniture in rooms", "furniture", "format"),
    "system_rooms": ("rooms", "format"),
    "general_pos": ("object name", "top"),
    "multiple_pos": ("object name", "position"),
    "furniture": ("object name", "room name", "furniture list"),
    "again": ("object name", "furniture list"),
    "summarize": ("object name", "situation"),
    "question": ("thing", "words"),
}
"""Label of each text, and the placeholders it may contain."""


class _Part(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", str_strip_whitespace=True)

    @field_validator(*PLACEHOLDERS, check_fields=False)
    @classmethod
    def _knows_its_placeholders(cls, text: str, info: ValidationInfo) -> str:
        known = PLACEHOLDERS[str(info.field_name)]
        if unknown := re.search(r"#\w+", _pattern(known).sub("", text)):
            names = ", ".join(f"#{name}" for name in known)
            raise ValueError(f"there is no {unknown[0]} here; known are {names}")
        return text


class Ranking(_Part):
    """The chat for scoring places."""

    system: str
    question: str
    neutral: str
    examples: tuple[tuple[str, str], ...]

    def chat(self, thing: str) -> tuple[Message, ...]:
        """The examples as turns, then the question about this thing."""
        turns = [Message("system", self.system)]
        for example, said in self.examples:
            turns += [Message("user", self._about(example)), Message("assistant", said)]
        return (*turns, Message("user", self._about(thing)))

    def _about(self, thing: str) -> str:
        return _fill(self.question, {"thing": thing})


class Understanding(_Part):
    """The chats for commands that the grammar cannot parse."""

    system: str
    question: str
    neutral: str
    answers: dict[CommandKind, str]
    examples: tuple[tuple[str, CommandKind], ...]
    inquiry_system: str

    @field_validator("answers")
    @classmethod
    def _answers_for_all(cls, answers: dict[CommandKind, str]) -> dict[CommandKind, str]:
        if missing := [kind for kind in SEARCHING if kind not in answers]:
            raise ValueError(f"there has to be an answer for {', '.join(missing)}")
        return answers

    def chat(self, words: str) -> tuple[Message, ...]:
        """For ranking: the examples as turns, then the question about these words."""
        turns = [Message("system", self.system)]
        for example, kind in self.examples:
            answer = self.answers[kind]
            turns += [Message("user", self._about(example)), Message("assistant", answer)]
        return (*turns, Message("user", self._about(words)))

    def inquiry(
        self,
        words: str,
        objects: Sequence[str],
        places: Sequence[str],
        schema: dict[str, Any],
    ) -> tuple[Message, ...]:
        """For writing: the known names and the output format, then the question."""
        values = {
            "objects": ", ".join(objects),
            "places": ", ".join(places),
            "format": json.dumps(schema),
        }
        system = Message("system", _fill(self.inquiry_system, values))
        return system, Message("user", self._about(words))

    def _about(self, words: str) -> str:
        return _fill(self.question, {"words": words})


class Prompts(_Part):
    """All texts, by the labels in the paper."""

    system: str
    system_rooms: str
    general_pos: str
    multiple_pos: str
    furniture: str
    again: str
    summarize: str
    ranking: Ranking
    understanding: Understanding

    @classmethod
    def load(cls, path: Path | None = None) -> "Prompts":
        """Our texts, with those in a TOML file like prompts.toml replaced.

        Raises:
            InputError: names the text and what is wrong with it.
        """
        return _ours() if path is None else cls._with_those_of(path)

    @classmethod
    def _with_those_of(cls, path: Path) -> "Prompts":
        texts, own = read_toml(TEXTS), read_toml(path)
        for name, table in own.items():
            if isinstance(table, dict) and isinstance(texts.get(name), dict):
                own[name] = {**texts[name], **table}
        try:
            return cls.model_validate({**texts, **own})
        except ValidationError as error:
            fault = error.errors()[0]
            where = ".".join(map(str, fault["loc"]))
            known = f"known are {', '.join(texts)}" if fault["type"] == "extra_forbidden" else ""
            raise InputError(f"{path}: {where}", in_words(fault["msg"]), known) from None

    def inquiry(self, label: str, **values: str) -> str:
        """The text with this label, filled in; `object_name` is the value of `#object name`."""
        text: str = getattr(self, label)
        return _fill(text, {name.replace("_", " "): value for name, value in values.items()})

    def home(self, places: Sequence[Place]) -> str:
        """The system prompt: the home and the output format."""
        return _fill(
            self.system,
            {
                "rooms": ", ".join(unique(p.room for p in places)),
                "furniture": ", ".join(p.name for p in places),
                "furniture in rooms": "\n".join(f"- {p.name}: {p.room}" for p in places),
                "format": json.dumps(Reply.model_json_schema()),
            },
        )

    def rooms(self, rooms: Sequence[str]) -> str:
        """The system prompt for a home with too much furniture for one prompt."""
        form = json.dumps(Reply.model_json_schema())
        return _fill(self.system_rooms, {"rooms": ", ".join(rooms), "format": form})


@cache
def _ours() -> Prompts:
    return Prompts.model_validate(read_toml(TEXTS))


def _pattern(names: Iterable[str]) -> re.Pattern[str]:
    """A pattern for `#name` with each of the names, the longest first."""
    longest_first = sorted(names, key=len, reverse=True)
    return re.compile(rf"#({'|'.join(map(re.escape, longest_first))})\b")


def _fill(text: str, values: Mapping[str, str]) -> str:
    return _pattern(values).sub(lambda found: values[found[1]], text)
