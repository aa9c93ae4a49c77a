"""Scans of strangers: nothing outside their folder is opened, and no size is taken on trust."""

import shutil
from pathlib import Path

import pytest
from PIL import Image
from scans import MODELS, scan
from scipy.spatial.transform import Rotation

from executive.errors import InputError
from sim.objects import meshes
from sim.objects.ycb import with_scans


@pytest.fixture
def mesh(tmp_path: Path) -> Path:
    return scan(tmp_path / "scans", "013_apple", Rotation.identity(), (0, 0, 0))


def refused(mesh: Path, sentence: str) -> None:
    with pytest.raises(InputError, match=sentence):
        with_scans(MODELS, mesh.parents[2])


@pytest.mark.parametrize("line", ["mtllib ../far.mtl", "mtllib\t{far}", "mtllib sub/far.mtl"])
def test_a_material_elsewhere_is_refused(mesh: Path, tmp_path: Path, line: str) -> None:
    far = tmp_path / "far.mtl"
    far.write_text("newmtl a\n")
    mesh.write_text(f"{line.format(far=far)}\n{mesh.read_text()}")
    refused(mesh, "names a file that is elsewhere: .*far.mtl; put it into the same folder")


@pytest.mark.parametrize("key", ["map_Kd", "map_Bump", "map_Ks"])
def test_a_texture_elsewhere_is_refused(mesh: Path, tmp_path: Path, key: str) -> None:
    shutil.copy(next(mesh.parent.glob("*.png")), tmp_path / "far.png")
    material = mesh.parent / "material.mtl"
    material.write_text(f"{material.read_text()}\n{key} {tmp_path / 'far.png'}\n")
    refused(mesh, "names a file that is elsewhere")


def test_a_link_to_a_file_elsewhere_is_refused(mesh: Path, tmp_path: Path) -> None:
    material = mesh.parent / "material.mtl"
    material.rename(tmp_path / "far.mtl")
    material.symlink_to(tmp_path / "far.mtl")
    refused(mesh, "names a file that is elsewhere")


def test_a_texture_that_is_no_picture_or_too_large_is_refused(
    mesh: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    texture = next(mesh.parent.glob("*.png"))
    Image.new("1", (40, 2)).save(texture)
    monkeypatch.setattr(meshes, "LARGEST_PICTURE", 39)
    refused(mesh, "is 40 pixels long; give up to 39")
    texture.write_bytes(b"\x89PNG")
    refused(mesh, "is not a picture")


def test_a_mesh_of_absurd_size_is_refused(mesh: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    mesh.write_text(f"o {'a' * 5000}\n{mesh.read_text()}")
    refused(mesh, "has a line of more than 1000 characters")
    monkeypatch.setattr(meshes, "MOST_BYTES", 1 << 10)
    refused(mesh, "is larger than 1 kB")
