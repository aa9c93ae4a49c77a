"""A page in the browser for the person who talks with the robot: `python -m executive --page`.

`page.Page` is what the door opens. Its `person` is the `User` of the missions, its `sink` one of
their logs; the tree knows nothing of either.
"""
