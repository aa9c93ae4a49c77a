"""How long "where may it be?" takes without a model: `python tests/benchmarks/bench_location.py`.

Asks memory, then the ontology, as a mission does, in homes of 10 to 100,000 pieces of furniture and
with a file of facts: of all kinds about 22 things at random, or all about one thing, which was seen
everywhere and then looked for there in vain. The file is on disk, as with `--memory`. Each thing is
asked for many times; its median counts, so that what else the machine does does not.
"""

import argparse
import random
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from executive.types.home import Place
from kb.facts import Fact, FactKind, FactStore
from kb.ontology.ontology import Ontology

KINDS = ("Table", "Desk", "Cabinet", "Shelf", "Bed", "Sofa")
PIECES_A_ROOM = 10
ROUNDS = 100


def home(size: int) -> list[Place]:
    """Furniture in rooms, with the survey's places among it."""
    names = ["shelf_lobby", "counter_wagon", "desk", *(f"piece_{n}" for n in range(size))][:size]
    return [
        Place(name, KINDS[n % len(KINDS)], f"room_{n // PIECES_A_ROOM}", "Bedroom")
        for n, name in enumerate(names)
    ]


def mixed(places: list[Place], things: tuple[str, ...], count: int) -> Iterator[Fact]:
    """Facts of all kinds, at random."""
    dice, kinds = random.Random(0), list(FactKind)
    for n in range(count):
        yield Fact(dice.choice(kinds), dice.choice(things), dice.choice(places).name, float(n))


def in_vain(places: list[Place], things: tuple[str, ...], count: int) -> Iterator[Fact]:
    """One thing, seen at every place, then looked for in vain there, over and over."""
    for n in range(count):
        kind = FactKind.MISSED if n // len(places) % 2 else FactKind.SEEN
        yield Fact(kind, things[0], places[n % len(places)].name, float(n))
    for place in places:
        yield Fact(FactKind.MISSED, things[0], place.name, float(count))


def ask(known: Ontology, facts: FactStore, name: str) -> tuple[str, ...]:
    """Where it may be, by memory, else by the ontology."""
    remembered = tuple(filter(known.has_place, facts.places_of(name)))
    return remembered or known.usual_places(name)


def seconds(known: Ontology, facts: FactStore, name: str) -> float:
    """How long the question takes, as a rule."""
    times = []
    for _ in range(ROUNDS):
        began = time.perf_counter()
        ask(known, facts, name)
        times.append(time.perf_counter() - began)
    return statistics.median(times)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--facts", type=int, default=1_000_000)
    parser.add_argument("--furniture", type=int, nargs="*", default=[10, 1000, 100_000])
    given = parser.parse_args()
    print(f"{'furniture':>9} {'facts':8} {'middle thing, ms':>17} {'slowest thing, ms':>18}")
    for size in given.furniture:
        places = home(size)
        known = Ontology(places)
        things = known.objects()
        makers: tuple[Callable[..., Iterator[Fact]], ...] = (mixed, in_vain)
        for make in makers:
            with tempfile.TemporaryDirectory() as folder:
                facts = FactStore(Path(folder) / "facts")
                facts.load(make(places, things, given.facts))
                times = sorted(seconds(known, facts, thing) for thing in things)
                facts.close()
            middle, slowest = 1000 * statistics.median(times), 1000 * times[-1]
            title = make.__name__.replace("_", " ")
            print(f"{size:9} {title:8} {middle:17.3f} {slowest:18.3f}", flush=True)


if __name__ == "__main__":
    main()
