"""What looks through the robot's eyes in the physics world, for the robot and for the log."""

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
    """All cameras look from the robot's head, and count their pictures together.

    Attributes:
        drawn: the camera that things are recognised with; a stand-in for a detector reads the
            segmentation of its pictures.
        looking: the same, with what goes wrong by order.
        eyes: the same, for who needs no more than the picture: it need not be drawn here.
        filming: for the log: with larger pixels, and not drawn here either, where that can be.
    """

    def __init__(
        self,
        client: BulletClient,
        hardware: Hardware,
        injector: FaultInjector | None,
        beside: Beside | None,
    ) -> None:
        """Look at the world of `client`; `injector` spoils pictures, `beside` draws them."""
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
        """Points in `map` (n, 3) that the depth camera sees now."""
        frame = self._glancing.capture()
        lens, depth = frame.intrinsics, frame.depth.astype(np.float64)
        rows, columns = np.nonzero(np.isfinite(depth))
        far = depth[rows, columns]
        ahead = np.column_stack(
            ((columns - lens.cx) / lens.fx * far, (rows - lens.cy) / lens.fy * far, far)
        )
        return Rotation.from_quat(frame.pose.orientation).apply(ahead) + frame.pose.position
