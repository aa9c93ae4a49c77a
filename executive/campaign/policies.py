"""Policies that decide where to look: the executive as it is, baselines, and ablations.

A policy changes settings, and replaces some parts: the language model, the advice. The tree, the
robot and the person are the same for all.
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
    """A policy: a function from parts to parts.

    Attributes:
        description: one line for `--help`.
        settings: settings that override all others.
        change: replaces parts.
    """

    description: str
    settings: Mapping[str, Any] = field(default_factory=dict)
    change: Change = as_they_are

    def __call__(self, parts: Parts) -> Parts:
        """Replace parts."""
        return self.change(parts)

    def applied_to(self, settings: Settings) -> Settings:
        """The settings, overridden by those of the policy."""
        return settings.model_copy(update=dict(self.settings))


PAPER = {"search": "paper"}
"""The paper's stages, so that policies differ only in who says where to look."""
PLAN = {"search": "plan"}
BY_RANK = {**PAPER, "llm": "none", "elicit": "rank"}
BARE = {**PAPER, "llm": "none", "defaults": False}
"""Without model and default locations."""
WRITES = {**PAPER, "elicit": "generate", "grammar": False}
HELD = {**WRITES, "grammar": True}
"""The model's lists follow a JSON schema."""


def baseline(rule: Callable[[Parts], Order]) -> tuple[Mapping[str, Any], Change]:
    """Settings and change for a rule instead of a language model."""
    return BY_RANK, lambda parts: ordered(parts, rule)


_DEFINITIONS: Mapping[str, tuple[Mapping[str, Any], Change]] = {
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
"""Settings and change of each policy."""

POLICIES: Mapping[str, Policy] = MappingProxyType(
    {name: Policy(says, *_DEFINITIONS[name]) for name, says in DESCRIPTIONS.items()}
)
"""Our policies by name."""

RIGHT = (
    "name a Policy, or a function that takes Parts and returns Parts (docs/examples/own_policy.py)"
)


def policy_named(name: str) -> Policy:
    """One of our policies, or a user's own by `package.module:function`.

    Raises:
        InputError: if a user's own cannot be imported; later, when it is called, if it fails.
    """
    if name in POLICIES:
        return POLICIES[name]
    named = Named("--policy", name, RIGHT)
    own = named.imported()
    settings = own.settings if isinstance(own, Policy) else PAPER
    return Policy("of somebody's own", settings, lambda parts: named.called(own, parts, Parts))
