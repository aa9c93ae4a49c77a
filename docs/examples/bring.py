"""The smallest program: one mission, and what came of it.

    python docs/examples/bring.py

`world="fake"` is the instant world; leave it out for PyBullet, and `user` and `llm` out for a
person at the terminal and the language model that comes with the package.
"""

from pathlib import Path

from executive import Outcome, Session, load_settings


def bring(words: str, runs: Path = Path("runs")) -> Outcome:
    """One mission; a closed session has freed robot, model and memory."""
    settings = load_settings(world="fake", user="oracle", llm="none", runs=runs)
    with Session(settings) as robot:
        return robot.run(words)


if __name__ == "__main__":
    outcome = bring("Bring a sugar_box")
    print(f"{outcome.status}: {outcome.reason}")
    print(f"who knew where: {outcome.source}; questions to the person: {outcome.inquiries}")
    print(f"see why: python -m logs why {outcome.run_dir}")
