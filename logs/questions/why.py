"""Why the robot did it: the chain from words to deed, read from the recorded ticks.

Every fallback of the tree is a decision. Its children are the alternatives: the one that succeeded
was taken, those before it failed and said why, those after it were not needed.
"""

import re
from collections import defaultdict
from collections.abc import Callable, Container, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from heapq import merge
from itertools import islice
from typing import Any

from executive.belief import PLAN
from executive.events import Heard, Started
from executive.records import (
    Activity,
    EventTaken,
    Intervention,
    LlmCall,
    NodeShape,
    NodeState,
    Planned,
    Tick,
    TreeShape,
    Utterance,
    Verified,
)
from executive.situation import TAKEN_BACK
from executive.text import printable
from executive.types.knowledge import Candidate
from executive.types.results import Scored
from logs.questions.interventions import EXPERIMENTER, done
from logs.recording.reader import At, Run

WORLD = "world"
"""Whose doing an ordered fault is."""
PERSON, EYES = "person", "eyes"
"""Who says what was heard, and what was looked at."""
LOOK_OR_ASK = "look or ask"
"""What a plan settles."""
MOST_TOLD, LEAST = 5, 0.005
"""So many places that are less likely are told of, if they are as likely as this."""
NOT_NEEDED = "not needed"
SOMETHING = "something"
_VERB = re.compile(r"\b(is|was|may)\b")


@dataclass(frozen=True, slots=True)
class Alternative:
    """What could have been instead, and why it was not."""

    what: str
    why_not: str


@dataclass(frozen=True, slots=True)
class Decision:
    """One link of the chain.

    Attributes:
        time_s: mission time at which it was settled.
        question: what was to be settled, as the tree names it.
        answer: what came of it.
        source: as the behaviour declares it: `person`, `ontology`, `llm`, `user`; or `eyes`,
            `world` or `experimenter`; empty where the tree itself decides.
        by: the behaviour that settled it.
        alternatives: what was not taken.
    """

    time_s: float
    question: str
    answer: str
    source: str
    by: str
    alternatives: tuple[Alternative, ...] = ()


def why(run: Run) -> list[Decision]:
    """Every decision of a mission, in order, up to how it ended; and what went wrong by order."""
    planned = (
        Decision(at.time_s, LOOK_OR_ASK, at.value.text, "", "", tuple(_less_likely(at.value)))
        for at in run.records(Planned)
    )
    ordered = (
        Decision(at.time_s, "fault", f"{at.value.fault}: {at.value.text}", WORLD, "")
        for at in run.mishaps()
    )
    chain = merge(
        _asked(run),
        ordered,
        _stepped_in(run),
        _heard(run),
        _Chain(run).decisions(),
        planned,
        key=lambda d: d.time_s,
    )
    decisions = list(chain)
    outcome = run.outcome()
    if outcome is not None:
        ending = outcome.reason or outcome.status
        decisions.append(Decision(outcome.mission_time_s, "outcome", ending, "", outcome.status))
    return decisions


def _asked(run: Run) -> Iterator[Decision]:
    """The words that the mission began with."""
    for at in run.records(EventTaken):
        match at.value.event:
            case Started(words):
                yield Decision(at.time_s, "asked", f"'{words}'", PERSON, "")


def _stepped_in(run: Run) -> Iterator[Decision]:
    """What an experimenter did, in the person's stead or the robot's."""
    for at in run.records(Intervention):
        who = at.value.by
        yield Decision(at.time_s, f"{who} stepped in", done(at.value), EXPERIMENTER, who)


def _heard(run: Run) -> Iterator[Decision]:
    """What the person said unasked, and what the robot answered."""
    waiting: list[At[Heard]] = []
    for at in run.records(EventTaken, Utterance):
        match at.value:
            case EventTaken(Heard() as heard):
                waiting.append(At(at.time_s, heard))
            case Utterance(speaker="robot", text=answer) if waiting:
                before = waiting.pop(0)
                yield Decision(before.time_s, f"heard '{before.value.words}'", answer, PERSON, "")


class _Chain:
    """Follows the fallbacks of one mission from tick to tick."""

    def __init__(self, run: Run) -> None:
        self._run = run
        self._family = _Family(run.tree())
        self._searches = {n.path for n in run.tree().nodes if n.activity == Activity.SEARCHING}
        self._reasons: dict[str, str] = {}
        self._thoughts: list[LlmCall | Verified] = []

    def decisions(self) -> Iterator[Decision]:
        before: At[Tick] | None = None
        for thought in self._run.thoughts():
            if not isinstance(thought.value, Tick):
                self._thoughts.append(thought.value)
                continue
            at = At(thought.time_s, thought.value)
            states = {node.path: node for node in at.value.nodes}
            yield from _visits(before, at, self._searches)
            ended = [*_parts_ended(before, at), *_tasks_ended(before, at)]
            goes_on = bool(ended) and _goes_on(at)
            if goes_on:  # what is settled in this tick is so for the next task
                yield from ended
                self._reasons.clear()
                self._thoughts.clear()
            anew = goes_on or before is None
            yield from _split(before, at)
            settled = list(_outermost(self._settled(at, states, None if anew else before)))
            yield from settled
            yield from _where_to_look(before, at, {d.answer for d in settled})
            if not goes_on:
                yield from ended
            self._remember(states)
            before = at

    def _settled(
        self, at: At[Tick], states: dict[str, NodeState], before: At[Tick] | None
    ) -> Iterator[Decision]:
        """What was settled in a tick: what was not so before."""
        earlier = {node.path: node.status for node in before.value.nodes} if before else {}
        for fallback in self._family.fallbacks:
            status = states[fallback.path].status
            if status in ("SUCCESS", "FAILURE") and earlier.get(fallback.path) != status:
                decision = self._decision(at, fallback, states)
                if decision.source != PLAN or _failed(decision):  # a plan has a record of its own
                    yield decision

    def _decision(
        self, at: At[Tick], fallback: NodeShape, states: dict[str, NodeState]
    ) -> Decision:
        alternatives: list[Alternative] = []
        taken: NodeShape | None = None
        for child in self._family.children[fallback.path]:
            if taken is not None:
                alternatives.append(Alternative(child.name, NOT_NEEDED))
            elif states[child.path].status == "SUCCESS":
                taken = child
            elif child.source != PLAN and (reason := self._reason(child, states)):
                alternatives.append(Alternative(child.name, reason))
        if taken is None:
            return Decision(at.time_s, fallback.name, "nothing worked", "", "", tuple(alternatives))
        last = self._last(taken, lambda leaf: states[leaf.path].status == "SUCCESS") or taken
        if last.source:
            alternatives += dict.fromkeys(self._passed_over(at))
        return Decision(
            time_s=at.time_s,
            question=fallback.name,
            answer=states[last.path].message or taken.name,
            source=last.source,
            by=last.path,
            alternatives=tuple(alternatives),
        )

    def _passed_over(self, at: At[Tick]) -> Iterator[Alternative]:
        """What the model named or scored since the last such decision, and did not come through."""
        situation = at.value.situation
        taken = {c["place"] for c in situation.get("candidates") or ()}
        taken.add((situation.get("command") or {}).get("kind"))
        for thought in self._thoughts:
            if isinstance(thought, LlmCall):
                yield from (a for a in _outranked(thought) if a.what not in taken)
                continue
            among = bool(situation.get("among"))
            why_not = "none of its usual places" if among else "no such place here"
            yield from (Alternative(name, why_not) for name in thought.dropped)
        self._thoughts.clear()

    def _reason(self, child: NodeShape, states: dict[str, NodeState]) -> str:
        """Why a child failed: the message of the last leaf in it that failed, now or before.

        Empty if none has: there was nothing to try.
        """
        leaf = self._last(
            child, lambda leaf: states[leaf.path].status == "FAILURE" or leaf.path in self._reasons
        )
        if leaf is None:
            return ""
        now = states[leaf.path]
        said = now.message if now.status == "FAILURE" else self._reasons[leaf.path]
        return said or ("no" if leaf is child else denied(leaf.name))

    def _last(self, node: NodeShape, holds: Callable[[NodeShape], bool]) -> NodeShape | None:
        return next(filter(holds, reversed(self._family.leaves[node.path])), None)

    def _remember(self, states: dict[str, NodeState]) -> None:
        for path, state in states.items():
            if state.status == "FAILURE":
                self._reasons[path] = state.message
            elif state.status == "SUCCESS":
                self._reasons.pop(path, None)


class _Family:
    """Who is whose child; fallbacks in the order in which they are settled: inner ones first."""

    def __init__(self, tree: TreeShape) -> None:
        self.children: dict[str, list[NodeShape]] = defaultdict(list)
        for node in tree.nodes:
            self.children[node.parent].append(node)
        nodes = {node.path: node for node in tree.nodes}
        self.leaves: dict[str, list[NodeShape]] = defaultdict(list)
        """Of each behaviour the leaves in it, itself if it is one."""
        for leaf in (node for node in tree.nodes if node.path not in self.children):
            above: NodeShape | None = leaf
            while above is not None:
                self.leaves[above.path].append(leaf)
                above = nodes.get(above.parent)
        self.fallbacks = [
            node
            for root in self.children[""]
            for node in self._inner_first(root)
            if node.kind == "selector" and node.parent
        ]

    def _inner_first(self, node: NodeShape) -> Iterator[NodeShape]:
        for child in self.children.get(node.path, ()):
            yield from self._inner_first(child)
        yield node


def _outermost(settled: Iterable[Decision]) -> Iterator[Decision]:
    """Of nested decisions that one behaviour settled the outer one, with what none of them took."""
    last: Decision | None = None
    for decision in settled:
        if last is not None and last.by and last.by == decision.by:
            spared = (*decision.alternatives, *last.alternatives)
            decision = replace(decision, alternatives=spared)
        elif last is not None:
            yield last
        last = decision
    if last is not None:
        yield last


def _failed(decision: Decision) -> bool:
    """Whether anything else had been tried in vain."""
    return any(a.why_not != NOT_NEEDED for a in decision.alternatives)


def _split(before: At[Tick] | None, at: At[Tick]) -> Iterator[Decision]:
    """That the task at hand is done in parts, and which of them is the first."""
    was, now = _before_and_now(before, at)
    wholes = now.get("wholes") or []
    if len(wholes) > len(was.get("wholes") or ()) and now.get("command"):
        first = f"{_named(wholes[-1])}: first {_named(now['command'])}"
        yield Decision(at.time_s, "in parts", first, "", at.value.tip)


def _where_to_look(
    before: At[Tick] | None, at: At[Tick], told: Container[str]
) -> Iterator[Decision]:
    """The places that somebody named, unless that was told, or a plan tells it."""
    was, now = _before_and_now(before, at)
    places = now.get("candidates") or ()
    if not places or places == was.get("candidates") or now.get("plan"):
        return
    named = ", ".join(str(Candidate(**place)) for place in places)
    if named not in told:
        yield Decision(at.time_s, "which places", named, places[0]["source"], at.value.tip)


def _visits(before: At[Tick] | None, at: At[Tick], searches: Container[str]) -> Iterator[Decision]:
    """Where the thing was looked for, told when the robot is through with the place.

    `searches` are the paths of what serves to look for it.
    """
    was, now = _before_and_now(before, at)
    if before is None or not was.get("candidate"):
        return
    place = was["candidate"]["place"]
    tip = before.value.tip
    is_left = now.get("candidate") != was.get("candidate") or not _runs(searches, at)
    is_tried = _runs(searches, before) and is_left
    unreached, earlier = now.get("unreached") or {}, was.get("unreached") or {}
    was_taken_back = any(task["reason"] == TAKEN_BACK for task in _ended(before, at))
    for lost, why_not in unreached.items():
        again = is_tried and lost == place and not was_taken_back
        if lost not in earlier or again:
            yield Decision(at.time_s, f"look at {lost}", f"not reached: {why_not}", "", tip)
    if now.get("found"):
        if not was.get("found"):
            yield Decision(at.time_s, f"look at {place}", "seen there", EYES, tip)
    elif is_tried and place not in unreached and place in (was.get("visited") or ()):
        if _is_given_up(before, at):
            yield Decision(at.time_s, f"look at {place}", "given up", PERSON, tip)
            return
        yield Decision(at.time_s, f"look at {place}", _seen(before, at, place), EYES, tip)


def _seen(before: At[Tick], at: At[Tick], place: str) -> str:
    """What came of a look at a place: for the thing, or all around."""
    was, now = before.value.situation, at.value.situation
    if why_not := (now.get("unseen") or {}).get(place):
        return f"not all of it seen: {why_not}"
    ended = next(iter(_ended(before, at)), None)
    if place not in (was.get("seen") or {}):
        return "seen there" if ended and ended["location"] == place else "not seen there"
    if place in (now.get("seen") or {}):
        there = now["seen"][place]
    elif ended:
        there = ended.get("things") or ()
    else:  # each thing there is a part of the task now
        parts = (now["command"], *(now.get("tasks") or ()))
        there = [part["target"] for part in parts if part.get("source") == place]
    return f"seen there: {', '.join(there)}" if there else "not seen there"


def _is_given_up(before: At[Tick], at: At[Tick]) -> bool:
    """Whether the task was, for what the person said meanwhile."""
    was, now = before.value.situation, at.value.situation
    for task in _ended(before, at):
        return bool(task["reason"] == TAKEN_BACK)
    wholes = now.get("wholes") or []
    if len(wholes) > len(was.get("wholes") or ()) and wholes[-1] == was.get("command"):
        return False  # it goes on in parts
    return now.get("command") != was.get("command") or not now.get("visited")


def _before_and_now(
    before: At[Tick] | None, at: At[Tick]
) -> tuple[Mapping[str, Any], Mapping[str, Any]]:
    return before.value.situation if before else {}, at.value.situation


def _ended(before: At[Tick] | None, at: At[Tick]) -> list[Mapping[str, Any]]:
    """What came of the tasks and parts that have ended since."""
    was, now = _before_and_now(before, at)
    known = len(was.get("ended") or ())
    return [*_parts(now)[len(_parts(was)) :], *(now.get("ended") or [])[known:]]


def _parts(situation: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """What came of parts of tasks, in the order in which they ended."""
    ended = [part for task in situation.get("ended") or () for part in _within(task)]
    under_way = [part for whole in situation.get("parts") or () for part in whole]
    return [*ended, *(inner for part in under_way for inner in (*_within(part), part))]


def _within(task: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    for part in task.get("parts") or ():
        yield from _within(part)
        yield part


def _parts_ended(before: At[Tick] | None, at: At[Tick]) -> Iterator[Decision]:
    """How each part of a task ended that has ended since."""
    was, now = _before_and_now(before, at)
    for part in _parts(now)[len(_parts(was)) :]:
        yield Decision(at.time_s, f"part: {_named(part)}", _came_of(part), "", at.value.tip)


def _tasks_ended(before: At[Tick] | None, at: At[Tick]) -> Iterator[Decision]:
    """How each task ended that has ended since; nothing if there was but one."""
    ended = at.value.situation.get("ended") or ()
    if len(ended) < 2 and not _goes_on(at):
        return
    known = len(before.value.situation.get("ended") or ()) if before else 0
    for number, task in enumerate(ended[known:], start=known + 1):
        what = f"task {number}: {_named(task)}"
        yield Decision(at.time_s, what, _came_of(task), "", at.value.tip)


def _named(task: Mapping[str, Any]) -> str:
    """A command, or what came of one: "bring 2 fruits from desk", "put mug"."""
    number = task.get("number") or 0
    source = f"from {task['source']}" if task.get("source") else ""
    goal = f"to {task['goal']}" if task.get("goal") else ""
    kind, several = task["kind"].replace("_", " "), str(number) if number > 0 else ""
    return " ".join(filter(None, (kind, several, task["target"], source, goal)))


def _came_of(task: Mapping[str, Any]) -> str:
    return f"{task['status'].replace('_', ' ')}: {task['reason']}"


def _goes_on(at: At[Tick]) -> bool:
    """Whether the mission did not end with this tick."""
    return any(node.status == "RUNNING" for node in at.value.nodes)


def _runs(paths: Container[str], at: At[Tick]) -> bool:
    return any(node.status == "RUNNING" and node.path in paths for node in at.value.nodes)


def _less_likely(planned: Planned) -> Iterator[Alternative]:
    """The likeliest of the places that are not next, who says so of each, and how far it is."""
    away = dict(zip(planned.places, planned.away, strict=False))
    next_s = min((away.get(place, -1.0) for place in planned.order[:1]), default=-1.0)
    told = zip(planned.places, planned.probabilities, planned.says, strict=False)
    others = (
        (place, p, says) for place, p, says in told if place not in planned.order[:1] and p >= LEAST
    )
    for place, probability, says in islice(others, MOST_TOLD):
        likely = f"{probability:.2f} ({says})" if says else f"{probability:.2f}"
        yield Alternative(place, likely + _farther(away.get(place, -1.0), next_s))


def _farther(seconds: float, next_s: float) -> str:
    """How long going there and looking would take, beside the place that is next."""
    if seconds < 0:
        return ""
    return f", {seconds:.0f} s away" + (f" instead of {next_s:.0f}" if next_s >= 0 else "")


def _outranked(call: LlmCall) -> list[Alternative]:
    if not isinstance(call.result, Scored):
        return []
    ranked = sorted(zip(call.result.scores, call.result.request.places, strict=True), reverse=True)
    return [Alternative(place, f"scored {score:.2f}") for score, place in ranked]


def denied(condition: str) -> str:
    """The contrary of a condition, named as it reads when true: `in my hand`, `it was there`."""
    if condition.startswith(SOMETHING):
        return f"nothing{condition.removeprefix(SOMETHING)}"
    contrary, verbs = _VERB.subn(r"\1 not", condition, count=1)
    return contrary if verbs else f"not {condition}"


def why_text(decisions: Iterable[Decision]) -> str:
    """A paragraph for each decision: what was settled, by whom, and what was not taken."""
    return "\n".join(map(_text, decisions)) or "nothing was decided: the recording has no ticks"


def _text(decision: Decision) -> str:
    says = f"  [{decision.source}]" if decision.source else ""
    lines = [f"{decision.time_s:9.3f}  {decision.question}: {decision.answer}{says}"]
    lines += [
        f"{'':13}- {a.what}: {a.why_not}" for a in decision.alternatives if a.why_not != NOT_NEEDED
    ]
    spare = [a.what for a in decision.alternatives if a.why_not == NOT_NEEDED]
    if spare:
        lines.append(f"{'':13}- not needed: {', '.join(spare)}")
    return "\n".join(map(printable, lines))
