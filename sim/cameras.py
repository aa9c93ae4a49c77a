"""The robot's cameras in the physics world, for perception and for the log."""

from functools import partial
from itertools import count

import numpy as np
from scipy.spatial.transform import Rotation

from executive.geometry import Floats
from executive.interfaces.perception import Camera
from sim.body.hardware import Hardware
from sim.bullet.camera import GLANCING, LOOKING, SimulatedCamera
from sim.engine import BulletClient
from sim.faults.injector import FaultInjector, FaultyCamera
from sim.pictures.beside import Beside, CameraBeside


class Cameras:
    """All cameras share the optical frame in the robot's head, and number their pictures together.

    Attributes:
        drawn: the camera for recognising objects; the simulated detector reads the segmentation of
            its pictures.
        looking: the same camera with injected faults.
        eyes: the same as `looking`, for users of colour and depth only; another process draws for
            it if there is one.
        filming: the camera for the log, with fewer pixels; another process draws for it if there
            is one.
    """

    def __init__(
        self,
        client: BulletClient,
        hardware: Hardware,
        injector: FaultInjector | None,
        beside: Beside | None,
    ) -> None:
        """Make the cameras.

        Args:
            client: the world.
            hardware: the robot that carries the cameras.
            injector: spoils pictures with faults; None for no faults.
            beside: the other process that draws pictures; None to draw all of them here.
        """
        pose, numbers = partial(hardware.link_pose, "camera_optical"), count()
        self.drawn = SimulatedCamera(client, pose, LOOKING, numbers)
        glancing = SimulatedCamera(client, pose, GLANCING, numbers)
        self.looking: Camera = FaultyCamera(self.drawn, injector) if injector else self.drawn
        self._glancing: Camera = FaultyCamera(glancing, injector) if injector else glancing
        self.eyes: Camera = self.looking
        self.filming: Camera = self._glancing
        if beside:
            self.eyes = CameraBeside(self.drawn, beside, awaited=True)
            self.filming = CameraBeside(glancing, beside)

    def scan(self) -> Floats:
        """The points (n, 3) that the depth camera sees now (metres, in `map`)."""
        frame = self._glancing.capture()
        lens, depth = frame.intrinsics, frame.depth.astype(np.float64)
        rows, columns = np.nonzero(np.isfinite(depth))
        far = depth[rows, columns]
        ahead = np.column_stack(
            ((columns - lens.cx) / lens.fx * far, (rows - lens.cy) / lens.fy * far, far)
        )
        return Rotation.from_quat(frame.pose.orientation).apply(ahead) + frame.pose.position
