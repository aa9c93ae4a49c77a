"""Options of `python -m sim serve`, and their defaults."""

PORT = 9090
"""The default port of rosbridge."""
FASTEST = 50.0
"""Default of the highest ratio of simulated time to real time."""
SKILLS, MOVEIT = "skills", "moveit"
"""What the arm offers: actions to pick up and put down, or the motions of MoveIt 2."""
