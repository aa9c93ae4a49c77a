"""`--world package.module:factory`: a robot of one's own needs no edit here."""

import json
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from executive.__main__ import main
from executive.app.embodiment import Setup
from executive.app.session import Session
from executive.campaign import blocks
from executive.config import load_settings
from executive.errors import InputError
from executive.events import Inbox
from executive.replay import replay
from executive.testing.bench import Notebook, four_rooms, ontology

OWN = """
from dataclasses import replace
from executive.app.simulation import fake

def robot(setup):
    return replace(fake(setup), truth=None, in_map=True)

def simulated(setup):
    return fake(setup)

def broken(setup):
    raise ConnectionError("the robot is off")

def nothing(setup):
    return None

number = 3
"""


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The module of somebody's robot, in the folder where the command is given."""
    file = tmp_path / "own_world.py"
    file.write_text(OWN)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [*sys.path])
    yield file
    sys.modules.pop("own_world", None)


def run(*options: str) -> int:
    return main(["--llm", "none", "--user", "none", "--json", *options])


def test_a_mission_runs_with_it_and_replays_without_it(
    own: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("--world", "own_world:robot", "Take", "a", "power_drill") == 0
    outcome = json.loads(capsys.readouterr().out)
    assert outcome["command"] == "Take a power_drill"
    own.unlink()
    del sys.modules["own_world"]
    replayed = replay(Path(outcome["run_dir"]))
    assert (replayed.parting, replayed.notes) == (None, ())
    assert "own_world" not in sys.modules


def test_the_oracle_answers_from_the_truth_of_a_world_of_ones_own(own: Path) -> None:
    assert run("--world", "own_world:simulated", "--user", "oracle", "Bring an apple") == 0


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--world", "moon"], "should be physics, fake or package.module:factory"),
        (["--world", "own world:robot"], "should be physics, fake or package.module:factory"),
        (["--world", "no_such_world:robot"], "there is no module no_such_world"),
        (["--world", "own_world:arm"], "own_world has no function arm"),
        (["--world", "own_world:number"], "own_world has no function number"),
        (["--world", "own_world:broken"], "cannot be built: ConnectionError: the robot is off"),
        (["--world", "own_world:nothing"], "returned a NoneType"),
        (["--world", "own_world:robot", "--user", "oracle"], "own_world:robot has none"),
        (["--world", "own_world:robot", "--fault", "blind"], "own_world:robot is not simulated"),
    ],
)
def test_what_is_wrong_with_it_is_told_in_a_sentence(
    own: Path, options: list[str], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(*options, "Find the mug") == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert sentence in line


@pytest.mark.parametrize("text", ["1/0", "import sys; sys.exit(3)", "def", "import no_such_part"])
def test_a_module_that_cannot_be_imported_is_bad_input(own: Path, text: str) -> None:
    own.write_text(text)
    assert run("--world", "own_world:robot", "Find the mug") == 2


def test_a_campaign_without_the_truth_is_refused(own: Path) -> None:
    settings = load_settings(world="own_world:robot", user="none", llm="none")
    with pytest.raises(InputError, match="not simulated: nobody knows what truly came"):
        next(blocks.run(blocks.Block(settings, ("Find the mug",))))


def test_what_begins_and_ends_with_a_session_is_called(
    own: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    called = []

    def broken(what: str) -> Callable[[], None]:
        def call() -> None:
            called.append(what)
            raise ConnectionError(what)

        return call

    own.write_text(OWN.replace("truth=None", "begin=begin, close=close, truth=None"))
    monkeypatch.syspath_prepend(own.parent)
    import own_world

    own_world.begin, own_world.close = broken("begin"), broken("close")
    settings = load_settings(world="own_world:robot", user="none", llm="none")
    with Session(settings, recorded=False) as session:
        assert session.run("Find the power_drill").status == "done"
    assert called == ["begin", "close"]


def test_a_detector_that_only_a_simulation_has_is_refused() -> None:
    settings = load_settings(detector="simulated")
    setup = Setup(settings, four_rooms(), Inbox(), Notebook(), ontology(True))
    with pytest.raises(InputError, match="simulated is not for this world"):
        setup.detector()
