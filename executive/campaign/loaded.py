"""All that missions import, whatever their settings: a worker that is forked off has it already.

What cannot be imported here is told by the mission that needs it.
"""

import atexit
import os
from contextlib import suppress

from executive.shell import all_is_kept

with all_is_kept(), suppress(Exception):
    import executive.campaign.blocks  # noqa: F401
    import executive.campaign.weeks.household  # noqa: F401
    import kb.llm.llama  # noqa: F401
    import kb.llm.loaded  # noqa: F401
    import sim.manipulation.rrt  # noqa: F401
    import sim.world  # noqa: F401

atexit.register(os._exit, 0)  # some libraries complain of what the end of Python finds
