from pathlib import Path

import numpy as np
import trimesh
from scipy.spatial.transform import Rotation

from sim.objects.objects import load_objects
from sim.objects.ycb import MESH

MODELS = load_objects()


def scan(folder: Path, name: str, turn: Rotation, shift: tuple[float, float, float]) -> Path:
    """Our mesh of an object in the layout of YCB, in a frame of its own."""
    mesh = trimesh.load_mesh(MODELS[name.split("_", 1)[1]].look.mesh, process=False)
    mesh.apply_transform(np.block([[turn.as_matrix(), np.zeros((3, 1))], [np.zeros(3), 1.0]]))
    mesh.apply_translation(shift)
    path = folder / name / MESH
    path.parent.mkdir(parents=True)
    mesh.export(path)
    return path
