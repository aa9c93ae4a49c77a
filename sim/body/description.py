"""The robot's URDF: the base of `assets/mobile_base.urdf` with a Franka Panda on its lift.

The Panda comes from pybullet_data. Its collision meshes also serve as visual meshes: they have a
fiftieth of the triangles, and rendering time grows with their number.
"""

from importlib.resources import files
from pathlib import Path
from xml.etree import ElementTree

import pybullet_data
from scipy.spatial.transform import Rotation

from executive.colors import Color
from executive.geometry import pose_from
from executive.records import Entity, Shape
from executive.types.geometry import Pose, Vector3

_PADS = {"lateral_friction": "1.0", "spinning_friction": "0.006", "rolling_friction": "0.002"}
"""Rubber pads on the finger tips. A pad 18 mm wide also resists turning; PyBullet takes spinning
and rolling friction in metres."""
_FINGER_BOXES = (
    ((0.0176, 0.0142, 0.0347), (0.0, 0.0071, 0.03635)),
    ((0.0208, 0.0236, 0.0190), (0.0, 0.0144, 0.0095)),
)
"""Collision boxes of a finger: size and centre (metres) in the left finger's frame.

For the convex hull of the finger's mesh, Bullet sometimes finds a contact with a reversed normal;
the held object then sticks to the finger. With boxes the contacts are exact.
"""
_WHITE: Color = (0.92, 0.92, 0.90, 1.0)


def describe_robot() -> ElementTree.Element:
    """The URDF of the whole robot; the file names of meshes are absolute paths."""
    robot = ElementTree.fromstring(files("sim").joinpath("assets/mobile_base.urdf").read_text())
    robot.extend(_panda())
    mount = ElementTree.SubElement(robot, "joint", name="arm_mount", type="fixed")
    ElementTree.SubElement(mount, "parent", link="carriage")
    ElementTree.SubElement(mount, "child", link="panda_link0")
    return robot


def write_description(directory: Path) -> Path:
    """Write the URDF to `robot.urdf` in a directory, and return its path."""
    path = directory / "robot.urdf"
    ElementTree.ElementTree(describe_robot()).write(path)
    return path


def robot_entities(robot: ElementTree.Element) -> tuple[Entity, ...]:
    """The visual shapes of each link, in the link's frame."""
    colors = {m.get("name"): _color(m) for m in robot.findall("material")}
    entities = []
    for link in robot.findall("link"):
        shapes = tuple(_shape(visual, colors) for visual in link.findall("visual"))
        if shapes:
            name = str(link.get("name"))
            entities.append(Entity(name, name, shapes))
    return tuple(entities)


def _panda() -> ElementTree.Element:
    folder = Path(pybullet_data.getDataPath()) / "franka_panda"
    panda = ElementTree.parse(folder / "panda.urdf").getroot()
    for mesh in panda.iter("mesh"):
        name = str(mesh.get("filename")).rsplit("/", 1)[-1]
        mesh.set("filename", str(folder / "meshes" / "collision" / name))
    for contact in panda.iter("contact"):
        contact[:] = [ElementTree.Element(tag, value=value) for tag, value in _PADS.items()]
    for link in panda.findall("link"):
        if str(link.get("name")).endswith("finger"):
            _replace_collision(link)
    for visual in panda.iter("visual"):
        for material in visual.findall("material"):
            visual.remove(material)
    return panda


def _replace_collision(finger: ElementTree.Element) -> None:
    """Replace a finger's collision mesh by boxes, mirrored if the mesh is."""
    mesh = finger.find("collision")
    assert mesh is not None
    mirror = -1 if mesh.find("origin") is not None else 1
    finger.remove(mesh)
    for size, (x, y, z) in _FINGER_BOXES:
        collision = ElementTree.SubElement(finger, "collision")
        ElementTree.SubElement(collision, "origin", xyz=f"{x} {mirror * y} {z}")
        geometry = ElementTree.SubElement(collision, "geometry")
        ElementTree.SubElement(geometry, "box", size=" ".join(map(str, size)))


def _shape(visual: ElementTree.Element, colors: dict[str | None, Color]) -> Shape:
    material = visual.find("material")
    color = _WHITE if material is None else colors[material.get("name")]
    pose = _pose(visual.find("origin"))
    geometry = visual.find("geometry/*")
    assert geometry is not None
    match geometry.tag:
        case "box":
            return Shape("box", _vector(geometry.get("size")), color, pose)
        case "cylinder":
            diameter = 2 * float(geometry.get("radius", 0))
            size = (diameter, diameter, float(geometry.get("length", 0)))
            return Shape("cylinder", size, color, pose)
        case _:
            return Shape("mesh", (1.0, 1.0, 1.0), color, pose, mesh=geometry.get("filename", ""))


def _pose(origin: ElementTree.Element | None) -> Pose:
    if origin is None:
        return Pose()
    turn = Rotation.from_euler("xyz", _vector(origin.get("rpy")))
    return pose_from(_vector(origin.get("xyz")), turn)


def _vector(text: str | None) -> Vector3:
    x, y, z = (float(v) for v in (text or "0 0 0").split())
    return x, y, z


def _color(material: ElementTree.Element) -> Color:
    rgba = material.find("color")
    assert rgba is not None
    red, green, blue, opacity = (float(v) for v in str(rgba.get("rgba")).split())
    return red, green, blue, opacity
