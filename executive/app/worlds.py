"""Chooses the embodiment by `--world` and `--robot`."""

from collections.abc import Mapping

from executive.app import simulation
from executive.app.embodiment import Embodiment, Factory, Setup
from executive.app.own import Named
from executive.errors import InputError

OURS: Mapping[str, Factory] = {"physics": simulation.physics, "fake": simulation.fake}
RIGHT = "name a function that takes a Setup and returns an Embodiment (docs/own-robot.md)"


def embody(setup: Setup) -> Embodiment:
    """Build the embodiment that the settings name.

    Raises:
        InputError: if it cannot be imported, built or connected to, or a setting does not fit it.
    """
    name = setup.settings.world
    if setup.settings.profile and not setup.settings.robot:
        raise InputError(
            "setting 'profile'",
            f"{setup.settings.body} needs none: it says what a robot over the wire has",
            "give --robot ws://HOST:PORT, too, or leave --profile out",
        )
    if setup.settings.robot:
        from executive.app.wire import wire  # websockets is slow to import

        embodiment = wire(setup)
    else:
        embodiment = OURS[name](setup) if name in OURS else _own(name, setup)
    if setup.settings.fault and embodiment.truth is None:
        raise InputError(
            "setting 'fault'",
            f"{setup.settings.body} is not simulated here: nothing goes wrong there by order",
            "leave --fault out, or use --world physics",
        )
    return embodiment


def try_world(name: str) -> None:
    """Check that a world exists, without opening it.

    Raises:
        InputError: if it is a user's own and cannot be imported.
    """
    if name not in OURS:
        Named("--world", name, RIGHT).imported()


def _own(name: str, setup: Setup) -> Embodiment:
    named = Named("--world", name, RIGHT)
    return named.called(named.imported(), setup, Embodiment)
