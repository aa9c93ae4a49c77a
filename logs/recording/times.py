"""The one time base of a log: run start + mission time."""

from datetime import datetime


def nanoseconds(time: datetime) -> int:
    """Nanoseconds since 1970, exact to the microsecond."""
    return round(time.timestamp() * 1e6) * 1000
