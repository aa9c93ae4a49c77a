"""The file that says what a study is: `study.toml`."""

import hashlib
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any, Literal, Self

from pydantic import Field, ValidationError, model_validator
from pydantic_core import ErrorDetails

from executive.config import Settings, load_settings
from executive.errors import InputError
from executive.page.study.questionnaire import (
    Line,
    Name,
    Prose,
    Questionnaire,
    Table,
    templates,
)
from executive.toml_file import in_words, misread, read_toml, shown

RIGHT = "see docs/study.md"
THANKS = "That was all. Thank you for taking part!"
SPEECH = "participants speak by their browser, where the file says speech = true"
NOT_OURS = {
    "user": "the participant is the person",
    "runs": "the study keeps recordings by participant",
    "memory": "what one participant said would be told to the next",
    "home_state": "what one participant had moved would be moved for the next",
    "config": "all settings stand in the study's file",
    "ears": SPEECH,
    "voice": SPEECH,
    "microphone": SPEECH,
}
"""Settings that no condition has, and why."""
KEEPING = ("memory", "home_state")
"""Those that would outlive a participant, if the environment had them."""


class Condition(Table):
    """What is compared with the others."""

    name: Name
    text: Prose = ""
    """What the participant reads before it; it should not give away what is compared."""
    settings: dict[str, Any] = {}


class Task(Table):
    """What the participant is to get done in conversation with the robot."""

    name: Name
    text: Prose = Field(min_length=1)
    limit_s: float | None = Field(None, gt=0, le=86_400)
    """After so long the participant is led on (s)."""


class Study(Table):
    """The whole of it."""

    title: Line
    consent: Prose = Field(min_length=1)
    instructions: Prose = Field(min_length=1)
    thanks: Prose = THANKS
    order: Literal["balanced", "as written"] = "balanced"
    task_order: Literal["as written", "rotated"] = "as written"
    speech: bool = False
    """Whether participants may have their browser listen and speak."""
    settings: dict[str, Any] = {}
    """Of all conditions."""
    conditions: tuple[Condition, ...] = Field(min_length=1, max_length=12)
    tasks: tuple[Task, ...] = Field(min_length=1, max_length=50)
    at_start: tuple[Name, ...] = ()
    after_each: tuple[Name, ...] = ()
    at_end: tuple[Name, ...] = ()
    questionnaires: dict[Name, Questionnaire] = {}
    """Of its own; one that is called like a template replaces that."""

    @model_validator(mode="after")
    def _is_whole(self) -> Self:
        _once("conditions", (one.name for one in self.conditions))
        _once("tasks", (one.name for one in self.tasks))
        _once("questionnaires before and after", (*self.at_start, *self.at_end))
        _once("questionnaires after each", self.after_each)
        known = {**templates(), **self.questionnaires}
        for name in self.asked:
            if name not in known:
                raise ValueError(f"has no questionnaire {name!r}: there are {', '.join(known)}")
        for name in self.questionnaires:
            if name not in self.asked:
                where = "name it in at_start, after_each or at_end, or leave it out"
                raise ValueError(f"asks questionnaire {name!r} nowhere: {where}")
        return self

    @property
    def asked(self) -> tuple[Name, ...]:
        """The questionnaires that a participant meets, by name."""
        return *self.at_start, *self.after_each, *self.at_end

    def questionnaire(self, name: str) -> Questionnaire:
        """Its own of this name, or the template."""
        return self.questionnaires.get(name) or templates()[name]

    def condition(self, name: str) -> Condition:
        """The condition of this name."""
        return next(one for one in self.conditions if one.name == name)

    def task(self, name: str) -> Task:
        """The task of this name."""
        return next(one for one in self.tasks if one.name == name)

    @property
    def consent_sha256(self) -> str:
        """Of the text that the participants agree to."""
        return hashlib.sha256(self.consent.encode()).hexdigest()

    def canonical(self) -> str:
        """What it says, the same for any two files that say the same."""
        texts = {
            name: self.questionnaire(name).model_dump(mode="json") for name in sorted({*self.asked})
        }
        said = {**self.model_dump(mode="json"), "questionnaires": texts}
        return json.dumps(said, indent=2, sort_keys=True, default=str) + "\n"


def _once(what: str, names: Iterable[str]) -> None:
    listed = list(names)
    alike = [name.lower() for name in listed]  # some disks have one folder for both
    for name in listed:
        if alike.count(name.lower()) > 1:
            raise ValueError(f"has two {what} called {name!r}: each needs a name of its own")


def read_study(file: Path) -> Study:
    """The study that a file describes; its settings are tried, too.

    Raises:
        InputError: if it cannot be read, or something in it is wrong, naming what.
    """
    tables = read_toml(file, "give the study's TOML file; docs/study.md has one to begin with")
    try:
        study = Study.model_validate(tables)
    except ValidationError as error:
        raise _wrong(file, error.errors(include_url=False)[0]) from None
    for other in misread(tables, study):
        raise InputError(str(file), f"{other.key} is {other.shown}", other.right)
    for condition in study.conditions:
        settings_of(study, condition, str(file))
    return study


def settings_of(study: Study, condition: Condition, where: str, **given: Any) -> Settings:
    """The settings of a condition; those `given` come last.

    Raises:
        InputError: if one is wrong, or not for a study; `where` is what messages call the file.
    """
    said = {**study.settings, **condition.settings}
    inside = f"{where}: settings of condition {condition.name!r}"
    for name, why in NOT_OURS.items():
        if name in said:
            raise InputError(inside, f"{name} is not for a study: {why}", "leave it out")
    try:
        settings = load_settings(**{**said, "user": "console", **given})
    except InputError as error:
        which, what, right = error.args
        raise InputError(f"{inside}: {which}", what, right) from None
    for name in KEEPING:
        if getattr(settings, name) is not None:
            what = f"is not for a study: {NOT_OURS[name]}"
            raise InputError(f"EXECUTIVE_{name.upper()}", what, "take it out of the environment")
    return settings


def _wrong(file: Path, fault: ErrorDetails) -> InputError:
    """What a person can mend, of pydantic's first complaint."""
    key = ".".join(str(part) for part in fault["loc"])[:80]
    said = in_words(fault["msg"])
    match fault["type"]:
        case "extra_forbidden":
            return InputError(str(file), f"there is no key {key}", RIGHT)
        case "missing":
            return InputError(str(file), f"{key} is missing", RIGHT)
        case "string_pattern_mismatch":
            what = f"{key} is {shown(fault['input'])}"
            return InputError(str(file), what, "use up to 40 letters, digits, - and _")
        case "string_type":
            what = f"{key} is {shown(fault['input'])}"
            return InputError(str(file), what, "should be text, in quotes")
        case "value_error":
            return InputError(str(file), f"{key} {said}".strip(), RIGHT)
        case _:
            what = f"{key} is {shown(fault['input'])}"
            return InputError(str(file), what, said[:1].lower() + said[1:])
