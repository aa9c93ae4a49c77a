"""How fast places are ranked: `python tests/benchmarks/bench_ranking.py`.

What all inquiries have in common is read once: ahead of the first, as a session does while the
simulator starts, or else (`cold`) by the first. Those after it (medians) read only what is new; the
ratio is theirs to all that was read until the first was answered. On a busy machine the time on all
cores says more: two idle cores need half of it.
How good the ranking is, `python -m kb.benchmark` says.
"""

import argparse
import logging
import statistics
import threading
import time
from collections.abc import Callable, Sequence
from contextlib import closing
from itertools import product
from pathlib import Path

from executive.errors import ModelError
from executive.events import Ended, Inbox
from executive.types.llm import ChatRequest, RankRequest, Usage
from executive.types.results import Failed
from kb.advice.lister import Lister
from kb.advice.ranker import Ranker
from kb.llm.llama import LlamaCpp, embedded_model
from kb.llm.options import ModelOptions
from kb.ontology.ontology import Ontology
from sim.home.home_file import load_home

Ask = Callable[[str], int]
"""From an object to the request that asks for its places."""
Cost = tuple[float, float, float]
"""Evaluated tokens, seconds, seconds on all cores."""


def usage(inbox: Inbox) -> Usage:
    """What the request that is under way cost."""
    inbox.wait(None)
    (event,) = inbox.take_all()
    assert isinstance(event, Ended)
    assert not isinstance(event.result, Failed), event.result
    return event.result.usage


def prepare(model: LlamaCpp, request: ChatRequest | RankRequest) -> Cost:
    """What it costs to read ahead."""
    began, cpu_began = time.monotonic(), time.process_time()
    ended = threading.Event()

    def hear(record: logging.LogRecord) -> bool:
        ended.set()
        return False

    logger = logging.getLogger("kb.llm.llama")
    logger.setLevel(logging.INFO)
    logger.addFilter(hear)
    model.prepare(request)
    ended.wait()
    logger.removeFilter(hear)
    return 0, time.monotonic() - began, time.process_time() - cpu_began


def report(title: str, ask: Ask, inbox: Inbox, objects: Sequence[str], ahead: Cost) -> None:
    """Print one line of the table: preparation, the first inquiry, the median of the others."""
    costs: list[Cost] = []
    for name in objects:
        began, cpu_began = time.monotonic(), time.process_time()
        ask(name)
        cost = usage(inbox)
        ahead = ahead[0] + cost.prepared_tokens, *ahead[1:]
        costs.append(
            (cost.evaluated_tokens, time.monotonic() - began, time.process_time() - cpu_began)
        )
    later = [statistics.median(cost) for cost in zip(*costs[1:], strict=True)]
    tokens, seconds, cpu = zip(ahead, costs[0], later, strict=True)
    print(
        f"{title:48}"
        + "".join(f"{count:7.0f}" for count in tokens)
        + f"{tokens[2] / (tokens[0] + tokens[1]):7.2f}"
        + "".join(f"{value:7.2f}" for value in (*seconds, *cpu)),
        flush=True,
    )


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--model", type=Path, help="a GGUF file; default: the embedded model")
    parser.add_argument("--home", default="four_rooms")
    parser.add_argument("--threads", type=int, help="default: as the model chooses")
    given = parser.parse_args()
    try:
        path = given.model or embedded_model()
    except ModelError as error:
        parser.error(str(error))
    places = load_home(given.home).places()
    heads = ("ahead", "first", "later")
    print(f"{'':48}{'evaluated tokens':^28}{'seconds':^21}{'s of all cores':^21}")
    print(f"{'':48}" + "".join(f"{head:>7}" for head in (*heads, "ratio", *heads, *heads)))
    for writes, recorded, cold in product((False, True), repeat=3):
        inbox, knowledge = Inbox(), Ontology(places, defaults=recorded)
        with closing(
            LlamaCpp(path, inbox, ModelOptions(max_tokens=256), threads=given.threads)
        ) as model:
            model.count_tokens("wait until it is loaded")
            ranker, lister = Ranker(knowledge), Lister(knowledge, model, remembers=False)

            def rank(name: str) -> int:
                return model.rank(ranker.ranking(name, ()))  # noqa: B023 - called at once

            def write(name: str) -> int:
                return model.chat(lister.inquiry(name, ()))  # noqa: B023 - called at once

            known = "default locations" if recorded else "nothing"
            title = f"{'generate' if writes else 'rank'}, {known} recorded{', cold' * cold}"
            asks = lister.inquiry if writes else ranker.ranking
            ahead = (0.0, 0.0, 0.0) if cold else prepare(model, asks("thing", ()))
            report(title, write if writes else rank, inbox, knowledge.objects(), ahead)


if __name__ == "__main__":
    main()
