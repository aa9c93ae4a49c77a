"""Imports all that missions need, so that a forked worker process has it already.

An import that fails here is reported by the mission that needs it.
"""

import atexit
import os
from contextlib import suppress

from executive.shell import all_is_kept

with all_is_kept(), suppress(Exception):
    import executive.campaign.blocks
    import executive.campaign.weeks.household
    import kb.llm.llama
    import kb.llm.loaded
    import sim.manipulation.rrt
    import sim.world

atexit.register(os._exit, 0)  # some libraries print errors when the interpreter shuts down
