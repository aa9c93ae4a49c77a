"""Tries policies out at the start of a campaign, and not when it is their turn after hours."""

import io
from collections.abc import Mapping

from executive.app.session import Session
from executive.campaign.policies import POLICIES, policy_named
from executive.config import Settings


def try_policies(used: Mapping[str, Settings]) -> None:
    """Let each policy of a user's own make parts once.

    Args:
        used: for the name of each policy, settings to call it with.

    Raises:
        ExecutiveError: if a policy cannot be imported or fails, or the settings are wrong.
    """
    for name, settings in used.items():
        if name not in POLICIES:
            Session(settings, out=io.StringIO(), recorded=False, change=policy_named(name)).close()
