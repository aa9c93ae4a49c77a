"""All that missions import, whatever their settings: a worker that is forked off has it already.

What cannot be imported here is told by the mission that needs it.
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

atexit.register(os._exit, 0)  # some libraries complain of what the end of Python finds
