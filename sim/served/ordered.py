"""What is served unless the command says otherwise."""

PORT = 9090
"""Rosbridge's own."""
FASTEST = 50.0
"""So many seconds pass in a real one at most."""
SKILLS, MOVEIT = "skills", "moveit"
"""What the arm offers: to pick up and to put down, or motions as MoveIt 2 has them."""
