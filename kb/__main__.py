"""`python -m kb`: look at the ontology, and look for faults in it."""

import argparse
import sys
from pathlib import Path

from executive.errors import ExecutiveError
from kb.ontology import Ontology


def show(ontology: Ontology, words: str) -> int:
    """Print what is known about each thing that the words name."""
    names = ontology.objects_named(words)
    if not names:
        nearest = " or ".join(ontology.nearest_names(words)) or ", ".join(ontology.objects())
        print(f"nothing is called {words!r}: did you mean {nearest}?", file=sys.stderr)
        return 1
    for name in names:
        print(name)
        for title, known in (
            ("also called", ontology.synonyms(name)),
            ("is a", ontology.classes_of(name)),
            ("usually at", ontology.default_locations(name)),
        ):
            print(f"  {title:12} {', '.join(known) or '-'}")
    return 0


def check(ontology: Ontology) -> int:
    """Print every fault."""
    faults = list(ontology.faults())
    for fault in faults:
        print(fault)
    print(f"{len(ontology.objects())} objects, {len(faults)} faults", file=sys.stderr)
    return 1 if faults else 0


def main(arguments: list[str] | None = None) -> int:
    """Run one command; 0: well, 1: nothing found, or faults found, 2: bad input."""
    parser = argparse.ArgumentParser(prog="python -m kb", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    shown = commands.add_parser("show", help="what is known about a thing")
    shown.add_argument("words", nargs="+", help="an object or a class: sugar box, fruit")
    checked = commands.add_parser("check", help="load the files and name their faults")
    checked.add_argument("files", nargs="*", type=Path, help="further OWL files (RDF/XML)")
    given = parser.parse_args(arguments)
    try:
        if given.command == "show":
            return show(Ontology(), " ".join(given.words))
        return check(Ontology(files=given.files))
    except ExecutiveError as error:
        print(error, file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
