"""`--world`: which body a mission has, by its name."""

import importlib
import logging
import sys
from collections.abc import Mapping
from pathlib import Path

from executive.app import simulation
from executive.app.embodiment import Embodiment, Factory, Setup
from executive.errors import ExecutiveError, InputError
from executive.guards import in_words

log = logging.getLogger(__name__)

OURS: Mapping[str, Factory] = {"physics": simulation.physics, "fake": simulation.fake}
RIGHT = "name a function that takes a Setup and returns an Embodiment (docs/own-robot.md)"


def embody(setup: Setup) -> Embodiment:
    """The embodiment that the settings name.

    Raises:
        InputError: if one of somebody's own cannot be imported or built, or lacks what the
            settings ask for.
    """
    name = setup.settings.world
    embodiment = OURS[name](setup) if name in OURS else _own(name, setup)
    if setup.settings.fault and embodiment.truth is None:
        raise InputError(
            "setting 'fault'",
            f"the world {name} is not simulated: nothing goes wrong there by order",
            "leave --fault out, or use --world physics",
        )
    return embodiment


def _own(name: str, setup: Setup) -> Embodiment:
    """What somebody's function builds; whatever it raises is told in a sentence."""
    where = f"--world {name}"
    factory = _imported(name)
    try:
        embodiment: object = factory(setup)
    except ExecutiveError:
        raise
    except (Exception, SystemExit) as error:
        raise _broken(where, "cannot be built", error) from None
    if not isinstance(embodiment, Embodiment):
        raise InputError(where, f"returned a {type(embodiment).__name__}", RIGHT)
    return embodiment


def _imported(name: str) -> Factory:
    where = f"--world {name}"
    module_name, _, attribute = name.partition(":")
    here = str(Path.cwd())
    if here not in sys.path:
        sys.path.append(here)  # a console script does not look where it is started
    try:
        module = importlib.import_module(module_name)
    except ModuleNotFoundError as error:
        what = f"there is no module {error.name}"
        right = "run in its folder, or name that in PYTHONPATH"
        raise InputError(where, what, right) from None
    except (Exception, SystemExit) as error:
        raise _broken(where, "cannot be imported", error) from None
    factory: object = getattr(module, attribute, None)
    if not callable(factory):
        raise InputError(where, f"{module_name} has no function {attribute}", RIGHT)
    return factory


def _broken(where: str, what: str, error: BaseException) -> InputError:
    log.debug("raised by a world of somebody's own", exc_info=error)
    return InputError(where, f"{what}: {in_words(error)}", "-vv says where")
