"""How often the kind of a command is read right: `python tests/benchmarks/bench_understanding.py`.

Both lists were written before any of it was read: DEV chose the verbs of the grammar and
the prompt of the model, HELD_OUT did not. What the grammar reads the model never sees; what that
reads wrong is done without a question, while the person has to confirm what the model reads.
"""

import argparse
from collections import Counter
from pathlib import Path

from executive.events import Ended, Inbox
from executive.language.grammar import EnglishInterpreter
from executive.types.commands import CommandKind
from executive.types.results import Scored
from kb.advice.reader import Reader
from kb.llm.llama import LlamaCpp, embedded_model
from kb.ontology.ontology import Ontology

DEV = {
    CommandKind.FIND: (
        "The mug has vanished.",
        "Any idea where my scissors went?",
        "I can't see the hammer anywhere.",
        "Did somebody move the sugar box?",
        "Do we still have mustard?",
        "Show me where the drill is.",
        "I lost my tennis ball.",
        "Is the pitcher in the kitchen?",
    ),
    CommandKind.TAKE: (
        "Hold the hammer.",
        "Lift up the cracker box.",
        "Get hold of the mug.",
        "Keep the apple in your hand.",
        "Put your fingers around the banana.",
        "Could you hang on to the scissors?",
        "Seize the spatula.",
        "Pick the pear up.",
    ),
    CommandKind.BRING: (
        "Hand me the spatula.",
        "Pass me the sugar.",
        "I am hungry, an apple would do.",
        "I could use the wrench now.",
        "Let me have the scissors.",
        "Carry the mug over here.",
        "May I get the banana?",
        "The drill, please.",
    ),
}
HELD_OUT = {
    CommandKind.FIND: (
        "Where did I leave the mug?",
        "The scissors are missing.",
        "Tell me where the apple is.",
        "Somebody hid the hammer from me.",
        "Have we got any strawberries?",
        "I wonder where the spatula is.",
        "Check if the pudding box is around.",
        "My wrench has disappeared again.",
    ),
    CommandKind.TAKE: (
        "Clutch the banana.",
        "Would you hold on to the mug for me?",
        "Get the hammer into your gripper.",
        "Raise the sugar box.",
        "Collect the tennis ball.",
        "Lay your hand on the pitcher and hold it.",
        "Pick that orange up.",
        "Keep hold of the drill.",
    ),
    CommandKind.BRING: (
        "Pass the mustard, please.",
        "I would love a peach.",
        "Deliver the mug to me.",
        "Hand over the wrench.",
        "Could I get some soup?",
        "My nails need the hammer, come with it.",
        "I'm craving a banana.",
        "Come here with the scissors.",
    ),
}


def main() -> None:
    """Print what was read how, and the counts."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--model", type=Path, help="a GGUF file; default: the embedded model")
    parser.add_argument("--dev", action="store_true", help="leave the held-out sentences alone")
    given = parser.parse_args()
    inbox = Inbox()
    model = LlamaCpp(given.model or embedded_model(), inbox)
    reader, grammar = Reader(Ontology()), EnglishInterpreter()

    def by_model(words: str) -> CommandKind:
        model.rank(reader.ranking(words))
        inbox.wait(None)
        [event] = inbox.take_all()
        assert isinstance(event, Ended)
        assert isinstance(event.result, Scored), event.result
        return reader.ranked(event.result)

    lists = {"dev": DEV} if given.dev else {"dev": DEV, "held out": HELD_OUT}
    for title, sentences in lists.items():
        counts: Counter[str] = Counter()
        for kind, list_ in sentences.items():
            for words in list_:
                command = grammar.command(words)
                read, reader = (command.kind, "grammar") if command else (by_model(words), "model")
                counts[f"{reader} {'right' if read == kind else 'wrong'}"] += 1
                print(f"{title:9} {reader:8} {kind:6} {read:6} {words}", flush=True)
        print(f"{title}: {dict(counts)}", flush=True)
    model.close()


if __name__ == "__main__":
    main()
