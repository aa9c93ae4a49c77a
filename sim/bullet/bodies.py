"""Home and objects as PyBullet bodies, and as entities for the viewer."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, Literal

from scipy.spatial.transform import Rotation

from executive.colors import Color
from executive.geometry import carried_by
from executive.records import Entity, Shape
from executive.types.geometry import Pose, Vector3
from executive.types.home import PERSON
from sim.engine import BulletClient
from sim.engine import pybullet as p
from sim.home.furniture import box
from sim.home.home import Home
from sim.objects.objects import ObjectModel

MAP = "map"
WALL_COLOR: Color = (0.93, 0.91, 0.86, 1.0)
FLOOR_COLOR: Color = (0.62, 0.60, 0.56, 1.0)
FLOOR_COLORS: dict[str, Color] = {
    "Kitchen": (0.78, 0.79, 0.77, 1.0),
    "LivingRoom": (0.70, 0.55, 0.38, 1.0),
    "Bedroom": (0.58, 0.62, 0.68, 1.0),
    "Lobby": (0.66, 0.60, 0.52, 1.0),
}
FLOOR_THICKNESS_M = 0.1
VIEWED_WALL_HEIGHT_M = 0.5
"""Walls are cut off at this height for the viewer, who looks in from above."""
FURNITURE_FRICTION = 0.8
ROLLING_FRICTION = 5e-4
"""Rolling and spinning friction (metres, PyBullet's unit), so that a rolling ball comes to rest."""
SETTLING_STEPS = 120
"""Physics steps in which placed objects come to rest."""

PERSON_SHAPES = (
    Shape("cylinder", (0.30, 0.30, 0.80), (0.22, 0.25, 0.33, 1.0), Pose((0.0, 0.0, 0.40))),
    Shape("cylinder", (0.38, 0.38, 0.62), (0.30, 0.48, 0.42, 1.0), Pose((0.0, 0.0, 1.11))),
    Shape("sphere", (0.23, 0.23, 0.23), (0.85, 0.66, 0.53, 1.0), Pose((0.0, 0.0, 1.55))),
)
_SHAPE_TYPES = {"box": p.GEOM_BOX, "cylinder": p.GEOM_CYLINDER, "sphere": p.GEOM_SPHERE}


def create_body(
    client: BulletClient,
    shapes: Sequence[Shape],
    pose: Pose,
    mass: float = 0.0,
    friction: float = FURNITURE_FRICTION,
    center_of_mass: Vector3 = (0.0, 0.0, 0.0),
    look: Shape | None = None,
) -> int:
    """Create one rigid body from shapes, and return its id.

    Args:
        client: the world.
        shapes: primitives in the body's frame, at most 16 (PyBullet's limit); no meshes.
        pose: the body's frame in `map`.
        mass: in kilograms; 0 for fixed bodies.
        friction: lateral friction coefficient.
        center_of_mass: in the body's frame (metres). PyBullet reports this point as the body's
            position; `frame_pose` returns the pose of the frame.
        look: a mesh to draw instead of the shapes.
    """
    body: int = client.createMultiBody(
        mass,
        client.createCollisionShapeArray(**_arrays(shapes, "collision")),
        _mesh(client, look) if look else client.createVisualShapeArray(**_arrays(shapes, "visual")),
        pose.position,
        pose.orientation,
        baseInertialFramePosition=center_of_mass,
    )
    for index, shape in enumerate((look,) if look else shapes):
        client.changeVisualShape(
            body, -1, shapeIndex=index, rgbaColor=shape.color, specularColor=(0.1, 0.1, 0.1)
        )
    client.changeDynamics(
        body,
        -1,
        lateralFriction=friction,
        rollingFriction=ROLLING_FRICTION,
        spinningFriction=ROLLING_FRICTION,
    )
    return body


def _arrays(shapes: Sequence[Shape], purpose: Literal["collision", "visual"]) -> dict[str, Any]:
    """PyBullet's arguments for primitive shapes."""
    return {
        "shapeTypes": [_SHAPE_TYPES[shape.kind] for shape in shapes],
        "halfExtents": [[length / 2 for length in shape.size] for shape in shapes],
        "radii": [shape.size[0] / 2 for shape in shapes],
        "lengths": [shape.size[2] for shape in shapes],
        f"{purpose}FramePositions": [shape.pose.position for shape in shapes],
        f"{purpose}FrameOrientations": [shape.pose.orientation for shape in shapes],
    }


def _mesh(client: BulletClient, look: Shape) -> int:
    """Create a visual shape from an OBJ file, with the texture that its material names."""
    mesh: int = client.createVisualShape(
        p.GEOM_MESH,
        fileName=look.mesh,
        meshScale=look.size,
        visualFramePosition=look.pose.position,
        visualFrameOrientation=look.pose.orientation,
    )
    return mesh


def frame_pose(client: BulletClient, body: int) -> Pose:
    """The pose in `map` of the frame of a body made by `create_body`."""
    position, orientation = client.getBasePositionAndOrientation(body)
    center_of_mass = client.getDynamicsInfo(body, -1)[3]
    origin = position - Rotation.from_quat(orientation).apply(center_of_mass)
    return Pose(tuple(origin.tolist()), tuple(orientation))


def put_at(client: BulletClient, body: int, pose: Pose) -> None:
    """Put a body made by `create_body` at rest with its frame at a pose in `map`."""
    center_of_mass = client.getDynamicsInfo(body, -1)[3]
    middle = Rotation.from_quat(pose.orientation).apply(center_of_mass) + pose.position
    client.resetBasePositionAndOrientation(body, middle, pose.orientation)
    client.resetBaseVelocity(body, (0, 0, 0), (0, 0, 0))


def build_home(client: BulletClient, home: Home) -> dict[int, str]:
    """Create floors, walls, furniture and the person; return each body's name by its id."""
    return {create_body(client, shapes, pose): name for name, shapes, pose in _fixtures(home)}


def place_objects(
    client: BulletClient, home: Home, models: Mapping[str, ObjectModel]
) -> dict[int, str]:
    """Create the home's objects at their start poses, and let them come to rest.

    Returns:
        Each object's name by its body id.
    """
    poses = home.object_poses()
    names = {create_object(client, models[name], pose): name for name, pose in poses.items()}
    settle(client)
    return names


def settle(client: BulletClient) -> None:
    """Step the physics until placed objects have come to rest."""
    for _ in range(SETTLING_STEPS):
        client.stepSimulation()


def create_object(client: BulletClient, model: ObjectModel, pose: Pose) -> int:
    """Create an object with its frame at `pose` in `map`, and return its id."""
    return create_body(
        client,
        model.shapes,
        pose,
        model.mass_kg,
        model.friction,
        model.center_of_mass,
        model.look,
    )


def home_entities(home: Home, models: Mapping[str, ObjectModel]) -> tuple[Entity, ...]:
    """The home for the viewer: fixed parts in `map`, each object in a frame of its own name."""
    low = home.model_copy(update={"wall_height": min(home.wall_height, VIEWED_WALL_HEIGHT_M)})
    fixed = [Entity(name, MAP, _moved(shapes, pose)) for name, shapes, pose in _fixtures(low)]
    movable = [Entity(name, name, models[name].shown) for name in home.objects]
    return (*fixed, *movable)


def _fixtures(home: Home) -> Iterator[tuple[str, tuple[Shape, ...], Pose]]:
    """Name, shapes (in the body's frame) and pose (in `map`) of all fixed bodies of the home."""
    for room in home.rooms:
        left, lower, right, upper = room.rectangle
        color = FLOOR_COLORS.get(room.kind, FLOOR_COLOR)
        size = (right - left, upper - lower, FLOOR_THICKNESS_M)
        middle = ((left + right) / 2, (lower + upper) / 2, -FLOOR_THICKNESS_M / 2)
        yield f"floor_{room.name}", (box(size, (0.0, 0.0, 0.0), color),), Pose(middle)
    for number, wall in enumerate(home.walls(), start=1):
        shape = box((*wall.size, home.wall_height), (0.0, 0.0, home.wall_height / 2), WALL_COLOR)
        yield f"wall_{number}", (shape,), Pose((*wall.center, 0.0))
    for piece in (*home.furniture, home.delivery):
        yield piece.name, piece.shapes(), piece.frame()
    yield PERSON, PERSON_SHAPES, Pose((home.person[0], home.person[1], 0.0))


def _moved(shapes: Sequence[Shape], pose: Pose) -> tuple[Shape, ...]:
    """Shapes of a frame at `pose`, transformed to the parent frame."""
    return tuple(replace(shape, pose=carried_by(pose, shape.pose)) for shape in shapes)
