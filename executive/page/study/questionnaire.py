"""What a participant is asked in writing, what is a whole answer to it, and what it comes to."""

from collections.abc import Mapping
from importlib.resources import files
from statistics import fmean
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, StringConstraints, model_validator

from executive.text import writable
from executive.toml_file import parse_toml

MOST_WORDS = 4000
"""Characters of an answer in words."""
ALL = "score"
"""What the scale is called of items that name none."""

Name = Annotated[str, StringConstraints(pattern=r"^[A-Za-z0-9][A-Za-z0-9_-]{0,39}$")]
Line = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=500)]
Prose = Annotated[str, StringConstraints(strip_whitespace=True, max_length=20_000)]
Answers = dict[str, int | str]


class Table(BaseModel):
    """A table of the study file."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Item(Table):
    """A statement, a question, or two words between which one chooses."""

    name: Name
    text: Annotated[str, StringConstraints(strip_whitespace=True, max_length=500)] = ""
    left: str = Field("", max_length=100)
    """What the first point means; empty: as the questionnaire says."""
    right: str = Field("", max_length=100)
    answer: Literal["points", "words"] = "points"
    needed: bool = True
    """Whether it has to be answered."""
    scale: Name = ALL
    reversed: bool = False
    """Whether much of it is little of its scale."""

    @model_validator(mode="after")
    def _asks(self) -> Self:
        if not (self.text or (self.left and self.right)):
            raise ValueError("should have a text, or words at its left and right")
        return self


class Questionnaire(Table):
    """Items with the same points to choose from."""

    title: Line
    text: Prose = ""
    points: int = Field(5, ge=2, le=101)
    left: str = Field("", max_length=100)
    right: str = Field("", max_length=100)
    score: Literal["mean", "percent"] = "mean"
    """A scale's score: the mean of its points, or that as a share of what is possible (0-100)."""
    items: tuple[Item, ...] = Field(min_length=1, max_length=100)

    @model_validator(mode="after")
    def _names(self) -> Self:
        names = [item.name for item in self.items]
        if len(set(names)) < len(names):
            twice = next(name for name in names if names.count(name) > 1)
            raise ValueError(f"should have one item of each name, and has two called {twice!r}")
        return self

    def fault(self, answers: object) -> str:
        """What is wrong with answers that were sent; empty if they are whole."""
        if not isinstance(answers, dict) or not set(answers) <= {item.name for item in self.items}:
            return "these are no answers to it"
        for item in self.items:
            if item.name not in answers:
                if item.needed:
                    return f"{item.name} is not answered"
            elif why := self._fault(item, answers[item.name]):
                return f"{item.name} {why}"
        return ""

    def _fault(self, item: Item, answer: object) -> str:
        if item.answer == "words":
            if not isinstance(answer, str) or len(answer) > MOST_WORDS:
                return f"should be words, at most {MOST_WORDS:,} characters"
            return "is not answered" if item.needed and not answer.strip() else ""
        whole = isinstance(answer, int) and not isinstance(answer, bool)
        fits = whole and 1 <= answer <= self.points  # type: ignore[operator]
        return "" if fits else f"should be 1 to {self.points}"

    def kept(self, answers: Mapping[str, Any]) -> Answers:
        """Answers as they are kept, in the order of the items."""
        given = [item.name for item in self.items if item.name in answers]
        return {
            name: writable(value) if isinstance(value := answers[name], str) else value
            for name in given
        }

    def scores(self, answers: Mapping[str, int | str]) -> dict[str, float]:
        """What the answers come to, by scale, in the order of the items."""
        scales: dict[str, list[float]] = {}
        for item in self.items:
            value = answers.get(item.name)
            if isinstance(value, int) and item.answer == "points":
                turned = self.points + 1 - value if item.reversed else value
                scales.setdefault(item.scale, []).append(turned)
        return {scale: self._score(fmean(values)) for scale, values in scales.items()}

    def _score(self, mean: float) -> float:
        return mean if self.score == "mean" else 100 * (mean - 1) / (self.points - 1)


def templates() -> dict[str, Questionnaire]:
    """The packaged ones, by name."""
    file = files("executive.page").joinpath("assets/questionnaires.toml")
    tables = parse_toml(file.read_bytes(), file.name)
    return {name: Questionnaire.model_validate(table) for name, table in tables.items()}
