"""An ontology of one's own: a few lines of Turtle add a person, a taste, a name and a place.

    python docs/examples/own_ontology.py

The same on the command line, where `python -m kb check --kb FILE` names what is wrong with a file:

    python -m executive --kb docs/examples/anna.ttl --person Anna "Find a fruit"
"""

from pathlib import Path

from executive import Outcome, Session, load_settings

ANNA = Path(__file__).with_name("anna.ttl")


def find(words: str, runs: Path = Path("runs")) -> Outcome:
    """One mission with this ontology beside ours, which does without its default locations."""
    settings = load_settings(
        world="fake",
        user="none",  # nobody can be asked: what is known must be enough
        llm="none",
        kb=[ANNA],
        person="Anna",
        defaults=False,
        place={"hammer": "desk"},
        runs=runs,
    )
    with Session(settings) as robot:
        return robot.run(words)


if __name__ == "__main__":
    hammer = find("Find the whacker")
    print(f"{hammer.reason} ({hammer.source})")
    fruit = find("Find a fruit")
    print(f"The fruit is a {fruit.object}, as that is Anna's favourite.")
