"""How the objects look: the packaged meshes, how they are made, and YCB's in their place."""

from pathlib import Path

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray
from PIL import Image
from scans import MODELS, scan
from scipy.spatial.transform import Rotation

from executive.errors import InputError
from executive.records import Shape
from executive.testing.bench import four_rooms
from sim.__main__ import main
from sim.bullet.bodies import home_entities
from sim.modelling.__main__ import main as make
from sim.objects.meshes import aligned
from sim.objects.objects import ASSETS, drawings
from sim.objects.solids import signed_distance
from sim.objects.ycb import MESH, with_scans
from sim.tools.catalogue import portrait

YCB_SIZES_MM = {
    "apple": (75, 75, 75),
    "bleach_cleanser": (65, 98, 250),
    "cracker_box": (60, 158, 210),
    "mustard_bottle": (50, 85, 175),
    "orange": (73, 73, 73),
    "peach": (59, 59, 59),
    "pear": (66, 66, 100),
    "pitcher_base": (None, 108, 235),
    "potted_meat_can": (50, 97, 82),
    "power_drill": (57, 187, 184),
    "pudding_box": (35, 110, 89),
    "scissors": (87, 200, 14),
    "spatula": (83, 350, None),
    "strawberry": (44, 44, 55),
    "sugar_box": (38, 89, 175),
    "tennis_ball": (65, 65, 65),
    "tomato_soup_can": (66, 66, 101),
}
"""As published (Calli et al. 2015), where it gives the whole object; None where ours is more."""


def points_of(look: Shape) -> NDArray[np.float64]:
    """The mesh's points where the object's frame has them."""
    points = trimesh.load_mesh(look.mesh, process=False).vertices
    turn = Rotation.from_quat(look.pose.orientation)
    return np.asarray(turn.apply(points * look.size) + look.pose.position)


# --- the packaged meshes ---


@pytest.mark.parametrize("name", YCB_SIZES_MM)
def test_a_thing_has_the_published_size(name: str):
    for ours, published in zip(MODELS[name].size, YCB_SIZES_MM[name], strict=True):
        assert published is None or 1000 * ours == pytest.approx(published, abs=2.5)


@pytest.mark.parametrize("name", drawings())
def test_a_mesh_fills_the_bounding_box_of_what_collides(name: str):
    model, points = MODELS[name], points_of(MODELS[name].look)
    assert points.min(axis=0) == pytest.approx(model.lower, abs=1e-4)
    assert points.max(axis=0) == pytest.approx(model.upper, abs=1e-4)


@pytest.mark.parametrize("name", drawings())
def test_a_mesh_lies_on_what_collides(name: str):
    mesh = trimesh.load_mesh(MODELS[name].look.mesh, process=False)
    points, _ = trimesh.sample.sample_surface(mesh, 2000, seed=1)
    away = np.abs(signed_distance(MODELS[name].shapes, points))
    assert away.mean() < 0.003
    assert np.percentile(away, 90) < 0.008


def test_meshes_are_light_for_the_renderer_and_the_log():
    sizes = [
        len(trimesh.load_mesh(MODELS[name].look.mesh, process=False).faces) for name in drawings()
    ]
    assert max(sizes) < 800
    assert sum(file.stat().st_size for file in ASSETS.rglob("*.*")) < 3e6


def test_the_packaged_meshes_are_those_that_are_made_today(tmp_path: Path):
    make(["--out", str(tmp_path)])
    for name in drawings():
        for form in ("obj", "glb"):
            old, new = (
                trimesh.load_mesh(folder / name / f"textured.{form}", process=False)
                for folder in (ASSETS, tmp_path)
            )
            assert new.faces == pytest.approx(old.faces)
            assert new.vertices == pytest.approx(old.vertices, abs=2e-5)
            assert new.visual.uv == pytest.approx(old.visual.uv, abs=2e-5)
        old, new = (
            np.asarray(Image.open(folder / name / "textured.png"), dtype=float)
            for folder in (ASSETS, tmp_path)
        )
        assert np.abs(old - new).mean() < 2.0


# --- what the simulator and the log show ---


def test_the_log_shows_the_same_mesh_upright():
    for entity in home_entities(four_rooms(), MODELS):
        if entity.name in drawings():
            (shape,) = entity.shapes
            x, y, z = trimesh.load_scene(shape.mesh).to_mesh().extents
            assert (z, x, y) == pytest.approx(MODELS[entity.name].size, abs=1e-4)  # glTF: y is up


@pytest.mark.physics
@pytest.mark.parametrize(
    ("name", "print_"), [("sugar_box", (0, 0, 90)), ("cracker_box", (190, 140, 70))]
)
def test_the_camera_sees_the_print_of_a_box(name: str, print_: tuple[int, int, int]):
    seen = np.asarray(portrait(MODELS[name])).astype(int)
    assert (np.abs(seen - print_).max(axis=-1) < 50).mean() > 0.01


@pytest.mark.physics
def test_fruit_that_looks_alike_stays_alike():
    def hue(name: str) -> NDArray[np.float64]:
        pixels = np.asarray(portrait(MODELS[name])).astype(float)
        return np.median(pixels[80:160, 80:160].reshape(-1, 3), axis=0)

    assert np.abs(hue("orange") - hue("peach")).max() < 90
    assert np.abs(hue("apple") - hue("strawberry")).max() < 60


@pytest.mark.physics
def test_view_writes_a_contact_sheet_of_all_objects(tmp_path: Path):
    out = tmp_path / "sheet.png"
    assert main(["view", "objects", "--out", str(out)]) == 0
    sheet = np.asarray(Image.open(out))
    rows, columns = -(-len(MODELS) // 6), 6
    cells = [
        cell for row in np.array_split(sheet, rows) for cell in np.array_split(row, columns, 1)
    ]
    assert all(cell.std() > 10 for cell in cells[: len(MODELS)])


# --- YCB's models in their place ---


@pytest.mark.parametrize(
    ("folder", "tilt"),
    [
        ("003_cracker_box", (0, 0, 25)),
        ("025_mug", (0, 0, -130)),
        ("035_power_drill", (90, 0, 65)),
        ("048_hammer", (0, 0, 40)),
        ("070-a_colored_wood_blocks", (0, 0, 10)),
    ],
)
def test_a_scan_in_any_frame_is_put_where_the_object_is(
    tmp_path: Path, folder: str, tilt: tuple[float, float, float]
):
    turn = Rotation.from_euler("xyz", tilt, degrees=True)
    scan(tmp_path, folder, turn, (0.03, -0.05, 0.2))
    name = folder.split("_", 1)[1]
    look = with_scans(MODELS, tmp_path)[name].look
    assert look.mesh.startswith(str(tmp_path))
    found, ours = points_of(look), points_of(MODELS[name].look)
    assert found.min(axis=0) == pytest.approx(ours.min(axis=0), abs=2e-3)
    assert found.max(axis=0) == pytest.approx(ours.max(axis=0), abs=2e-3)
    if name in ("mug", "power_drill", "hammer"):
        assert np.abs(found - ours).max() < 5e-3


def test_a_box_is_not_turned_over_for_nothing(tmp_path: Path):
    look = aligned(MODELS["pudding_box"], scan(tmp_path, "008_pudding_box", _yaw(75), (0, 0, 0)))
    assert Rotation.from_quat(look.pose.orientation).apply((0, 0, 1))[2] == pytest.approx(1)


def test_what_the_folder_lacks_looks_as_ours(tmp_path: Path):
    scan(tmp_path, "013_apple", _yaw(0), (0, 0, 0))
    models = with_scans(MODELS, tmp_path)
    assert models["apple"].look != MODELS["apple"].look
    assert models["mug"] == MODELS["mug"]


def test_a_folder_without_any_known_model_is_bad_input(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    (tmp_path / "001_chips_can").mkdir()
    assert main(["view", "objects", "--ycb", str(tmp_path)]) == 2
    assert "013_apple" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        ("", "has no faces"),
        ("v 0 0 zero\nf 1 1 1\n", "no OBJ"),
        ("v 0 0 0\nv 1 0 0\nv 0 1\nf 1 2 3\n", "no OBJ"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "that it does not have"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\n", "enclose no volume"),
        ("v 0 0 nan\nv 1 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\n", "enclose no volume"),
    ],
)
def test_a_broken_mesh_is_named(tmp_path: Path, content: str, fault: str):
    path = tmp_path / "013_apple" / MESH
    path.parent.mkdir(parents=True)
    path.write_text(content)
    with pytest.raises(InputError, match=fault) as error:
        with_scans(MODELS, tmp_path)
    assert str(path) in str(error.value)


@pytest.mark.parametrize("lost", ["material.mtl", "textured.png"])
def test_a_scan_without_its_texture_is_named(tmp_path: Path, lost: str):
    path = scan(tmp_path, "013_apple", _yaw(0), (0, 0, 0))
    (path.parent / lost).unlink()
    with pytest.raises(InputError, match=lost):
        with_scans(MODELS, tmp_path)


def _yaw(degrees: float) -> Rotation:
    return Rotation.from_euler("z", degrees, degrees=True)
