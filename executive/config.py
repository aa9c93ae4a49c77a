"""All settings in one model: from a TOML file, the environment, the command line; the last wins.

`--help` only needs the fields. So the code that reads the environment and validates values is
imported and built when the first settings are made.
"""

import json
import os
import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any, Literal, cast
from urllib.parse import urlsplit

import tomli_w
from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    ValidationError,
    field_validator,
    model_validator,
)
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from executive.cache import VARIABLE as CACHE
from executive.errors import InputError
from executive.servers.key import EARS_KEY, LLM_KEY
from executive.text import writable
from executive.toml_file import in_words as in_tomls_words
from executive.toml_file import misread, read_toml, shown

PREFIX = "EXECUTIVE_"
"""Prefix of the environment variables for settings."""
HEADERS = "EXECUTIVE_ROBOT_HEADERS"
NO_SETTINGS = frozenset((LLM_KEY, EARS_KEY, HEADERS, CACHE))
"""Other variables with this prefix: secrets, which are in no file, and the cache folder."""
JSON_EXAMPLES = """lists and tables are JSON there: '["a.owl"]', '{"mug": "desk"}'"""


@dataclass(frozen=True, slots=True)
class Option:
    """The command-line option of a setting; settings without it have no option.

    Attributes:
        metavar: placeholder for the value in `--help`.
        help: replaces the description and the default.
        after: the setting after which `--help` lists it (default: the one before it).
    """

    metavar: str = ""
    help: str = ""
    after: str = ""


class KnowledgeSystem(StrEnum):
    """The paper's three systems."""

    OKB = "okb"
    OKB_LLM = "okb+llm"
    OKB_LLM_MEM = "okb+llm+mem"


Whole = Annotated[int, Field(lt=2**63)]
"""An integer that fits into a TOML file, such as that of a run's settings."""


class Settings(BaseModel):
    """The settings of missions. Environment variables are named EXECUTIVE_HOME and so on.

    Each field is a setting. If it is annotated with an `Option`, the command line has it, too.
    """

    model_config = ConfigDict(
        extra="forbid",
        frozen=True,
        allow_inf_nan=False,
        validate_default=True,
        defer_build=True,
    )

    home: Annotated[str, Option("NAME or FILE.toml")] = Field(
        "four_rooms", description="name of a packaged home, or a FILE.toml"
    )
    knowledge: Annotated[KnowledgeSystem, Option()] = Field(
        KnowledgeSystem.OKB_LLM_MEM, description="the paper's three systems"
    )
    defaults: Annotated[
        bool, Option(help="whether the ontology knows default locations (default: it does)")
    ] = Field(True, description="whether the ontology knows default locations")
    llm: Annotated[str, Option("embedded, FILE.gguf, http://host:port/v1 or none")] = Field(
        "embedded", description="embedded, FILE.gguf, http://host:port/v1 of a server, or none"
    )
    llm_model: Annotated[str | None, Option("NAME")] = Field(
        None, description="name of the model on a server (default: the first that chats)"
    )
    grammar: Annotated[
        bool,
        Option(help="hold the model's replies to their JSON schema (default: trust and verify)"),
    ] = Field(False, description="hold the model's replies to their JSON schema")
    prompts: Annotated[Path | None, Option("FILE")] = Field(
        None, description="TOML file of texts that replace ours"
    )
    kb: Annotated[tuple[Path, ...], Option("FILE")] = Field(
        (), description="a person's own OWL file, which adds to ours or replaces one; repeatable"
    )
    person: Annotated[str | None, Option("NAME")] = Field(
        None, description="who is at home, as an OWL file names them"
    )
    elicit: Annotated[
        Literal["generate", "rank"] | None,
        Option(
            help="ask for a list (paper) or score each known place "
            "(default: rank for the embedded model, else generate)",
            after="llm_model",
        ),
    ] = Field(None, description="let the model write a list (paper) or score each known place")
    search: Annotated[
        Literal["plan", "paper"],
        Option(
            help="one belief and a plan that weighs looking against asking, "
            "or the paper's stages (default: plan)"
        ),
    ] = Field("plan", description="one belief and a plan, or the paper's stages")
    question_s: Annotated[
        float,
        Option(
            "SECONDS", "what a question to the person costs, in seconds of searching (default: 60)"
        ),
    ] = Field(60.0, ge=0, description="what a question costs, in seconds of searching")
    user: Annotated[Literal["console", "oracle", "none"], Option()] = Field(
        "console", description="who answers: you, the paper's simulated user, or nobody"
    )
    ears: Annotated[str | None, Option("pocketsphinx, http://host:port/v1 or DIR/")] = Field(
        None, description="who hears what you say aloud (docs/speech.md)"
    )
    ears_model: str | None = Field(
        None, description="name of the model on a server that hears (default: whisper-1)"
    )
    ears_language: str = Field(
        "en", pattern="^[a-z]{2,3}$", description="that is spoken, for a server that hears"
    )
    ears_timeout_s: float = Field(20.0, gt=0, description="how long a server may take to hear")
    microphone: Annotated[
        str, Option("arecord, FILE.wav, DIR or -", "where the ears hear it (default: arecord)")
    ] = Field("arecord", description="program that records, WAV file, folder of them, or a pipe")
    voice: Annotated[Literal["espeak-ng"] | None, Option()] = Field(
        None, description="who says aloud what the robot says"
    )
    place: Annotated[
        dict[str, str],
        Option(
            "OBJECT=FURNITURE", "where a thing truly is; repeatable (default: as in the home file)"
        ),
    ] = Field(default_factory=dict, description="where things truly are, beside the home file")
    world: Annotated[
        str,
        Option(
            "physics, fake or package.module:function", "PyBullet, or instant (default: physics)"
        ),
    ] = Field(
        "physics", description="PyBullet, or instant, or a robot of your own (docs/own-robot.md)"
    )
    robot: Annotated[str | None, Option("ws://HOST:PORT or ros2:")] = Field(
        None, description="a robot over rosbridge, or ROS 2 as it is sourced, instead of a world"
    )
    profile: Annotated[str | None, Option("NAME or FILE.toml")] = Field(
        None, description="what that robot has and how it calls it (docs/own-robot.md)"
    )
    detector: Annotated[str, Option("learned, simulated or FILE.onnx")] = Field(
        "learned",
        description="learned, simulated (never wrong), or FILE.onnx; the fake world has its own",
    )
    fault: Annotated[tuple[str, ...], Option("FAULT[=VALUE][@FROM[-TO]]")] = Field(
        (), description="what goes wrong in the simulated world; repeatable"
    )
    ycb: Annotated[Path | None, Option("DIR")] = Field(
        None, description="folder of YCB models to see instead of the packaged meshes"
    )
    seed: Annotated[Whole, Option("N")] = Field(
        0, ge=0, description="of the world, the model and the simulated person"
    )
    memory: Annotated[Path | None, Option("FILE")] = Field(
        None, description="SQLite file of what was seen and said; without, this session only"
    )
    home_state: Annotated[Path | None, Option("FILE")] = Field(
        None,
        description="TOML file that keeps where the simulated home's things were left; "
        "without, the home is put in order whenever a program starts",
    )
    habits: Annotated[str | None, Option("NAME or FILE.toml")] = Field(
        None, description="what those who live in the simulated home do with their things"
    )
    hours_between: Annotated[float, Option("N")] = Field(
        0.0, ge=0, le=1000, description="hours that pass in the simulated home before each command"
    )
    learn: Annotated[
        bool, Option(help="whether to remember what is seen and said (default: it does)")
    ] = Field(True, description="whether to remember what is seen and said")
    runs: Annotated[Path, Option("DIR")] = Field(
        Path("runs"), description="where each run leaves its folder"
    )

    temperature: float = Field(0.6, ge=0, description="of the language model (paper: 0.6)")
    top_p: float = Field(0.9, gt=0, le=1, description="of the language model (paper: 0.9)")
    context_tokens: Whole = Field(4096, ge=512, description="of the language model (paper: 4096)")
    max_tokens: Whole = Field(256, ge=1, description="longest reply of the language model")
    threads: Whole | None = Field(
        None, ge=1, description="of the language model (default: by the number of cores)"
    )
    gpu_layers: Whole = Field(
        0, ge=-1, description="of the language model, if llama.cpp was built for a GPU; -1: all"
    )
    top: Whole = Field(5, ge=1, description="places of a ranking that are worth a visit")
    answer_timeout_s: float = Field(120.0, gt=0, description="how long to wait for the person")
    llm_timeout_s: float = Field(60.0, gt=0, description="how long to wait for the model")
    action_timeout_s: float = Field(120.0, gt=0, description="how long an action may take")
    sure: float = Field(
        0.5, gt=0, le=1, description="confidence from which what is seen is believed"
    )
    camera_hz: Annotated[float, Option("RATE", after="detector")] = Field(
        1.0, ge=0, description="pictures a second for the log while the robot moves"
    )

    @model_validator(mode="before")
    @classmethod
    def _with_environment(cls, given: Any) -> Any:
        """Take settings that were not given from the environment."""
        return {**_said_in_environment(cls), **given} if isinstance(given, dict) else given

    @field_validator("home", "prompts", "ycb", "memory", "home_state", "runs", mode="before")
    @classmethod
    def _named(cls, value: Any) -> Any:
        """An empty path would be the folder that one is in."""
        if isinstance(value, str) and not value.strip():
            raise ValueError("is empty: name one, or leave it out")
        return value

    @field_validator("kb", "fault", mode="before")
    @classmethod
    def _one_alone(cls, value: Any) -> Any:
        """Accept a single value for a repeatable setting."""
        return (value,) if isinstance(value, str | Path) else value

    @field_validator("llm")
    @classmethod
    def _known_llm(cls, value: str) -> str:
        if value in ("embedded", "none") or value.endswith(".gguf"):
            return value
        if value.startswith(("http://", "https://")):
            return _address(value)
        raise ValueError("should be embedded, none, a FILE.gguf or http://host:port/v1")

    @field_validator("ears")
    @classmethod
    def _known_ears(cls, value: str | None) -> str | None:
        if value is None or value == "pocketsphinx" or value.startswith((".", "/", "~")):
            return value
        if value.startswith(("http://", "https://")):
            return _address(value, EARS_KEY)
        raise ValueError(
            "should be 'pocketsphinx', http://host:port/v1 or a folder such as ./models/whisper"
        )

    @field_validator("llm_model", "ears_model")
    @classmethod
    def _name_of_a_model(cls, value: str | None) -> str | None:
        if value is not None and not (value.strip() and value.isprintable() and len(value) <= 200):
            raise ValueError("should be a name of one line")
        return value

    @field_validator("world")
    @classmethod
    def _known_world(cls, value: str) -> str:
        module, colon, function = value.partition(":")
        names = (*module.split("."), function)
        if value in ("physics", "fake") or (colon and all(map(str.isidentifier, names))):
            return value
        raise ValueError("should be physics, fake or package.module:function")

    @field_validator("robot")
    @classmethod
    def _address_of_a_robot(cls, value: str | None) -> str | None:
        if value in (None, "ros2:"):
            return value
        if not value.startswith(("ws://", "wss://")):
            raise ValueError("should be ws://HOST:PORT, wss://HOST:PORT for TLS, or ros2:")
        return _address(value, HEADERS)

    @field_validator("detector")
    @classmethod
    def _known_detector(cls, value: str) -> str:
        if value in ("learned", "simulated") or value.endswith(".onnx"):
            return value
        raise ValueError("should be learned, simulated or a FILE.onnx")

    @property
    def body(self) -> str:
        """The name of the robot's body for messages."""
        return f"the robot at {self.robot}" if self.robot else f"the world {self.world}"

    @property
    def is_typed(self) -> bool:
        """Whether standard input is typed text; else it is sound from the microphone."""
        return self.ears is None or self.microphone != "-"

    @property
    def uses_llm(self) -> bool:
        """Whether the system uses a language model."""
        return self.knowledge != KnowledgeSystem.OKB and self.llm != "none"

    @property
    def remembers(self) -> bool:
        """Whether prompts for the model contain the dialogue so far."""
        return self.knowledge == KnowledgeSystem.OKB_LLM_MEM

    @property
    def elicitation(self) -> Literal["generate", "rank"]:
        """`elicit`, or its default: rank for the embedded model, else generate."""
        return self.elicit or ("rank" if self.llm == "embedded" else "generate")

    def to_toml(self) -> str:
        """The settings as a file that `--config` reads."""
        return tomli_w.dumps(self.model_dump(mode="json", exclude_none=True))


def load_settings(config: Path | None = None, **given: Any) -> Settings:
    """Settings from the file, the environment, and `given`, in which None means not given.

    Raises:
        InputError: if a setting is wrong; it names the setting and says what would be right.
    """
    from_file = read_toml(config) if config else {}
    given = {name: value for name, value in given.items() if value is not None}
    from_environment = _environment()
    said = {**from_file, **from_environment, **given}
    try:
        settings = Settings(**said)
    except ValidationError as error:
        fault = error.errors()[0]
        name = ".".join(str(part) for part in fault["loc"])
        known = ", ".join(Settings.model_fields)
        right = f"known are {known}" if fault["type"] == "extra_forbidden" else ""
        in_file = fault["loc"] and fault["loc"][0] in from_file
        where = f"{config}: {name}" if in_file else f"setting '{name}'"
        raise InputError(where, in_words(fault), right) from None
    for name, value in settings.model_dump(mode="json", exclude_unset=True).items():
        if (text := json.dumps(value, ensure_ascii=False)) != writable(text):
            right = "give a name that is; a run's settings are written down"
            raise InputError(f"setting '{name}'", f"is {ascii(value)}, which is no UTF-8", right)
    for other in misread(said, settings):
        if isinstance(other.value, bool):
            where = f"{config}: {other.key}" if other.key in from_file else f"setting '{other.key}'"
            raise InputError(where, f"is {other.shown}", other.right)
    return settings


def in_words(fault: ErrorDetails) -> str:
    """What is wrong with a setting, without pydantic's terms."""
    if fault["type"] == "extra_forbidden":
        return "is no setting"
    return in_tomls_words(fault["msg"])


def _address(url: str, secret: str = LLM_KEY) -> str:
    """Validate the address of a server; as each recording contains it, it must have no secret.

    Raises:
        ValueError: if it is wrong; says what would be right, without the address.
    """
    try:
        parts = urlsplit(url)
        fits = bool(parts.hostname) and parts.port != 0
    except ValueError:
        fits = False
    if not fits or not url.isprintable() or " " in url:
        example = "ws://HOST:PORT" if url.startswith("ws") else "http://host:port/v1"
        raise ValueError(f"should be an address such as {example}")
    if "@" in parts.netloc:
        raise ValueError(f"should be without user and password: set {secret} instead")
    if parts.query or parts.fragment:
        raise ValueError(f"should end before '?' and '#': a key belongs in {secret}")
    return url


def _said_in_environment(settings: type[Settings]) -> dict[str, Any]:
    """The environment's value of each field: a string, or parsed from JSON.

    Raises:
        SettingsError: if a value should be JSON and is not.
        InputError: if a table has a key twice, of which JSON would take the last.
    """
    from pydantic_settings import EnvSettingsSource  # see above

    class Environment(EnvSettingsSource):
        def decode_complex_value(self, field_name: str, field: FieldInfo, value: Any) -> Any:
            def each_once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
                for key, count in Counter(key for key, _ in pairs).items():
                    if count > 1:
                        what = f"has {shown(key)} {count} times"
                        raise InputError(PREFIX + field_name.upper(), what, "give it once")
                return dict(pairs)

            return json.loads(value, object_pairs_hook=each_once)

    return Environment(cast(Any, settings), env_prefix=PREFIX)()


def _environment() -> dict[str, Any]:
    """The settings that the environment sets.

    Raises:
        InputError: if a variable is wrong; names it.
    """
    from pydantic_settings import SettingsError

    _refuse_unknown(os.environ)
    try:
        return Settings(**_said_in_environment(Settings)).model_dump(exclude_unset=True)
    except ValidationError as error:
        fault = error.errors()[0]
        first, *rest = map(str, fault["loc"] or ("settings",))
        raise InputError(".".join([PREFIX + first.upper(), *rest]), in_words(fault)) from None
    except SettingsError as error:
        field = re.search(r'field "(\w+)"', str(error))
        name = PREFIX + field[1].upper() if field else f"{PREFIX}..."
        raise InputError(name, "is not JSON", JSON_EXAMPLES) from None
    except RecursionError:
        raise InputError(f"{PREFIX}...", "is nested too deep", JSON_EXAMPLES) from None


def _refuse_unknown(names: Iterable[str]) -> None:
    """Refuse unknown variables with our prefix, without showing values, which may be secrets.

    Raises:
        InputError: if there is one.
    """
    known = {PREFIX + name.upper() for name in Settings.model_fields} | NO_SETTINGS
    for name in sorted(names):
        same = {other for other in names if other.upper() == name.upper()}
        if len(same) > 1 and name.upper().startswith(PREFIX):
            raise InputError(" and ".join(sorted(same)), "are the same setting", "keep one")
        if name.upper().startswith(PREFIX) and name.upper() not in known:
            near = get_close_matches(name.upper(), known, n=1, cutoff=0)[0]
            raise InputError(name, "is no setting", f"the nearest is {near}")
