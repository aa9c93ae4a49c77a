"""How well a language model knows where things are: `python tests/benchmarks/bench_ranking.py`.

Compares scoring every place (`rank`), writing a list (`generate`, the paper's way, with and without
a JSON grammar) and chance against the survey's default locations, which the model is not told. One
row of the survey counts once. Average precision rewards finding all of a row's places early; a
place that a written list leaves out counts as never found. Seconds are medians a call.
"""

import argparse
import random
import statistics
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from executive.errors import ModelError
from executive.events import Ended, Inbox
from executive.types import Place, Replied, Result, Scored
from kb.advisor import PlaceAdvisor
from kb.llama import LlamaCpp, embedded_model
from kb.ontology import Ontology
from sim.home import load_home

Order = Callable[[str], Sequence[str]]
"""From an object to the places where it may be, the likeliest first."""


def average_precision(order: Sequence[str], right: Iterable[str]) -> float:
    """Mean over the right places of the precision at their rank; 0 for one that is missing."""
    right = set(right)
    hits = [rank for rank, place in enumerate(order, start=1) if place in right]
    return sum(found / rank for found, rank in enumerate(hits, start=1)) / len(right)


def survey(ontology: Ontology) -> dict[str, tuple[str, ...]]:
    """One object of each row that names places of this home, and the places."""
    rows: dict[tuple[str, ...], str] = {}
    for name in ontology.objects():
        classes = ontology.classes_of(name)
        inherited = classes and ontology.default_locations(classes[0])
        rows.setdefault((classes[0],) if inherited else (name,), name)
    return {name: usual for name in rows.values() if (usual := ontology.usual_places(name))}


def wait(inbox: Inbox) -> Result:
    """The end of the request that is under way."""
    inbox.wait(None)
    (event,) = inbox.take_all()
    assert isinstance(event, Ended)
    return event.result


def ranking(adviser: PlaceAdvisor, model: LlamaCpp, inbox: Inbox) -> Order:
    """Score every place."""

    def order(name: str) -> Sequence[str]:
        model.rank(adviser.ranking(name, ()))
        scored = wait(inbox)
        assert isinstance(scored, Scored), scored
        return [candidate.place for candidate in adviser.ranked(scored)]

    return order


def writing(adviser: PlaceAdvisor, model: LlamaCpp, inbox: Inbox) -> Order:
    """Have a list written, and keep what exists."""

    def order(name: str) -> Sequence[str]:
        model.chat(adviser.inquiry(name, ()))
        replied = wait(inbox)
        assert isinstance(replied, Replied), replied
        return adviser.verify(adviser.read(replied.text) or (), ()).furniture

    return order


def chance(places: Sequence[Place], seed: int) -> Order:
    """Shuffle."""
    dice = random.Random(seed)
    return lambda name: dice.sample([place.name for place in places], len(places))


def report(title: str, order: Order, rows: dict[str, tuple[str, ...]], rounds: int) -> None:
    """Print one line of the table."""
    precisions, firsts, seconds = [], [], []
    for name, right in rows.items():
        for _ in range(rounds):
            began = time.monotonic()
            found = order(name)
            seconds.append(time.monotonic() - began)
            precisions.append(average_precision(found, right))
            firsts.append(bool(found) and found[0] in right)
    print(
        f"{title:24} {statistics.mean(precisions):8.2f} {statistics.mean(firsts):11.2f} "
        f"{statistics.median(seconds):9.2f}",
        flush=True,
    )


def compare(
    title: str, places: Sequence[Place], path: Path, rounds: int, threads: int | None
) -> None:
    """Print one table, for one set of places."""
    told, untold = Ontology(places), Ontology(places, defaults=False)
    rows = survey(told)
    print(f"\n{title}: {len(places)} places, {len(rows)} rows of the survey")
    print(f"{'':24} {'mAP':>8} {'first right':>11} {'s a call':>9}")
    report("chance", chance(places, 0), rows, 200)
    for name, grammar in (("rank", False), ("generate", False), ("generate, grammar", True)):
        inbox = Inbox()
        model = LlamaCpp(path, inbox, grammar=grammar, max_tokens=256, threads=threads)
        model.count_tokens("wait until it is loaded")
        adviser = PlaceAdvisor(untold, model, remembers=False)
        make = ranking if name == "rank" else writing
        report(name, make(adviser, model, inbox), rows, 1 if name == "rank" else rounds)
        model.close()


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--model", type=Path, help="a GGUF file; default: the embedded model")
    parser.add_argument("--home", default="four_rooms")
    parser.add_argument("--rounds", type=int, default=1, help="lists that are written an object")
    parser.add_argument("--threads", type=int, help="default: as the model chooses")
    given = parser.parse_args()
    try:
        path = given.model or embedded_model()
    except ModelError as error:
        parser.error(str(error))
    places = load_home(given.home).places()
    everywhere = Ontology(places)
    asked = {p for name in everywhere.objects() for p in everywhere.default_locations(name)}
    compare(given.home, places, path, given.rounds, given.threads)
    compare(
        "only where the survey has things",
        [place for place in places if place.name in asked],
        path,
        given.rounds,
        given.threads,
    )


if __name__ == "__main__":
    main()
