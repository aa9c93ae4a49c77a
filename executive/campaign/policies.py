"""Who says where to look: the executive as it is, baselines to compare it with, and ablations.

A policy changes settings, and puts other parts in the place of some: the language model, the
advice. The tree, the robot and the person are the same for all.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

from executive.app.own import Named
from executive.app.parts import Change, Parts, as_they_are
from executive.campaign.ablations import any_names, exactly, no_home, reworded, too_sure, unverified
from executive.campaign.baselines import Order, by_chance, nearest, ordered, popular, true_first
from executive.campaign.names import DESCRIPTIONS
from executive.config import Settings


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


PAPER = {"search": "paper"}
"""In the paper's stages, so that only who says where to look differs."""
PLAN = {"search": "plan"}
BY_RANK = {**PAPER, "llm": "none", "elicit": "rank"}
BARE = {**PAPER, "llm": "none", "defaults": False}
"""Neither model nor default locations."""
WRITES = {**PAPER, "elicit": "generate", "grammar": False}
HELD = {**WRITES, "grammar": True}
"""Written under a schema."""


def baseline(rule: Callable[[Parts], Order]) -> tuple[Mapping[str, Any], Change]:
    """What goes by a rule instead of a language model."""
    return BY_RANK, lambda parts: ordered(parts, rule)


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
    "memory": (BARE, as_they_are),
    "plan-unlearned": (PLAN, lambda parts: replace(parts, experience=None)),
    "always-asks": (BARE, as_they_are),
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
