"""Every seam of the system. An adapter for a real robot, camera or model implements one of these.

All slow work has one shape: a method that starts it returns a request number at once, its end
comes as an `Ended` event with that number, and `cancel` calls it off. Only `Clock.wait` blocks.
"""
