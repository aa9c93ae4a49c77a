"""Warnings about settings that have no effect because of other settings."""

import logging
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass

from executive.config import KnowledgeSystem, Settings

log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Need:
    """A condition that some settings need to have an effect.

    Attributes:
        of: names of settings, and of command-line options that are not settings.
        is_met: whether the settings meet the condition.
        lack: why there is no effect, as a clause.
        right: what to do, other than leaving the setting out.
    """

    of: tuple[str, ...]
    is_met: Callable[[Settings], bool]
    lack: str
    right: str


_MODEL = ("elicit", "grammar", "prompts", "temperature", "top_p", "context_tokens", "max_tokens")
_NO_MODEL = "there is no language model"

NEEDS = (
    Need(
        ("world", "place", "ycb", "camera_hz", "gui"),
        lambda s: s.robot is None,
        "a robot over the wire is no world of this program",
        "leave out --robot",
    ),
    Need(
        ("ycb", "camera_hz", "gui"),
        lambda s: s.world != "fake",
        "the instant world draws nothing",
        "give --world physics",
    ),
    Need(
        ("detector",),
        lambda s: s.robot is not None or s.world != "fake" or s.detector == "simulated",
        "the instant world knows what is in its pictures",
        "give --world physics",
    ),
    Need(
        ("llm",),
        lambda s: s.uses_llm or s.llm == "none",
        "the system okb asks no language model",
        "give --knowledge okb+llm",
    ),
    Need(
        ("knowledge",),
        lambda s: s.uses_llm or s.knowledge == KnowledgeSystem.OKB,
        _NO_MODEL,
        "give --llm embedded",
    ),
    Need(
        (*_MODEL, "llm_timeout_s"),
        lambda s: s.uses_llm,
        _NO_MODEL,
        "give --llm embedded with --knowledge okb+llm",
    ),
    Need(
        ("threads", "gpu_layers"),
        lambda s: s.uses_llm and not s.llm.startswith("http"),
        "no language model runs in this process",
        "give --llm embedded",
    ),
    Need(
        ("llm_model",),
        lambda s: s.uses_llm and s.llm.startswith("http"),
        "no server has the language model",
        "give --llm http://host:port/v1",
    ),
    Need(
        ("question_s",),
        lambda s: s.search == "plan",
        "the paper's stages weigh nothing",
        "give --search plan",
    ),
    Need(
        ("microphone",),
        lambda s: s.ears is not None,
        "nobody hears by it",
        "give --ears pocketsphinx",
    ),
    Need(
        ("ears_model", "ears_timeout_s"),
        lambda s: (s.ears or "").startswith("http"),
        "no server hears",
        "give --ears http://host:port/v1",
    ),
    Need(
        ("ears_language",),
        lambda s: s.ears not in (None, "pocketsphinx"),
        "nobody hears who knows another language",
        "give --ears http://host:port/v1",
    ),
    Need(
        ("hours_between",),
        lambda s: s.habits is not None or s.home_state is not None,
        "the home is put in order at each start, and nobody lives there",
        "give --habits household",
    ),
)
"""Settings that are wrong in any case are refused where they are used, not here."""


def warn_of_vain(settings: Settings, given: Collection[str]) -> None:
    """Warn of settings without effect; those of a file or the environment if not the default.

    Args:
        settings: all settings.
        given: names of those given on the command line.
    """
    for name, need in _unmet(settings):
        lack = f"has no effect: {need.lack}"
        if name in given:
            option = f"--{name.replace('_', '-')}"
            log.warning("%s %s (%s, or leave %s out)", option, lack, need.right, option)
        elif name in settings.model_fields_set and getattr(settings, name) != _default(name):
            log.warning("setting '%s' %s", name, lack)


def _unmet(settings: Settings) -> Iterator[tuple[str, Need]]:
    return ((name, need) for need in NEEDS if not need.is_met(settings) for name in need.of)


def _default(name: str) -> object:
    return Settings.model_fields[name].get_default(call_default_factory=True)
