"""What is served unless the command says otherwise."""

PORT = 9090
"""Rosbridge's own."""
FASTEST = 50.0
"""So many seconds pass in a real one at most."""
