"""How fast places are ranked: `python tests/benchmarks/bench_ranking.py`.

The first inquiry of a process reads what all have in common; those after it (medians) read only
what is new. On a busy machine the time on all cores says more: two idle cores need half of it.
How good the ranking is, `python -m kb.benchmark` says.
"""

import argparse
import statistics
import time
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

from executive.errors import ModelError
from executive.events import Ended, Inbox
from executive.types import Failed, Usage
from kb.advisor import PlaceAdvisor
from kb.llama import LlamaCpp, embedded_model
from kb.ontology import Ontology
from sim.home import load_home

Ask = Callable[[str], int]
"""From an object to the request that asks for its places."""


def usage(inbox: Inbox) -> Usage:
    """What the request that is under way cost."""
    inbox.wait(None)
    (event,) = inbox.take_all()
    assert isinstance(event, Ended)
    assert not isinstance(event.result, Failed), event.result
    return event.result.usage


def report(title: str, ask: Ask, inbox: Inbox, objects: tuple[str, ...]) -> None:
    """Print one line of the table: the first inquiry, the median of the others."""
    costs = []
    for name in objects:
        began, cpu_began = time.monotonic(), time.process_time()
        ask(name)
        tokens = usage(inbox).evaluated_tokens
        costs.append((tokens, time.monotonic() - began, time.process_time() - cpu_began))
    first, later = costs[0], [statistics.median(cost) for cost in zip(*costs[1:], strict=True)]
    print(
        f"{title:44} {first[0]:6} {later[0]:6.0f} {later[0] / first[0]:6.2f} "
        f"{first[1]:7.2f} {later[1]:7.2f} {first[2]:7.2f} {later[2]:7.2f}",
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
    print(f"{'':44} {'evaluated tokens':^20} {'seconds':^15} {'s of all cores':^15}")
    print(f"{'':44} {'first':>6} {'later':>6} {'ratio':>6}" + 2 * f" {'first':>7} {'later':>7}")
    for elicit in ("rank", "generate"):
        for defaults in (False, True):
            inbox, knowledge = Inbox(), Ontology(places, defaults=defaults)
            with closing(LlamaCpp(path, inbox, threads=given.threads, max_tokens=256)) as model:
                model.count_tokens("wait until it is loaded")
                adviser = PlaceAdvisor(knowledge, model, remembers=False)

                def rank(name: str) -> int:
                    return model.rank(adviser.ranking(name, ()))  # noqa: B023 - called at once

                def write(name: str) -> int:
                    return model.chat(adviser.inquiry(name, ()))  # noqa: B023 - called at once

                ask = rank if elicit == "rank" else write
                known = "default locations" if defaults else "nothing"
                title = f"{elicit}, {len(places)} places, {known} recorded"
                report(title, ask, inbox, knowledge.objects())


if __name__ == "__main__":
    main()
