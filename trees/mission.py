"""The mission: from words to a deed, and to an honest word when it cannot be done.

understand ─> which object ─> search ──────────────────> grasp ───────────> act ─────> report
grammar       ontology        where the words say;      pick it up         find, take,
else LLM,     else person     else by one belief of     else look again    bring, put
confirmed     named places    memory, ontology, LLM     if gone, search    or put back;
  │           else ask        (verified) and person:    again              no room there:
  │           hand is free    look or ask, what costs                      other furniture
  │           else put away   less (or by the paper's)                     else person
  ├─> several things, one of several, on a condition: in parts, each a task of its own
  └─> put down what is held, go somewhere, clear furniture, or answer by looking around

Each of several tasks goes through all of it (`trees/tasks.py`), and none is lost if another fails.
"""

from py_trees.behaviour import Behaviour

from executive.types.home import PERSON
from trees.act import act, without_a_search
from trees.by_plan import search
from trees.context import MissionContext
from trees.deeds.deed import Conclude, meaning
from trees.driving import DriveBack
from trees.grasp import grasp
from trees.hand import arm_for_it, hand_is_free
from trees.nodes import Check, Optionally, sequence, stages
from trees.object import resolve_object
from trees.person import Apologise
from trees.places import named_places
from trees.search import eyes_for_it
from trees.several import is_in_parts, several
from trees.tasks import EachTask
from trees.understand import understand


def mission(context: MissionContext) -> Behaviour:
    """The whole tree, which runs once for each task.

    It always succeeds; how the mission ended is in the situation.
    """
    return EachTask(
        "mission",
        context,
        stages(
            "serve",
            understand(context),
            *arm_for_it(context),
            Check("about a thing to look for", context, lambda: is_about_one(context)),
            resolve_object(context),
            *eyes_for_it(context),
            named_places(context),
            hand_is_free(context),
            search(context),
            grasp(context),
            act(context),
            Conclude("done", context),
        ),
        several(context),
        *without_a_search(context),
        sequence("give up", come_back(context), Apologise("apologise", context)),
    )


def is_about_one(context: MissionContext) -> bool:
    """Whether the task is to look for one thing."""
    return meaning(context.situation).searches and not is_in_parts(context)


def come_back(context: MissionContext) -> Behaviour:
    """Return to the person, if the robot is away and has no other task.

    Not if the way to the person is what has just failed: if a second try succeeded, the apology
    would say that the robot could not come although it stands there.
    """
    dialogue, agenda = context.situation.dialogue, context.situation.agenda

    def is_away() -> bool:
        return dialogue.away and dialogue.heads_for != PERSON and not agenda.tasks

    return Optionally(
        "if away",
        context.situation,
        sequence(
            "come back",
            Check("is away", context, is_away),
            DriveBack("drive", context, PERSON),
        ),
    )
