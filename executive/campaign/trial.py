"""Whether policies are any: found out at once, and not when it is their turn after hours."""

import io
from collections.abc import Mapping

from executive.app.session import Session
from executive.campaign.policies import POLICIES, policy_named
from executive.config import Settings


def try_policies(used: Mapping[str, Settings]) -> None:
    """Have each policy of somebody's own make parts once, before missions go by it for hours.

    Args:
        used: by the name of each policy, settings that it will be called with.

    Raises:
        ExecutiveError: if one cannot be imported or fails, or the settings are wrong.
    """
    for name, settings in used.items():
        if name not in POLICIES:
            Session(settings, out=io.StringIO(), recorded=False, change=policy_named(name)).close()
