"""Names and descriptions of the policies, separate from these so that they need not be imported."""

from collections.abc import Mapping
from types import MappingProxyType

DESCRIPTIONS: Mapping[str, str] = MappingProxyType(
    {
        "ours": "the executive as the settings make it, by the paper's stages",
        "paper": "the same, by its own name",
        "plan": "one belief, and a plan that weighs looking on against asking",
        "plan-exact": "the best of all plans among the 12 likeliest places; the others count as "
        "elsewhere until those are done",
        "ask-first": "the plan if questions cost nothing: the person is asked at once",
        "rank": "the model scores the places that exist",
        "generate": "the model writes a list, which is verified: the paper's way",
        "generate-form": "the same, held to the list's form",
        "generate-grammar": "the same, held to the list's form and to real names",
        "unverified": "generate-form without the verification: the robot sets out for invented "
        "places",
        "llm-alone": "unverified, and the model is told nothing of the home, nor of default "
        "locations",
        "nearest": "the nearest furniture first",
        "random": "any order",
        "popularity": "where most other things are by the survey",
        "true-first": "the bound: a stand-in that knows where the thing is",
        "too-sure": "a fault put in by hand: the plan, with a ranking that is far too sure",
        "memory": "what the robot remembers alone; what it does not, the person is asked",
        "plan-unlearned": "the plan of a robot that remembers and learns nothing of it",
        "always-asks": "a fault put in by hand: neither default locations nor a model, so the "
        "person is asked",
    }
)
"""Descriptions by name, in the order of `--help`."""
