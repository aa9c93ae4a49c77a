"""Asks a language model the questions of a data set, and keeps the answers."""

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from executive.errors import InputError, ModelError
from executive.events import Ended, Inbox
from executive.geometry import Floats
from executive.interfaces.llm import LanguageModel
from executive.terminal import show_over
from executive.types.llm import RankRequest, Usage
from executive.types.results import Replied, Scored
from kb.advice.lister import Lister
from kb.advice.prompts import Prompts
from kb.advice.ranking import rank_request, softmax
from kb.benchmark.questions import DataSet, Item
from kb.llm.precedents import shares, usual
from kb.ontology.ontology import Ontology

PLAIN = "the model's likelihood of the answer"
NEUTRAL = "... less that for any thing"
COUNTS = "... and how often places are used"
ALIKE = "... instead: where like things are"
RANKED = "... like by their class, too (--elicit rank)"
WRITTEN = "a list that the model writes, verified"


@dataclass(frozen=True, slots=True)
class Answer:
    """The answer to one question.

    Attributes:
        object: the thing in question.
        orders: for each method, the places, likeliest first.
        seconds: duration of the robot's own method (s).
        tokens: tokens evaluated for it, including written ones.
        likely: for each method with probabilities, the probability of each place.
    """

    object: str
    orders: dict[str, list[str]]
    seconds: float
    tokens: int
    likely: dict[str, dict[str, float]] = field(default_factory=dict)


Ask = Callable[[Item], Answer]


def ranking(data: DataSet, model: LanguageModel, inbox: Inbox, prompts: Prompts) -> Ask:
    """Score every place; also with parts of the method, to show what each contributes."""
    names = [place.name for place in data.places]

    def scores(request: RankRequest) -> tuple[Floats, Usage]:
        model.rank(request)
        scored = _end(inbox)
        assert isinstance(scored, Scored)
        return np.array(scored.scores), scored.usage

    def ask(question: Item) -> Answer:
        request = rank_request(question.thing, data.answers, prompts.ranking, question.others)
        full, usage = scores(request)
        less, _ = scores(replace(request, precedents=()))
        plain, _ = scores(replace(request, precedents=(), neutral=()))
        told = {PLAIN: plain, NEUTRAL: less}
        if known := request.precedents:
            at = shares([precedent.places for precedent in known], names)
            of_no_kind = tuple(replace(precedent, kind="") for precedent in known)
            alike, _ = scores(replace(request, precedents=of_no_kind))
            told[COUNTS] = less + np.log(usual(at))
            told[ALIKE] = alike
            told[RANKED] = full
        return Answer(
            question.thing.name,
            {way: descending(values, names) for way, values in told.items()},
            usage.total_s,
            usage.evaluated_tokens,
            {
                way: dict(zip(names, softmax(values.tolist()), strict=True))
                for way, values in told.items()
            },
        )

    return ask


def writing(data: DataSet, model: LanguageModel, inbox: Inbox, prompts: Prompts) -> Ask:
    """Have the model write a list (the paper's method), and keep the places that exist."""
    ontology = Ontology(data.places, defaults=False)
    lister = Lister(ontology, model, remembers=False, prompts=prompts)

    def ask(question: Item) -> Answer:
        model.chat(lister.inquiry(question.thing.name, ()))
        replied = _end(inbox)
        assert isinstance(replied, Replied)
        names = lister.read(replied.text) or ()
        found = list(lister.verify(names, ()).furniture)
        tokens = replied.usage.evaluated_tokens + replied.usage.output_tokens
        return Answer(question.thing.name, {WRITTEN: found}, replied.usage.total_s, tokens)

    return ask


def descending(values: Floats, places: Sequence[str]) -> list[str]:
    """The places by value, highest first; ties keep their order."""
    return [places[i] for i in np.argsort(-values, kind="stable")]


class Journal:
    """Answers as lines of JSON, so that an interrupted run can be continued."""

    def __init__(self, file: Path | None, run: dict[str, object]) -> None:
        """Open or create the file; `run` identifies the settings of the answers.

        Raises:
            InputError: if it is the journal of another run, or no journal.
        """
        self._file = file
        self._kept: dict[tuple[str, str], Answer] = {}
        if file is None:
            return
        try:
            head, *rest = _lines(file) or [run]
            self._kept = {(line.pop("data"), line["object"]): Answer(**line) for line in rest}
            if head == run:
                whole = [run, *({"data": data, **asdict(a)} for (data, _), a in self._kept.items())]
                fresh = file.with_name(file.name + ".new")
                fresh.write_text("".join(json.dumps(line) + "\n" for line in whole))
                fresh.replace(file)
        except (OSError, ValueError, TypeError, KeyError) as error:
            raise InputError(str(file), f"is no journal: {error}", "name another file") from None
        if head != run:
            raise InputError(str(file), f"is the journal of another run: {head}", "name another")

    def answers(self, data: DataSet, ask: Ask) -> Iterator[Answer]:
        """All answers in the order of the questions, kept or new; progress is shown on stderr."""
        for number, question in enumerate(data.questions, start=1):
            show_over(f"{data.name} {number}/{len(data.questions)} {question.thing.name}")
            key = data.name, question.thing.name
            if key not in self._kept:
                self._kept[key] = ask(question)
                self._write({"data": data.name, **asdict(self._kept[key])})
            yield self._kept[key]
        show_over("")

    def _write(self, line: dict[str, object]) -> None:
        if self._file:
            with self._file.open("a") as file:
                file.write(json.dumps(line) + "\n")


def _lines(file: Path) -> list[Any]:
    """The JSON lines of a file, without an incomplete last line."""
    lines = file.read_text().splitlines(keepends=True) if file.exists() else []
    if len(lines) > 1 and not lines[-1].endswith("\n"):
        lines.pop()
    return [json.loads(line) for line in lines]


def _end(inbox: Inbox) -> Scored | Replied:
    """The result of the open request.

    Raises:
        ModelError: if the model failed.
    """
    inbox.wait(None)
    (event,) = inbox.take_all()
    assert isinstance(event, Ended)
    if not isinstance(event.result, Scored | Replied):
        raise ModelError(str(event.result))
    return event.result
