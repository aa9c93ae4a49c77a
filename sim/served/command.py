"""`python -m sim serve`: the simulated robot for clients over the network."""

import argparse
from contextlib import suppress
from typing import Any

from executive.errors import InputError
from executive.options import add_setting
from executive.shell import DONE
from executive.text import printable
from sim.served.ordered import FASTEST, MOVEIT, PORT, SKILLS


def add_serving(commands: "argparse._SubParsersAction[Any]") -> None:
    """Add the command."""
    serve = commands.add_parser(
        "serve",
        help="serve the simulated robot over rosbridge's protocol",
        description="Serve the simulated robot over rosbridge's protocol, to this machine only.",
    )
    add_setting(serve, "home", default="four_rooms", help="name or FILE.toml (default: four_rooms)")
    world = {"choices": ["physics", "fake"], "default": "physics"}
    serve.add_argument("--world", **world, help="PyBullet, or instant (default: physics)")
    serve.add_argument(
        "--arm",
        choices=[SKILLS, MOVEIT],
        default=SKILLS,
        help="picks up and puts down by itself, or offers MoveIt 2's motions and a gripper: "
        f"profile served_moveit2 (default: {SKILLS})",
    )
    add_setting(serve, "place")
    add_setting(serve, "fault")
    add_setting(serve, "seed", default=0, help="of the world and of what goes wrong (default: 0)")
    serve.add_argument(
        "--port", type=int, default=PORT, metavar="N", help=f"default: {PORT}; 0: any that is free"
    )
    serve.add_argument(
        "--speed",
        type=float,
        default=FASTEST,
        metavar="X",
        help=f"seconds of the robot's that may pass in a real one (default: {FASTEST:g})",
    )
    serve.add_argument("--gui", action="store_true", help="show PyBullet's own window")
    serve.set_defaults(run=_serve)


def _serve(options: argparse.Namespace) -> int:
    from sim.home.home_file import load_home  # slow to import, and not needed for --help
    from sim.home.validation import with_placement
    from sim.served.serving import Plan, build

    if not 0 <= options.port < 2**16:
        raise InputError(f"--port {options.port}", "is no port", "give 0 to 65535")
    if not 0.01 <= options.speed <= 1000.0:
        raise InputError(
            f"--speed {options.speed:g}", "is too slow or too fast", "give 0.01 to 1000"
        )
    if options.seed < 0:
        raise InputError(f"--seed {options.seed}", "is negative")
    if options.arm == MOVEIT and options.world != "physics":
        raise InputError(f"--arm {MOVEIT}", "the instant world has no arm", "leave out --world")
    home = with_placement(load_home(options.home), options.place or {})
    plan = Plan(
        home,
        world=options.world,
        arm=options.arm,
        faults=options.fault or (),
        seed=options.seed,
        port=options.port,
        speed=options.speed,
        gui=options.gui,
    )
    served = build(plan, _tell)
    try:
        served.server.listen()
        _tell(f"the robot of {home.name} is at {served.server.address} (Ctrl-C ends that)")
        served.run()
    finally:
        served.close()
    return DONE


def _tell(text: str) -> None:
    with suppress(BrokenPipeError):  # nobody reads stdout any more; clients still use the robot
        print(printable(text), flush=True)
