"""Runs the benchmark: asks the questions, and makes tables and pictures of the answers."""

import argparse
import json
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from dataclasses import asdict, astuple, dataclass, replace
from pathlib import Path
from statistics import fmean

import numpy as np

from executive.config import load_settings
from executive.errors import InputError
from executive.events import Inbox
from executive.geometry import Floats
from executive.interfaces.llm import LanguageModel
from executive.language.phrases import words_of
from kb.advice.prompts import Prompts
from kb.advice.ranking import Known
from kb.benchmark.calibration import Calibration, calibration
from kb.benchmark.measures import Measures, expected_of_chance, mean, measure
from kb.benchmark.placements import Placements
from kb.benchmark.questions import DataSet, Item, placements, survey
from kb.benchmark.trials import Answer, Journal, descending, ranking, writing
from kb.llm.open import open_model
from kb.llm.precedents import log_expected, shares, usual

CHANCE = "chance"
POPULARITY = "how often places are used"
HINDSIGHT = "how often the answers use places"
WORDS = "where things of like names are"


@dataclass(frozen=True, slots=True)
class Row:
    """One method: its measures, and its calibration if it gives probabilities.

    The cost of one object is given if a model was asked.
    """

    way: str
    measures: Measures
    calibration: Calibration | None = None
    seconds: float | None = None
    tokens: float | None = None


Tables = dict[str, list[Row]]
"""The rows of each data set, by its name."""


def table(data: DataSet, ask: Callable[[Item], Answer] | None, journal: Journal) -> list[Row]:
    """All methods on a data set, those with a model through `ask`."""
    rows = list(baselines(data))
    if ask is None:
        return rows
    answers = list(journal.answers(data, ask))
    *less, last = answers[0].orders
    for way in less:
        measures = _measured(data, [answer.orders[way] for answer in answers])
        rows.append(Row(way, measures, _calibrated(data, answers, way)))
    measures = _measured(data, [answer.orders[last] for answer in answers])
    seconds, tokens = fmean(a.seconds for a in answers), fmean(a.tokens for a in answers)
    return [*rows, Row(last, measures, _calibrated(data, answers, last), seconds, tokens)]


def _calibrated(data: DataSet, answers: Sequence[Answer], way: str) -> Calibration | None:
    """None for a method without probabilities."""
    if not all(way in answer.likely for answer in answers):
        return None
    pairs = zip(answers, data.questions, strict=True)
    return calibration((answer.likely[way], q.thing.places) for answer, q in pairs)


def baselines(data: DataSet) -> Iterator[Row]:
    """The methods without a model.

    Popularity counts the precedents. If there are none, it counts the right answers themselves,
    which nobody can know beforehand: it shows how far one order for all objects may get.
    """
    places = [place.name for place in data.places]
    chances = (expected_of_chance(len(places), len(q.thing.places)) for q in data.questions)
    yield Row(CHANCE, mean(chances))
    if any(question.others for question in data.questions):
        counts = [usual(_shares(q.others, places)) for q in data.questions]
        alike = [_by_words(question, places) for question in data.questions]
        yield Row(POPULARITY, _measured(data, [descending(c, places) for c in counts]))
        yield Row(WORDS, _measured(data, [descending(a, places) for a in alike]))
    else:
        count = usual(_shares([q.thing for q in data.questions], places))
        yield Row(HINDSIGHT, _measured(data, [descending(count, places)] * len(data.questions)))


def _measured(data: DataSet, orders: Sequence[Sequence[str]]) -> Measures:
    pairs = zip(orders, data.questions, strict=True)
    return mean(measure(found, question.thing.places) for found, question in pairs)


def _by_words(question: Item, places: Sequence[str]) -> Floats:
    """The prediction from precedents if things are alike by common words or a common class."""
    things = (question.thing, *question.others)
    names = [words_of(thing.name) for thing in things]
    vocabulary = sorted({word for name in names for word in name})
    states = np.array([[word in name for word in vocabulary] for name in names], dtype=float)
    kinds = [thing.kind for thing in things]
    return log_expected(states, kinds, _shares(question.others, places))


def _shares(things: Sequence[Known], places: Sequence[str]) -> Floats:
    return shares([thing.places for thing in things], places)


def text(data: DataSet, rows: Sequence[Row]) -> str:
    """The table as text."""
    counts = f"{len(data.places)} places, {len(data.questions)} objects"
    heads = ("first", "in 3", "in 5", "RR", "mAP", "ECE", "log", "s/object", "tokens")
    lines = [f"{data.title}\n{counts:44}" + "".join(f"{head:>9}" for head in heads)]
    for row in rows:
        values = [f"{value:9.2f}" for value in astuple(row.measures)]
        sure = row.calibration
        values += [f"{v:9.2f}" for v in (sure.error, sure.log_score)] if sure else [" " * 9] * 2
        values += [f"{row.seconds:9.2f}" if row.seconds is not None else ""]
        values += [f"{row.tokens:9.0f}" if row.tokens is not None else ""]
        lines.append((f"{row.way:44}" + "".join(values)).rstrip())
    return "\n".join(lines) + "\n"


def run(given: argparse.Namespace) -> None:
    """Ask, print, and draw what the options require.

    Raises:
        ExecutiveError: if an option is wrong.
    """
    draw = _plotter("--plot", given.plot, _bars) if given.plot else None
    draw_reliability = None
    if given.reliability:
        draw_reliability = _plotter("--reliability", given.reliability, _curves)
    sets = [_data_set(name, given) for name in given.data]
    journal = Journal(given.journal, _described(given))
    tables: Tables = {}
    for data in sets:
        tables[data.name] = _table_of(data, given, journal)
        if not given.json:
            print(text(data, tables[data.name]), flush=True)
    if given.json:
        print(json.dumps(_report(given, sets, tables)))
    if draw:
        draw(sets, tables)
    if draw_reliability:
        draw_reliability(sets, tables)


def _table_of(data: DataSet, given: argparse.Namespace, journal: Journal) -> list[Row]:
    """The table of one data set, by a fresh model that remembers no other set."""
    inbox = Inbox()
    model = _model(given, inbox)
    if model is None:
        return table(data, None, journal)
    with closing(model):
        ways = ranking if _ranks(given, model) else writing
        return table(data, ways(data, model, inbox, Prompts.load(given.prompts)), journal)


Draw = Callable[[Path, Sequence[DataSet], Tables], None]


def _plotter(option: str, path: Path, draw: Draw) -> Callable[[Sequence[DataSet], Tables], None]:
    """A function that draws into this file; checked before the model is asked anything."""
    try:
        from kb.benchmark import plot
    except ModuleNotFoundError as error:
        right = "pip install 'robot-executive[benchmark]'"
        raise InputError(option, f"{error.name} is not installed", right) from None
    if path.suffix not in plot.KINDS or not path.absolute().parent.is_dir():
        right = f"name a file in a folder that exists, with {', '.join(plot.KINDS)}"
        raise InputError(f"{option} {path}", "cannot be drawn", right)
    return lambda sets, tables: draw(path, sets, tables)


def _bars(path: Path, sets: Sequence[DataSet], tables: Tables) -> None:
    from kb.benchmark import plot

    panels = {d.title: [(row.way, row.measures) for row in tables[d.name]] for d in sets}
    plot.draw(path, panels)


def _curves(path: Path, sets: Sequence[DataSet], tables: Tables) -> None:
    from kb.benchmark import plot

    last = {d.title: tables[d.name][-1] for d in sets}
    plot.draw_reliability(
        path, {title: r.calibration for title, r in last.items() if r.calibration}
    )


def _ranks(given: argparse.Namespace, model: LanguageModel) -> bool:
    if given.elicit == "rank" and not model.can_rank:
        raise InputError("--elicit rank", "a server cannot rank places", "use --elicit generate")
    return model.can_rank and given.elicit != "generate"


def _data_set(name: str, given: argparse.Namespace) -> DataSet:
    match name:
        case "placements" | "placements-new":
            data = placements(Placements(given.placements), given.fold, name == "placements-new")
        case _:
            data = survey(rest=name == "survey-rest")
    return replace(data, questions=data.questions[: given.objects])


def _model(given: argparse.Namespace, inbox: Inbox) -> LanguageModel | None:
    settings = load_settings(llm=given.llm, seed=given.seed, grammar=given.grammar)
    return open_model(settings, inbox)


def _described(given: argparse.Namespace) -> dict[str, object]:
    """The options that the answers depend on."""
    names = ("llm", "elicit", "grammar", "seed", "fold")
    return {name: getattr(given, name) for name in names} | {"prompts": str(given.prompts)}


def _report(
    given: argparse.Namespace, sets: Sequence[DataSet], tables: Tables
) -> dict[str, object]:
    return {
        **_described(given),
        "data": {
            data.name: {
                "title": data.title,
                "places": len(data.places),
                "objects": len(data.questions),
                "ways": [asdict(row) for row in tables[data.name]],
            }
            for data in sets
        },
    }
