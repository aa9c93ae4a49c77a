"""Opens the language model that `--llm` names; nothing else creates one from settings.

The libraries of a model are imported only when it is opened, since a mission may not need one.
"""

from pathlib import Path

from executive.config import Settings
from executive.errors import InputError
from executive.events import Inbox
from executive.interfaces.llm import LanguageModel
from executive.servers.key import Key
from kb.llm.options import ModelOptions


def model_for_missions(settings: Settings, inbox: Inbox) -> LanguageModel | None:
    """The model for missions, or None; it loads in the background.

    Raises:
        ExecutiveError: if it cannot do what the settings require, or its file is invalid.
    """
    if not settings.uses_llm:
        return None
    if settings.elicitation == "rank" and settings.llm.startswith("http"):
        raise _cannot_rank("a server cannot rank places")
    model = open_model(settings, inbox)
    if model and settings.elicitation == "rank" and not model.can_rank:
        model.close()
        raise _cannot_rank("this model cannot rank")
    return model


def open_model(settings: Settings, inbox: Inbox) -> LanguageModel | None:
    """The model in the settings; None for `none`.

    Raises:
        ExecutiveError: if its file is invalid.
    """
    if settings.llm == "none":
        return None
    if settings.llm.startswith("http"):
        from kb.llm.server.server import Server

        return Server(
            settings.llm,
            inbox,
            _options_of(settings),
            model=settings.llm_model,
            api_key=Key.from_environment(),
            timeout_s=settings.llm_timeout_s,
        )
    from kb.llm.llama import LlamaCpp, embedded_model

    return LlamaCpp(
        embedded_model() if settings.llm == "embedded" else Path(settings.llm),
        inbox,
        _options_of(settings),
        threads=settings.threads,
        gpu_layers=settings.gpu_layers,
    )


def _options_of(settings: Settings) -> ModelOptions:
    """The options in the settings."""
    return ModelOptions(
        context_tokens=settings.context_tokens,
        temperature=settings.temperature,
        top_p=settings.top_p,
        max_tokens=settings.max_tokens,
        seed=settings.seed,
        grammar=settings.grammar,
    )


def _cannot_rank(what: str) -> InputError:
    return InputError("setting 'elicit'", what, "use --elicit generate")
