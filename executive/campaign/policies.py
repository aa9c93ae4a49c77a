"""Who says where to look: the executive as it is, baselines to hold it against, and ablations.

A policy changes settings, and puts other parts in the place of some: the language model, the
advice. The tree, the robot and the person are the same for all.
"""

import random
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from itertools import chain
from types import MappingProxyType
from typing import Any

from executive.app.own import Named
from executive.app.parts import Change, Parts, advised, as_they_are, guarded_model
from executive.campaign.names import DESCRIPTIONS
from executive.campaign.routes import routes_of
from executive.config import KnowledgeSystem, Settings
from executive.events import Inbox
from executive.interfaces.llm import Advice, LanguageModel
from executive.plan import EXACT
from executive.types.knowledge import Candidate, Verdict
from executive.types.llm import ChatRequest, Message, RankRequest, Usage
from executive.types.results import Failed, Scored
from kb.advice.advisor import advise
from kb.advice.lister import Lister
from kb.advice.ranker import Ranker
from kb.advice.reader import Reader
from kb.advice.verification import Reply
from kb.ontology.names import unique
from kb.ontology.ontology import Ontology

Order = Callable[[str, Sequence[str]], Sequence[str]]
"""An object's name, and the places that are allowed -> the places in the order to visit them."""

WITHOUT_A_HOME = f"""\
You help a robot that fetches things in a home. It tells you what it is after, and you tell it \
where that thing is kept, using everyday common sense. Answer with one JSON object and nothing \
else. It has to follow this JSON schema: {Reply.model_json_schema()}"""
"""What a model is told that knows nothing of the home."""
MOST_NAMES = 5
"""As many as the prompt asks for."""


@dataclass(frozen=True)
class Policy:
    """One of them: a function from parts to parts.

    Attributes:
        description: for the person who chooses.
        settings: what it sets, whatever else was set.
        change: puts other parts in.
    """

    description: str
    settings: Mapping[str, Any] = field(default_factory=dict)
    change: Change = as_they_are

    def __call__(self, parts: Parts) -> Parts:
        """The parts as it has them."""
        return self.change(parts)

    def applied_to(self, settings: Settings) -> Settings:
        """The settings of a mission, with those that it sets."""
        return settings.model_copy(update=dict(self.settings))


# --- baselines: an order of places without a language model ---


class Indifferent:
    """Stands in for a language model: all options are alike to it, and their order stays."""

    name = "none"
    context_tokens = 4096
    can_rank = True

    def __init__(self, inbox: Inbox) -> None:
        """Answer at once."""
        self._inbox = inbox

    def chat(self, request: ChatRequest) -> int:
        """Fail: it cannot write."""
        number = self._inbox.open()
        self._inbox.end(number, Failed("there is no language model"))
        return number

    def rank(self, request: RankRequest) -> int:
        """Score all options alike."""
        number = self._inbox.open()
        self._inbox.end(number, Scored(request, (0.0,) * len(request.options), Usage()))
        return number

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Nothing to prepare."""

    def cancel(self, request: int) -> None:
        """Forget the request."""
        self._inbox.drop(request)

    def count_tokens(self, text: str) -> int:
        """How many words the text has."""
        return len(text.split())

    def close(self) -> None:
        """Nothing to free."""


class Ordered(Ranker):
    """Names the places in a given order, for a model to which they are all alike."""

    def __init__(self, parts: Parts, order: Order) -> None:
        """Order the places of the mission's home."""
        super().__init__(parts.knowledge)
        self._order = order

    def ranking(self, name: str, among: tuple[str, ...]) -> RankRequest:
        """The allowed places, in order."""
        request = super().ranking(name, among)
        words = dict(zip(request.places, request.options, strict=True))
        places = tuple(self._order(name, request.places))
        options = tuple(words[place] for place in places)
        return replace(request, places=places, options=options, place_kinds=())


def nearest(parts: Parts) -> Order:
    """Always go to the place that is nearest to where the robot is, by the map."""
    routes = routes_of(parts.home)

    def order(name: str, places: Sequence[str]) -> list[str]:
        here, left, tour = parts.home.robot_start[:2], list(places), list[str]()
        while left:
            tour.append(routes.nearest(here, left))
            left.remove(tour[-1])
            here = routes.stand(tour[-1])
        return tour

    return order


def by_chance(parts: Parts) -> Order:
    """Any order; the same for the same seed and object."""

    def order(name: str, places: Sequence[str]) -> list[str]:
        chance = random.Random(f"{parts.settings.seed} {name}")
        return chance.sample(list(places), len(places))

    return order


@cache
def the_survey() -> Ontology:
    """The ontology with the survey's default locations, whatever a mission's situation."""
    return Ontology(defaults=True)


def popular(parts: Parts | None = None) -> Order:
    """Where other things usually are, by the survey; equals in the home's order.

    The record that the asked object takes its own default locations from is left out, and with it
    all that share it. The survey is used in both situations.
    """
    survey = the_survey()
    recorded = survey.recorded_locations()

    def order(name: str, places: Sequence[str]) -> list[str]:
        kinds = survey.classes_of(name) if name in survey.objects() else ()
        own = next((n for n in (name, *kinds) if n in recorded), None)
        others = (where for other, where in recorded.items() if other != own)
        counts = Counter(chain.from_iterable(others))
        return sorted(places, key=lambda place: -counts[place])

    return order


def true_first(parts: Parts) -> Order:
    """The place where the thing truly is, then the others: knows the truth, as no robot does."""

    def order(name: str, places: Sequence[str]) -> list[str]:
        truth = parts.home.placement.get(name)
        return sorted(places, key=lambda place: place != truth)

    return order


def ordered(parts: Parts, rule: Callable[[Parts], Order]) -> Parts:
    """The parts with advice that goes by a rule instead of a language model.

    The settings have to ask for a ranking. okb has no advice, and stays as it is.
    """
    if parts.settings.knowledge == KnowledgeSystem.OKB:
        return parts
    model = Indifferent(parts.inbox)
    usual = advise(parts.knowledge, model, remembers=False)
    advice = replace(usual, ranker=Ordered(parts, rule(parts)))
    return replace(parts, model=model, advice=advice)


TOO_SURE = 8.0
"""So many times as large are the scores, before they become probabilities."""


class TooSure(Ranker):
    """Ranks as ever, but believes its own word far too much."""

    def ranked(self, scored: Scored) -> tuple[Candidate, ...]:
        """The same order, and nearly all of the probability to the first."""
        scores = tuple(TOO_SURE * score for score in scored.scores)
        return super().ranked(replace(scored, scores=scores))


def too_sure(parts: Parts) -> Parts:
    """A fault put in by hand."""
    if parts.advice is None:
        return parts
    ranker = TooSure(parts.knowledge, prompts=parts.prompts, facts=parts.facts)
    return replace(parts, advice=replace(parts.advice, ranker=ranker))


def exactly(parts: Parts) -> Parts:
    """Planned among so many places, the likeliest, that the best of all plans is found."""
    return replace(parts, parameters=replace(parts.parameters, planned=EXACT))


PAPER = {"search": "paper"}
"""In the paper's stages: who says where to look, is all that differs."""
PLAN = {"search": "plan"}
BY_RANK = {**PAPER, "llm": "none", "elicit": "rank"}


def baseline(rule: Callable[[Parts], Order]) -> tuple[Mapping[str, Any], Change]:
    """What goes by a rule instead of a language model."""
    return BY_RANK, lambda parts: ordered(parts, rule)


# --- ablations: a language model that writes, less a part of what is built around it ---


class Reworded:
    """A language model that is asked in other words: implements `LanguageModel` around one."""

    def __init__(self, model: LanguageModel, reword: Callable[[ChatRequest], ChatRequest]) -> None:
        """Reword what it is asked to write."""
        self._model = model
        self._reword = reword
        self.name = model.name
        self.context_tokens = model.context_tokens
        self.can_rank = model.can_rank

    def chat(self, request: ChatRequest) -> int:
        """Ask in other words, if it is about places."""
        about_places = request.label != "command"
        return self._model.chat(self._reword(request) if about_places else request)

    def rank(self, request: RankRequest) -> int:
        """Ask as it is."""
        return self._model.rank(request)

    def prepare(self, request: ChatRequest | RankRequest) -> None:
        """Prepare what will be asked as it is."""
        if isinstance(request, RankRequest):
            self._model.prepare(request)

    def cancel(self, request: int) -> None:
        """Call it off."""
        self._model.cancel(request)

    def count_tokens(self, text: str) -> int:
        """By the model's tokenizer."""
        return self._model.count_tokens(text)

    def close(self) -> None:
        """Free the model."""
        self._model.close()


def any_names(request: ChatRequest) -> ChatRequest:
    """Hold the reply to its form, but not to the names that exist."""
    schema = Reply.model_json_schema()
    schema["properties"]["places"] |= {"minItems": 1, "maxItems": MOST_NAMES}
    return replace(request, schema=schema)


def no_home(request: ChatRequest) -> ChatRequest:
    """Tell the model nothing of the home."""
    told = [message for message in request.messages if message.role != "system"]
    return replace(any_names(request), messages=(Message("system", WITHOUT_A_HOME), *told))


class Unverified(Lister):
    """Takes every name for a place."""

    def verify(self, names: tuple[str, ...], among: tuple[str, ...]) -> Verdict:
        """Let all pass."""
        return Verdict(unique(names))


def reworded(reword: Callable[[ChatRequest], ChatRequest]) -> Change:
    """Asks the model in other words."""

    def change(parts: Parts) -> Parts:
        model = Reworded(parts.model, reword) if parts.model else None
        return advised(replace(parts, model=model))

    return change


def unverified(parts: Parts) -> Parts:
    """With advice that makes no existence check."""
    if parts.model is None:
        return parts
    settings = parts.settings
    lister = Unverified(
        parts.knowledge,
        guarded_model(parts, parts.model),
        remembers=settings.remembers,
        top=settings.top,
        prompts=parts.prompts,
    )
    reader = Reader(parts.knowledge, prompts=parts.prompts)
    advice = Advice(lister, Ranker(parts.knowledge, prompts=parts.prompts), reader)
    return replace(parts, advice=advice)


WRITES = {**PAPER, "elicit": "generate", "grammar": False}
HELD = {**WRITES, "grammar": True}

_WAYS: Mapping[str, tuple[Mapping[str, Any], Change]] = {
    "ours": (PAPER, as_they_are),
    "paper": (PAPER, as_they_are),
    "plan": (PLAN, as_they_are),
    "plan-exact": (PLAN, exactly),
    "ask-first": ({**PLAN, "question_s": 0.0}, as_they_are),
    "rank": ({**PAPER, "elicit": "rank"}, as_they_are),
    "generate": (WRITES, as_they_are),
    "generate-form": (HELD, reworded(any_names)),
    "generate-grammar": (HELD, as_they_are),
    "unverified": (HELD, lambda parts: unverified(reworded(any_names)(parts))),
    "llm-alone": (
        {**HELD, "defaults": False},
        lambda parts: unverified(reworded(no_home)(parts)),
    ),
    "nearest": baseline(nearest),
    "random": baseline(by_chance),
    "popularity": baseline(popular),
    "true-first": baseline(true_first),
    "too-sure": ({**PLAN, "elicit": "rank"}, too_sure),
    "memory": ({**PAPER, "llm": "none", "defaults": False}, as_they_are),
    "plan-unlearned": (PLAN, lambda parts: replace(parts, experience=None)),
    "always-asks": ({**PAPER, "llm": "none", "defaults": False}, as_they_are),
}
"""What each sets and puts in."""

POLICIES: Mapping[str, Policy] = MappingProxyType(
    {name: Policy(says, *_WAYS[name]) for name, says in DESCRIPTIONS.items()}
)
"""By name."""

RIGHT = (
    "name a Policy, or a function that takes Parts and returns Parts (docs/examples/own_policy.py)"
)


def policy_named(name: str) -> Policy:
    """One of ours, or one of somebody's own by `package.module:function`.

    Raises:
        InputError: if one of somebody's own cannot be imported; when it is called, if it fails.
    """
    if name in POLICIES:
        return POLICIES[name]
    named = Named("--policy", name, RIGHT)
    own = named.imported()
    settings = own.settings if isinstance(own, Policy) else PAPER
    return Policy("of somebody's own", settings, lambda parts: named.called(own, parts, Parts))
