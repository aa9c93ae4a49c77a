"""A home of one's own: a TOML file says what is where.

    python docs/examples/own_home.py

The same on the command line, where `python -m sim check FILE` names what is wrong with a home, and
`python -m sim view FILE` draws it from above:

    python -m executive --home docs/examples/own_home.toml --world fake "Bring the sugar_box"
"""

from pathlib import Path

from executive import Outcome, Session, load_settings

HOME = Path(__file__).with_name("own_home.toml")


def bring(words: str, runs: Path = Path("runs")) -> Outcome:
    """One mission in this home; names and rooms are in the file, and nowhere in the program."""
    settings = load_settings(home=str(HOME), world="fake", user="oracle", llm="none", runs=runs)
    with Session(settings) as robot:
        return robot.run(words)


if __name__ == "__main__":
    print(bring("Bring the sugar_box").reason)
