"""Homes on the command line: `view` draws one, `check` names its faults, `generate` makes one.

`view objects` draws all objects. `serve` has the robot in one driven from outside.
"""

from executive.start import begin

if __name__ == "__main__":
    begin()

import argparse
import io
import json
import math
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from executive.errors import InputError
from executive.shell import DONE, entry_point
from executive.text import printable
from executive.usage import Parser
from sim.served.command import add_serving

if TYPE_CHECKING:  # a command imports what it needs
    import numpy as np
    from numpy.typing import NDArray
    from PIL import Image

    from sim.home.home import Home
    from sim.objects.objects import ObjectModel

WIDTH, HEIGHT = 1280, 1080
DISTANCE = 4.35
"""Distance of the camera, as a multiple of the home's length: so far that perspective is weak."""
STEEPNESS = math.radians(62.0)
MARGIN = 1.08
"""The picture shows this many times the size of the home."""


@entry_point
def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit status (0 done, 1 the home has faults, 2 bad input)."""
    parser = Parser(prog="python -m sim", description=__doc__)
    commands = parser.add_subparsers(required=True, metavar="command")
    view = commands.add_parser("view", help="draw a home from above, or all objects, as a PNG file")
    view.add_argument(
        "home",
        nargs="?",
        default="four_rooms",
        help="name or FILE.toml (default: four_rooms); or: objects",
    )
    view.add_argument(
        "--out", type=Path, metavar="FILE.png", help="default: HOME.png or objects.png"
    )
    view.add_argument("--ycb", type=Path, metavar="DIR", help="YCB models to see instead of ours")
    view.set_defaults(run=_view)
    check = commands.add_parser("check", help="name all that is wrong with a home")
    check.add_argument("home", help="name or FILE.toml")
    check.add_argument(
        "--kb",
        action="append",
        default=[],
        type=Path,
        metavar="FILE",
        help="own OWL file that has classes of the home, as given to missions; repeatable",
    )
    check.add_argument("--json", action="store_true", help="print a JSON array of sentences")
    check.set_defaults(run=_check)
    generate = commands.add_parser("generate", help="make a home file of any size")
    generate.add_argument("--rooms", type=int, default=12, metavar="N", help="default: 12")
    generate.add_argument("--furniture", type=int, default=60, metavar="N", help="default: 60")
    generate.add_argument("--seed", type=int, default=0, metavar="N", help="default: 0")
    generate.add_argument("--out", type=Path, metavar="FILE.toml", help="default: print it")
    generate.set_defaults(run=_generate)
    add_serving(commands)
    options = parser.parse_args(arguments)
    return int(options.run(options))


def _view(options: argparse.Namespace) -> int:
    from PIL import Image

    from sim.home.home_file import load_home
    from sim.objects.objects import load_objects
    from sim.objects.ycb import with_scans
    from sim.tools.catalogue import contact_sheet

    def seen(models: "dict[str, ObjectModel]") -> "dict[str, ObjectModel]":
        return with_scans(models, options.ycb) if options.ycb else models

    if options.home == "objects":
        sheet = contact_sheet(seen(load_objects()).values())
        _write(options.out or Path("objects.png"), _png(sheet))
        return DONE
    home = load_home(options.home)
    out = options.out or Path(f"{home.name}.png")
    _write(out, _png(Image.fromarray(draw(home, seen(home.drawn_models())))))
    return DONE


def _check(options: argparse.Namespace) -> int:
    from sim.tools.checking import check_home, notes_on

    faults = [str(fault) for fault in (*_unknown(options), *check_home(options.home))]
    notes = [f"note: {note}" for note in notes_on(options.home)]
    if options.json:
        print(json.dumps([*faults, *notes], indent=2, ensure_ascii=False))
    else:
        print("\n".join([*notes, *(faults or [f"{printable(options.home)}: no faults"])]))
    return 1 if faults else 0


def _unknown(options: argparse.Namespace) -> "tuple[InputError, ...]":
    """Names of the home that the ontology lacks or has as something else; if the file is valid."""
    from kb.ontology.ontology import Ontology
    from sim.home.home_file import inspect_home

    ontology = Ontology(files=options.kb)
    home, faults = inspect_home(options.home)
    if home is None or faults:
        return ()
    return tuple(ontology.home_faults(home.places(), home.things(), home.file))


def _generate(options: argparse.Namespace) -> int:
    from sim.tools.generation import generate_home

    text = generate_home(options.rooms, options.furniture, options.seed)
    if options.out is None:
        print(text, end="")
    else:
        _write(options.out, text.encode())
    return DONE


def _write(path: Path, content: bytes) -> None:
    try:
        path.write_bytes(content)
    except OSError as error:
        right = "give a file in a folder that exists"
        raise InputError(f"--out {path}", f"cannot write: {error.strerror}", right) from None
    print(printable(path))


def draw(home: "Home", models: "Mapping[str, ObjectModel]") -> "NDArray[np.uint8]":
    """Draw the home with low walls, obliquely from the south: (HEIGHT, WIDTH, 3) RGB."""
    import numpy as np
    from scipy.spatial.transform import Rotation

    from executive.types.geometry import Pose
    from executive.types.perception import Intrinsics
    from sim.bullet.bodies import VIEWED_WALL_HEIGHT_M, build_home, place_objects
    from sim.bullet.camera import render
    from sim.bullet.client import connect

    edges = np.array([room.rectangle for room in home.rooms])
    lower, upper = edges[:, :2].min(axis=0), edges[:, 2:].max(axis=0)
    across, along = (upper - lower) * MARGIN
    distance = DISTANCE * float(max(upper - lower))
    focal = distance * float(min(WIDTH / across, HEIGHT / (along * np.sin(STEEPNESS))))
    intrinsics = Intrinsics(WIDTH, HEIGHT, focal, focal, (WIDTH - 1) / 2, (HEIGHT - 1) / 2)
    turn = Rotation.from_euler("x", -np.pi / 2 - STEEPNESS)
    middle = np.array([*(lower + upper) / 2, 0.0])
    eye = middle - distance * turn.as_matrix()[:, 2]
    x, y, z, w = (float(value) for value in turn.as_quat())
    pose = Pose(tuple(eye.tolist()), (x, y, z, w))
    client = connect()
    build_home(client, home.model_copy(update={"wall_height": VIEWED_WALL_HEIGHT_M}))
    place_objects(client, home, models)
    color = render(client, pose, intrinsics, far=2 * distance).color
    client.disconnect()
    return color


def _png(picture: "Image.Image") -> bytes:
    content = io.BytesIO()
    picture.save(content, "PNG", optimize=True)
    return content.getvalue()


if __name__ == "__main__":
    sys.exit(main())
