"""`python -m kb`: look at what the robot knows, and look for faults in it."""

from executive.start import begin

if __name__ == "__main__":
    begin()

import argparse
import json
import sys
import time
from collections.abc import Iterable, Sequence
from contextlib import closing
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from executive.errors import InputError
from executive.shell import DONE, NOT_DONE, entry_point
from executive.text import counted, printable
from executive.usage import Parser

if TYPE_CHECKING:  # a command imports what it needs
    from kb.facts import Fact, FactStore
    from kb.ontology.ontology import Ontology


def show(ontology: "Ontology", words: str) -> int:
    """Print what is known about each thing that the words name."""
    names = ontology.objects_named(words)
    if not names:
        nearest = " or ".join(ontology.nearest_names(words)) or ", ".join(ontology.objects())
        said = f"nothing is called {printable(words)!r}: did you mean {nearest}?"
        print(printable(said), file=sys.stderr)
        return NOT_DONE
    for name in names:
        print(printable(name))
        for title, known in (
            ("also called", ontology.synonyms(name)),
            ("is a", ontology.classes_of(name)),
            ("color", ontology.colors(name)),
            ("shape", ontology.shapes(name)),
            ("use", ontology.uses(name)),
            ("usually at", ontology.among(name)),
            ("preferred by", ontology.preferred_by(name)),
        ):
            print(printable(f"  {title:12} {', '.join(known) or '-'}"))
    return DONE


def check(ontology: "Ontology") -> int:
    """Print every fault, and notes on what is not used; 1 if there are faults."""
    faults = list(ontology.faults())  # they say, too, why a file adds nothing
    missed = ontology.unmet_imports() if faults else ontology.warnings()
    notes = [*missed, *ontology.unused()]
    for line in (*faults, *(f"note: {note}" for note in notes)):
        print(printable(line))
    counts = f"{len(ontology.objects())} objects, {len(faults)} faults"
    print(counts + (f", {len(notes)} notes" if notes else ""), file=sys.stderr)
    return 1 if faults else 0


def query(ontology: "Ontology", sparql: str, as_json: bool) -> int:
    """Print the answer to a SELECT; 1 if it is empty."""
    table = ontology.query(sparql)
    if as_json:
        print(json.dumps([dict(zip(table.columns, row, strict=True)) for row in table.rows]))
    else:
        lines = [tuple(map(printable, row)) for row in (table.columns, *table.rows)]
        widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
        for line in lines:
            padded = (cell.ljust(width) for cell, width in zip(line, widths, strict=True))
            print("  ".join(padded).rstrip())
    return 0 if table.rows else 1


def facts(file: Path, as_json: bool) -> int:
    """Print every fact, oldest first."""
    with closing(_memory(file, learns=False)) as memory:
        known = memory.all()
    if as_json:
        print(json.dumps([asdict(fact) for fact in known]))
        return DONE
    now = _now(known)
    for fact in known:
        thing, place = printable(fact.object), printable(fact.place)
        print(f"{thing:20} {fact.kind:6} {place:20} {age(now - fact.time_s)} ago")
    print(f"{len(known)} facts", file=sys.stderr)
    return DONE


def explain(file: Path, home: str, words: str) -> int:
    """Print where things are likely to be now, and habits; with words, only about these things."""
    from kb.experience import MOST_LEARNED, Experience
    from kb.explaining import habits, lines
    from kb.ontology.ontology import Ontology
    from sim.home.home_file import load_home

    ours = load_home(home)
    ontology = Ontology(ours.places(), things=ours.things())
    with closing(_memory(file, learns=False)) as memory:
        now_s = _now(memory.since(0, MOST_LEARNED)[0])
        experience = Experience(memory, ontology.class_of, lambda: now_s)
        experience.learn()
        named = ontology.objects_named(words) or (words,) if words else experience.things()
        told = [*lines(experience, named), *([] if words else habits(experience))]
    for line in told:
        print(printable(line))
    return DONE if told else NOT_DONE


def _now(known: Iterable["Fact"]) -> float:
    """The time (UTC, s); that of the last fact if it is later, as after a faster simulation."""
    return max([time.time(), *(fact.time_s for fact in known)])


def forget(file: Path, words: str) -> int:
    """Remove the facts about the things that the words name; without words, all facts."""
    from kb.ontology.ontology import Ontology

    names = Ontology().objects_named(words) or (words,) if words else (None,)
    with closing(_memory(file)) as memory:
        print(f"{sum(memory.forget(name) for name in names)} facts forgotten", file=sys.stderr)
    return DONE


def age(seconds: float) -> str:
    """A duration in the largest unit that fits: "3 hours"."""
    for unit, length in (("days", 86400), ("hours", 3600), ("minutes", 60)):
        if seconds >= 2 * length:
            return f"{seconds / length:.0f} {unit}"
    return counted(round(max(0.0, seconds)), "second")


def _ontology(given: argparse.Namespace, files: Sequence[Path] = ()) -> "Ontology":
    """The ontology that a mission with the same options would have."""
    from kb.ontology.ontology import Ontology
    from sim.home.home_file import load_home

    home, own = load_home(given.home), [*given.kb, *files]
    ontology = Ontology(
        home.places(),
        things=home.things(),
        defaults=given.defaults,
        files=own,
        home=home.file,
    )
    if given.command != "check":
        for warning in ontology.warnings():
            print(printable(f"warning: {warning}"), file=sys.stderr)
    return ontology


def _memory(file: Path, *, learns: bool = True) -> "FactStore":
    from kb.facts import FactStore

    if not file.exists():
        raise InputError(str(file), "there is no such file", "name the one of --memory")
    return FactStore(file, learns=learns)


@entry_point
def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; return 0 (done), 1 (nothing found, or faults) or 2 (bad input)."""
    given = parser().parse_args(arguments)
    match given.command:
        case "show":
            return show(_ontology(given), " ".join(given.words))
        case "check":
            return check(_ontology(given, given.files))
        case "query":
            return query(_ontology(given), given.sparql, given.json)
        case "facts" if given.learned or given.words:
            return explain(given.memory, given.home, " ".join(given.words))
        case "facts":
            return facts(given.memory, given.json)
        case _:
            return forget(given.memory, " ".join(given.words))


def parser() -> argparse.ArgumentParser:
    """The command line."""
    p = Parser(prog="python -m kb", description=__doc__)
    commands = p.add_subparsers(dest="command", required=True, metavar="COMMAND")
    shown = commands.add_parser("show", help="what is known about a thing")
    shown.add_argument("words", nargs="+", help="an object or a class: sugar box, fruit")
    checked = commands.add_parser("check", help="load the files and name their faults")
    checked.add_argument(
        "files", nargs="*", type=Path, help="further OWL files (RDF/XML or Turtle)"
    )
    asked = commands.add_parser("query", help="ask the ontology in SPARQL")
    asked.add_argument("sparql", help='"SELECT ?x WHERE { ?x rdfs:subClassOf household:Fruit }"')
    for command in (shown, checked, asked):
        _add_knowledge(command)
    remembered = commands.add_parser(
        "facts", help="what was seen, missed, looked at, said, taken and put"
    )
    for command in (asked, remembered):
        command.add_argument("--json", action="store_true", help="print JSON")
    remembered.add_argument(
        "words",
        nargs="*",
        metavar="OBJECT",
        help="what was learned of this: where it is now, and why",
    )
    remembered.add_argument(
        "--learned", action="store_true", help="what was learned of all things, and of habits"
    )
    _add_home(remembered, "whose things")
    forgotten = commands.add_parser("forget", help="remove facts")
    forgotten.add_argument("words", nargs="*", metavar="OBJECT", help="about this; none: all")
    for command in (remembered, forgotten):
        command.add_argument(
            "--memory", required=True, type=Path, metavar="FILE", help="as given to missions"
        )
    return p


def _add_knowledge(command: argparse.ArgumentParser) -> None:
    """Add the options for the content of the ontology."""
    own = "own OWL file: adds to ours, or replaces the one with the same ontology IRI"
    command.add_argument("--kb", action="append", default=[], type=Path, metavar="FILE", help=own)
    _add_home(command, "whose furniture")
    command.add_argument(
        "--defaults",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="whether to load defaults.owl (default: yes)",
    )


def _add_home(command: argparse.ArgumentParser, whose: str) -> None:
    command.add_argument(
        "--home",
        default="four_rooms",
        metavar="NAME or FILE.toml",
        help=f"{whose} (default: four_rooms)",
    )


if __name__ == "__main__":
    sys.exit(main())
