"""Rebuilds the parts of a recorded mission from its recording."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from math import inf
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar

from pydantic import TypeAdapter, ValidationError

from executive.app.parts import OURS, Change, Parts, advised, as_they_are, parameters_of
from executive.app.sources import RecordedExperience, RecordedSource, read
from executive.config import Settings, in_words
from executive.errors import InputError
from executive.events import Inbox
from executive.interfaces.runtime import Clock, Recorder
from executive.language.grammar import EnglishInterpreter
from executive.records import Recalled, SourceAnswer, WaysTold
from executive.replay.body import recorded_body
from executive.replay.stand_ins import Absent
from executive.types.home import Place, Thing
from kb.advice.prompts import Prompts
from kb.facts import FactStore
from kb.ontology.ontology import DEFAULTS, HOUSEHOLD, Ontology
from kb.ontology.owl import parsed
from logs.recording.reader import Run
from sim.home.home import Home
from sim.home.home_file import recorded_home
from sim.home.validation import with_placement

T = TypeVar("T")

_PLACES = TypeAdapter(dict[str, list[str]])
_home = cache(recorded_home)


def recorded_parts(
    run: Run,
    inbox: Inbox,
    absent: Absent,
    clock: Clock,
    judge: Recorder,
    change: Change | None = None,
) -> Parts:
    """The parts of the recorded mission, with stand-ins for all that acts or answers.

    Its policy is looked up by name, unless `change` is given.

    Raises:
        InputError: if the recording lacks something that a part needs, or it is malformed.
    """
    settings = _settings(run)
    home = with_placement(_home(kept(run, run.attachments, "home.toml")), settings.place)
    body = recorded_body(run, settings, home)
    absent.several = body.views
    absent.ways = _ways(run)
    knowledge = _knowledge(run, settings, home)
    thinks = run.metadata.get("thinks") or str(kept(run, run.metadata, "model") != "none")
    parts = Parts(
        settings=settings,
        home=home,
        inbox=inbox,
        clock=clock,
        recorder=judge,
        robot=absent,
        perception=absent,
        user=absent,
        knowledge=knowledge,
        model=absent if thinks == str(True) else None,
        prompts=_prompts(run.attachments.get("prompts.toml")),
        facts=FactStore.believing(
            *(_places(run, f"{name}.json") for name in ("facts", "origins", "denials")),
            learns=settings.learn,
        ),
        experience=_experience(run),
        sources=_sources(run),
        interpreter=EnglishInterpreter(knowledge.names()),
        in_map=body.in_map,
        blind_to=body.blind_to,
        has_arm=body.has_arm,
        parameters=parameters_of(settings),
    )
    changed = (change or _policy(run))(advised(parts))
    model = absent if changed.model else None
    return replace(changed, robot=absent, perception=absent, user=absent, model=model)


def _knowledge(run: Run, settings: Settings, home: Home) -> Ontology:
    names = (HOUSEHOLD.name, DEFAULTS.name, *(file.name for file in settings.kb))
    files = tuple((name, run.attachments[name]) for name in names if name in run.attachments)
    return _ontology(home.places(), home.things(), settings.defaults, files, settings.person)


def _policy(run: Run) -> Change:
    """The policy of the recorded mission.

    A user's own policy is never imported: a recording must not run code.
    """
    name = run.metadata.get("policy", OURS)
    if name == OURS:
        return as_they_are
    # imports packages that most replays do not need
    from executive.campaign.policies import POLICIES

    if name not in POLICIES:
        what = f"was made with the policy {name!r}, unknown here"
        raise InputError(str(run.path), what, "in Python, give it: replay(folder, change=...)")
    return POLICIES[name]


def _places(run: Run, name: str) -> dict[str, list[str]]:
    """The places of objects, from an attachment; empty if there is none.

    Raises:
        InputError: if it is malformed, or is `facts.json`, and there is none.
    """
    if name != "facts.json" and name not in run.attachments:
        return {}
    try:
        return _PLACES.validate_json(kept(run, run.attachments, name))
    except ValidationError as error:
        what = f"its {name} does not say what is where: {error.errors()[0]['msg']}"
        raise InputError(str(run.path), what) from error


def _sources(run: Run) -> tuple[RecordedSource, ...]:
    text = run.attachments.get("sources.json")
    if text is None:
        return ()
    return read(str(run.path), text, (at.value for at in run.records(SourceAnswer)))


def _experience(run: Run) -> RecordedExperience | None:
    """The recorded experience; None if the robot did not learn, or in early recordings."""
    if "learns" not in run.metadata:
        return None
    return RecordedExperience(at.value for at in run.records(Recalled))


def _ways(run: Run) -> dict[tuple[str, str], float]:
    """The recorded durations of drives (s); infinite where the recording has -1: no path."""
    told = (at.value for at in run.records(WaysTold))
    return {
        (ways.start, place): seconds if seconds >= 0 else inf
        for ways in told
        for place, seconds in zip(ways.places, ways.seconds, strict=False)
    }


def _settings(run: Run) -> Settings:
    """The recorded settings; others have their defaults, whatever the environment says now.

    Recordings without `search` are from when there were only the paper's stages.
    """
    kept(run, run.attachments, "config.toml")
    recorded = {"search": "paper", **run.config()}
    fields = Settings.model_fields.items()
    unset = {name: field.get_default(call_default_factory=True) for name, field in fields}
    try:
        return Settings(**{**unset, **recorded})
    except ValidationError as error:
        fault = error.errors()[0]
        name = ".".join(map(str, fault["loc"]))
        what = f"its config.toml is not understood any more: {name} {in_words(fault)}"
        raise InputError(str(run.path), what) from error


@cache
def _prompts(text: bytes | None) -> Prompts:
    """The recorded prompts; today's, if the mission used ours."""
    if text is None:
        return Prompts.load()
    with TemporaryDirectory() as folder:
        file = Path(folder) / "prompts.toml"
        file.write_bytes(text)
        return Prompts.load(file)


@cache
def _ontology(
    places: tuple[Place, ...],
    things: tuple[Thing, ...],
    defaults: bool,
    files: tuple[tuple[str, bytes], ...],
    person: str | None,
) -> Ontology:
    """The ontology of the recorded files, which replace today's."""
    read = [parsed(Path(name), data) for name, data in files]
    return Ontology(places, things=things, defaults=defaults, files=read, person=person)


def kept(run: Run, where: Mapping[str, T], name: str) -> T:
    """What a recording keeps under this name.

    Raises:
        InputError: if it does not have it, as early recordings.
    """
    if name not in where:
        raise InputError(str(run.path), f"keeps no {name!r}", "replay needs a newer recording")
    return where[name]
