"""Joins parts to one mesh with one texture, at the size in objects.toml, and writes its files."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import trimesh
from PIL import Image
from trimesh.exchange.gltf import export_glb
from trimesh.exchange.obj import export_obj
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial, SimpleMaterial

from executive.geometry import Floats
from sim.modelling.parts import Part
from sim.objects.objects import ObjectModel

_GLTF_FROM_OURS = np.array([[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [0, 0, 0, 1]], dtype=float)
"""glTF 2.0 has y up and looks along z; ours has z up and x to the front."""


def assemble(parts: Sequence[Part], model: ObjectModel) -> trimesh.Trimesh:
    """One textured mesh of parts that fills the bounding box of the object exactly."""
    texture, uv = _atlas(parts)
    starts = np.cumsum([0, *(len(part.points) for part in parts)])
    faces = [part.faces + start for part, start in zip(parts, starts, strict=False)]
    points, normals = _fitted(parts, model)
    return trimesh.Trimesh(
        points,
        np.concatenate(faces),
        vertex_normals=normals,
        visual=TextureVisuals(uv, SimpleMaterial(texture, diffuse=(255, 255, 255, 255))),
        process=False,
    )


def write(mesh: trimesh.Trimesh, folder: Path) -> None:
    """Write `textured.obj` with its material and texture, and the same as `textured.glb`."""
    folder.mkdir(parents=True, exist_ok=True)
    mesh.visual.material.name = "textured"
    text, others = export_obj(
        mesh,
        include_normals=True,
        return_texture=True,
        mtl_name="textured.mtl",
        header="",
        digits=5,
    )
    (folder / "textured.obj").write_text(text + "\n", encoding="utf-8")
    for name, content in others.items():
        (folder / name).write_bytes(content)
    image = mesh.visual.material.image
    image.save(folder / "textured.png", optimize=True)
    turned = mesh.copy()
    turned.apply_transform(_GLTF_FROM_OURS)
    material = PBRMaterial(baseColorTexture=image, metallicFactor=0.0, roughnessFactor=0.7)
    turned.visual = TextureVisuals(mesh.visual.uv, material)
    (folder / "textured.glb").write_bytes(export_glb(trimesh.Scene(turned), include_normals=True))


def _fitted(parts: Sequence[Part], model: ObjectModel) -> tuple[Floats, Floats]:
    points = np.concatenate([part.points for part in parts])
    used = np.concatenate([part.points[np.unique(part.faces)] for part in parts])
    low, high = used.min(axis=0), used.max(axis=0)
    lower, upper = np.array(model.lower), np.array(model.upper)
    scale = (upper - lower) / (high - low)
    normals = np.concatenate([_normals(part) for part in parts]) / scale
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return (points - low) * scale + lower, normals


def _normals(part: Part) -> Floats:
    """Vertex normals: smooth within a part, also where points coincide; sharp between parts."""
    _, same = np.unique(part.points.round(7), axis=0, return_inverse=True)
    corners = part.points[part.faces]
    facing = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sums = np.zeros((same.max() + 1, 3))
    for corner in range(3):
        np.add.at(sums, same[part.faces[:, corner]], facing)
    sums[~sums.any(axis=1)] = (0.0, 0.0, 1.0)
    return np.asarray(sums / np.linalg.norm(sums, axis=1, keepdims=True))[same]


def _atlas(parts: Sequence[Part]) -> tuple[Image.Image, Floats]:
    """A texture atlas of all skins, and the texture coordinates of all points of each part."""
    skins = list({id(part.skin): part.skin for part in parts}.values())
    skins.sort(key=lambda skin: skin.height, reverse=True)
    area = sum(skin.width * skin.height for skin in skins)
    width = max(round(1.1 * area**0.5), *(skin.width for skin in skins), 1)
    corners, left, top, row = {}, 0, 0, 0
    for skin in skins:
        if left + skin.width > width:
            left, top, row = 0, top + row, 0
        corners[id(skin)] = (left, top)
        left, row = left + skin.width, max(row, skin.height)
    atlas = Image.new("RGB", (width, top + row))
    for skin in skins:
        atlas.paste(skin, corners[id(skin)])
    return atlas, np.concatenate([_placed(part, corners[id(part.skin)], atlas) for part in parts])


def _placed(part: Part, corner: tuple[int, int], atlas: Image.Image) -> Floats:
    """Texture coordinates, half a pixel inside the skin, so that its neighbours do not bleed in."""
    size = np.array(part.skin.size)
    across = (
        np.array(corner) + 0.5 + np.column_stack((part.uv[:, 0], 1 - part.uv[:, 1])) * (size - 1)
    )
    return np.asarray(np.column_stack((across[:, 0], atlas.height - across[:, 1])) / atlas.size)
