"""Does an invented place ever get through? `python tests/benchmarks/bench_verification.py`.

First real replies: the embedded model is asked, with every prompt for every object, to write
freely, held to the output format (any names), and held to the schema (known names only), at
several temperatures. They are kept in a file, so that sampling can be stopped and goes on where it
was. Then garbage from hostile_replies.py. Every reply goes the way that it goes in a mission: it is
read, and its names are verified.
"""

import argparse
import json
import sys
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import islice
from pathlib import Path

from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from executive.events import Ended, Inbox
from executive.language.phrases import spoken
from executive.types.llm import ChatRequest
from executive.types.results import Replied
from kb.advice.lister import Lister
from kb.advice.verification import Reply
from kb.llm.llama import LlamaCpp, embedded_model
from kb.llm.options import ModelOptions
from kb.llm.scripted import Scripted
from kb.ontology.ontology import Ontology
from sim.home.home_file import load_home

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

TEMPERATURES = (0.6, 0.9, 1.2, 1.5)
WAYS = ("freely", "in the format", "with known names")
LABELS = ("general_pos", "multiple_pos", "furniture", "again")
MAX_TOKENS = 128
ROOM = "kitchen"

KNOWN = Ontology(load_home("four_rooms").places(), defaults=False)
TOLD = Ontology(load_home("four_rooms").places())
FURNITURE = {place.name for place in KNOWN.places()}
ROOMS = {place.room for place in KNOWN.places()}


@dataclass
class Tally:
    """What became of the names in some replies."""

    counts: Counter[str] = field(default_factory=Counter)
    otherwise: Counter[str] = field(default_factory=Counter)
    """What passed though it was not written as the home file has it."""
    slowest_s: float = 0.0

    def add(self, text: str, among: tuple[str, ...]) -> None:
        """Read and verify one reply; fail if anything unknown passes."""
        began = time.thread_time()
        names = LISTER.read(text)
        verdict = LISTER.verify(names or (), among)
        self.slowest_s = max(self.slowest_s, time.thread_time() - began)
        assert set(verdict.furniture) <= (set(among) or FURNITURE), (text, verdict)
        assert set(verdict.rooms) <= ROOMS, (text, verdict)
        self.counts["replies"] += 1
        self.counts["in the format"] += names is not None
        self.counts["names"] += len(names or ())
        self.counts["invented"] += len(LISTER.verify(verdict.dropped, ()).dropped)
        self.counts["nothing left"] += not (verdict.furniture or verdict.rooms)
        for name in {*(names or ())} - {*verdict.dropped}:
            if spoken(name) not in map(spoken, FURNITURE | ROOMS):
                self.otherwise[name] += 1

    def row(self, title: str) -> str:
        """One line of the table."""
        c, percent = self.counts, 100 / self.counts["replies"]
        return (
            f"{title:34} {c['replies']:8} {c['in the format'] * percent:8.0f} {c['names']:8}"
            f" {c['invented'] * percent:12.0f} {c['nothing left'] * percent:8.0f}"
            f" {1000 * self.slowest_s:8.1f}"
        )


LISTER = Lister(KNOWN, Scripted([], Inbox()), remembers=False)


def requests() -> Iterator[tuple[str, ChatRequest, tuple[str, ...]]]:
    """Each object and prompt, and the places that are allowed (none given: all)."""
    for name in KNOWN.objects():
        usual = TOLD.usual_places(name) or ("desk", "sofa")
        yield name, LISTER.inquiry(name, ()), ()
        yield name, LISTER.inquiry(name, usual), usual
        yield name, LISTER.furniture(name, ROOM, ()), ()
        yield name, LISTER.again(name, ()), ()


def ask(model: LlamaCpp, inbox: Inbox, request: ChatRequest) -> str:
    """What the model writes."""
    model.chat(request)
    inbox.wait(None)
    [event] = inbox.take_all()
    assert isinstance(event, Ended)
    assert isinstance(event.result, Replied), event.result
    return event.result.text


def sample(cache: Path, objects: int, threads: int | None) -> None:
    """Fill the file with what is still missing in it."""
    cache.parent.mkdir(parents=True, exist_ok=True)
    cache.touch()
    with cache.open("r+b") as file:  # a line that was cut off is written again
        file.truncate(file.read().rfind(b"\n") + 1)
    done = set(read_cache(cache))
    todo = [
        ((way, temperature, request.label, name), request)
        for temperature in TEMPERATURES
        for way in WAYS
        for name, request, _ in islice(requests(), len(LABELS) * objects)
        if (way, temperature, request.label, name) not in done
    ]
    before, model, inbox = None, None, Inbox()
    with cache.open("a", encoding="utf-8") as file:
        for number, (key, request) in enumerate(todo, start=1):
            way, temperature, label, name = key
            if (way, temperature) != before:
                if model:
                    model.close()
                before, inbox = (way, temperature), Inbox()
                model = LlamaCpp(
                    embedded_model(),
                    inbox,
                    ModelOptions(
                        temperature=temperature, max_tokens=MAX_TOKENS, grammar=way != "freely"
                    ),
                    threads=threads,
                )
            if way == "in the format":
                request = replace(request, schema=Reply.model_json_schema())
            assert model
            file.write(json.dumps([*key, ask(model, inbox, request)]) + "\n")
            file.flush()
            print(f"\r{len(done) + number} replies", end="", file=sys.stderr, flush=True)
    if model:
        model.close()
        print(file=sys.stderr)


def read_cache(cache: Path) -> dict[tuple[str, float, str, str], str]:
    """The replies in the file."""
    replies = {}
    for line in cache.read_text(encoding="utf-8").splitlines():
        *key, text = json.loads(line)
        replies[tuple(key)] = text
    return replies


def report_real(cache: Path) -> Tally:
    """Print a line for each way and temperature."""
    among = {(request.label, name): allowed for name, request, allowed in requests()}
    tallies: dict[str, Tally] = {}
    everything = Tally()
    for (way, temperature, label, name), text in read_cache(cache).items():
        tally = tallies.setdefault(f"{way}, temperature {temperature}", Tally())
        for each in (tally, everything):
            each.add(text, among[label, name])
    for title, tally in sorted(tallies.items(), key=lambda item: WAYS.index(item[0].split(",")[0])):
        print(tally.row(title))
    return everything


def report_garbage(count: int) -> None:
    """Print a line for as many replies as hypothesis makes up."""
    from hostile_replies import replies

    tally = Tally()

    @settings(
        max_examples=count,
        database=None,
        deadline=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @given(replies, st.sets(st.sampled_from(sorted(FURNITURE)), max_size=3))
    def verify(reply: str, among: set[str]) -> None:
        tally.add(reply, tuple(among))

    verify()
    print(tally.row("garbage"))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cache", type=Path, default=Path("runs/verification.jsonl"))
    parser.add_argument("--objects", type=int, default=22, help="how many are asked about")
    parser.add_argument("--garbage", type=int, default=10_000)
    parser.add_argument("--threads", type=int, help="default: as the model chooses")
    given_ = parser.parse_args()
    sample(given_.cache, given_.objects, given_.threads)
    print(
        f"{'':34} {'replies':>8} {'format %':>8} {'names':>8} {'invented/100':>12}"
        f" {'none %':>8} {'ms':>8}"
    )
    everything = report_real(given_.cache)
    report_garbage(given_.garbage)
    print("\npassed, though written otherwise than the home file has it:")
    for name, times in everything.otherwise.most_common():
        print(f"  {times:4} {name!r}: {LISTER.verify((name,), ())}")


if __name__ == "__main__":
    main()
