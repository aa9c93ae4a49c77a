"""The nouns of the executive: immutable values with their units and frames.

Frames follow REP-103 and REP-105: metres, radians, x forward, y left, z up; `map` is fixed to the
home, `base_link` to the robot, `camera_optical` to the camera (x right, y down, z forward).
Quaternions are (x, y, z, w).
"""
