"""Builds the parts that the settings name, the body among them.

Modules that take long to import are imported where they are needed: many missions do without, and
for others the model gets ready meanwhile.
"""

import logging
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from functools import lru_cache
from io import StringIO
from pathlib import Path
from typing import TextIO

from executive.app.embodiment import Embodiment, Setup
from executive.app.living import LivingHome
from executive.app.parts import Parts, build_advice, parameters_of
from executive.app.simulation import faults_of
from executive.app.worlds import embody, try_world
from executive.config import Settings
from executive.errors import InputError, ModelError
from executive.events import Inbox
from executive.guards import GuardedModel, in_words
from executive.interfaces.dialogue import User
from executive.interfaces.knowledge import Experience
from executive.interfaces.llm import Advice, LanguageModel
from executive.interfaces.runtime import Recorder
from executive.interfaces.simulation import SimulatedHome
from executive.language.grammar import EnglishInterpreter
from executive.types.home import Place, Thing
from executive.types.llm import ChatRequest, RankRequest
from executive.user import Console, Nobody, Oracle
from kb.advice.prompts import Prompts
from kb.facts import FactStore
from kb.llm.gguf_header import check_file
from kb.llm.open import model_for_missions
from kb.ontology.ontology import Ontology
from kb.ontology.owl import OwlFile, read
from sim.home.home import Home
from sim.home.home_file import load_home
from sim.home.validation import with_placement

log = logging.getLogger(__name__)

ANYTHING = "thing"
"""The object in the question that the model prepares for."""


def build_parts(
    settings: Settings,
    inbox: Inbox,
    recorder: Recorder,
    opened: ExitStack,
    *,
    user: User | None,
    model: LanguageModel | None,
    out: TextIO,
    gui: bool,
) -> tuple[Embodiment, Parts]:
    """Build the parts; `user` and `model` replace those that the settings name.

    Whatever has to be closed is registered with `opened`.

    Raises:
        ExecutiveError: if a setting, the home, the ontology or the model file is wrong.
    """
    living = living_home(settings)
    home, prompts = living.home, Prompts.load(settings.prompts)
    if model is None and (model := model_for_missions(settings, inbox)):
        opened.callback(model.close)
    knowledge = read_ontology(settings, home)
    facts = FactStore(settings.memory, learns=settings.learn, now=living.now)
    opened.callback(facts.close)
    advice = None
    if model:  # it gets ready while the body is built
        advice = prepared(settings, knowledge, GuardedModel(model, inbox, recorder), prompts, facts)
    setup = Setup(settings, home, inbox, recorder, knowledge, gui, living.left)
    embodiment = inhabited(setup, living, opened)
    return embodiment, Parts(
        settings=settings,
        home=home,
        inbox=inbox,
        recorder=recorder,
        parameters=parameters_of(settings),
        # the body
        clock=embodiment.clock,
        robot=embodiment.robot,
        perception=embodiment.perception,
        in_map=embodiment.in_map,
        blind_to=embodiment.blind_to,
        has_arm=embodiment.has_arm,
        # the person, and what they say
        user=user or build_user(settings, inbox, embodiment.truth, out),
        interpreter=EnglishInterpreter(knowledge.names()),
        # what is known, and who knows more
        knowledge=knowledge,
        facts=facts,
        experience=learning(settings, facts, knowledge, living.now),
        model=model,
        prompts=prompts,
        advice=advice,
    )


def prepared(
    settings: Settings, knowledge: Ontology, model: GuardedModel, prompts: Prompts, facts: FactStore
) -> Advice:
    """Our adviser; the model begins to get ready for its first question."""
    advice = build_advice(settings, knowledge, model, prompts, facts)
    model.prepare(anything(settings, advice))
    return advice


def inhabited(setup: Setup, living: LivingHome, opened: ExitStack) -> Embodiment:
    """The body, in a home where life goes on; a warning names what it would not recognise."""
    embodiment = embody(setup)
    opened.callback(close_safely, embodiment)
    embodiment = living.move_in(embodiment)
    if embodiment.blind_to:
        log.warning("%s", blindness(embodiment.blind_to))
    return embodiment


def try_files(settings: Settings) -> None:
    """Read the files that the settings name, as a session would, without a model or a body.

    Raises:
        InputError: if a file is missing, or something in it is wrong.
    """
    home = living_home(settings).home
    Prompts.load(settings.prompts)
    read_ontology(settings, home)
    if settings.robot and settings.profile:
        from executive.ros.profile import load_profile  # most missions do without

        load_profile(settings.profile)
    if not settings.robot:
        try_world(settings.world)
        faults_of(settings, home)
    if settings.ycb:
        from sim.objects.ycb import with_scans  # most missions do without

        with_scans(home.drawn_models(), settings.ycb)
    if settings.detector.endswith(".onnx"):
        from executive.perception.onnx_file import read_onnx  # most missions do without

        read_onnx(Path(settings.detector))
    if settings.llm.endswith(".gguf"):
        _try_model(Path(settings.llm))


def living_home(settings: Settings) -> LivingHome:
    """The home that the settings name, with things where the settings say, or were left."""
    return LivingHome(settings, with_placement(load_home(settings.home), settings.place))


def _try_model(file: Path) -> None:
    try:
        check_file(file)
    except ModelError as error:
        raise InputError("setting 'llm'", str(error)) from None


def learning(
    settings: Settings, facts: FactStore, knowledge: Ontology, now: Callable[[], float]
) -> Experience | None:
    """What learns from the file of facts; None without a file: a session is too short for it."""
    if settings.memory is None:
        return None
    from kb.experience import Experience as Learned  # most missions do without

    return Learned(facts, knowledge.class_of, now)


def read_ontology(settings: Settings, home: Home) -> Ontology:
    """The ontology of the home; its warnings go to the log."""
    knowledge = _ontology(
        home.places(),
        home.things(),
        settings.defaults,
        tuple(map(read, settings.kb)),
        settings.person,
        home.file,
    )
    for warning in knowledge.warnings():
        log.warning("%s", warning)
    return knowledge


@lru_cache(maxsize=4)
def _ontology(
    places: tuple[Place, ...],
    things: tuple[Thing, ...],
    defaults: bool,
    files: tuple[OwlFile, ...],
    person: str | None,
    home: str,
) -> Ontology:
    """The ontology of a home; it never changes, so that homes with the same contents share it."""
    return Ontology(places, things=things, defaults=defaults, files=files, person=person, home=home)


def blindness(names: Sequence[str]) -> str:
    """A warning that the detector does not know these objects, and what to use instead."""
    right = "use --detector simulated, or a FILE.onnx with the name in its class list"
    return f"the detector does not know {', '.join(names)}, and would not see it: {right}"


def anything(settings: Settings, advice: Advice) -> ChatRequest | RankRequest:
    """A question about some thing, for which the model gets ready."""
    if settings.elicitation == "rank":
        return advice.ranker.ranking(ANYTHING, ())
    return advice.lister.inquiry(ANYTHING, ())


def close_safely(embodiment: Embodiment) -> None:
    """Close the body; if that raises, warn, so that the session ends in order."""
    try:
        embodiment.close()
    except Exception as error:
        log.warning("the robot cannot be let go of: %s", in_words(error))


def build_user(settings: Settings, inbox: Inbox, truth: SimulatedHome | None, out: TextIO) -> User:
    """The person that the settings name.

    Raises:
        InputError: if it is the oracle, and the world is not simulated: it knows no truth then.
    """
    match settings.user:
        case "console":
            return Console(inbox, None if settings.is_typed else StringIO(), out)
        case "none":
            return Nobody(inbox, out)
        case "oracle" if truth is not None:
            return Oracle(inbox, truth.resting_place, settings.seed, out)
        case _:
            raise InputError(
                "setting 'user'",
                f"the oracle answers from a simulated world's truth, and {settings.body} has none",
                "use --user console or none",
            )
