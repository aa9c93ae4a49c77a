"""Reads from a recording what it keeps about the robot's body."""

from collections.abc import Mapping

from pydantic import BaseModel, ValidationError

from executive.app.recording import places_viewed
from executive.config import Settings
from executive.errors import InputError
from executive.types.home import FLOOR
from logs.recording.reader import Run
from sim.home.home import FLOOR_VIEWS, Home


class Body(BaseModel):
    """The properties of the body that the tree depends on.

    Attributes:
        in_map: whether detections have positions in `map`.
        views: number of head poses for each place that needs more than one.
        blind_to: objects that perception would not recognise.
        has_arm: whether the robot can take things.
    """

    in_map: bool
    views: Mapping[str, int]
    blind_to: tuple[str, ...] = ()
    has_arm: bool = True


def recorded_body(run: Run, settings: Settings, home: Home) -> Body:
    """Read the body as `executive.app.recording` has written it.

    Raises:
        InputError: if it is malformed.
    """
    kept = run.attachments.get("body.json")
    if kept is None:
        return _early_body(settings, home)
    try:
        return Body.model_validate_json(kept)
    except ValidationError as error:
        what = f"its body.json is not understood: {error.errors()[0]['msg']}"
        raise InputError(str(run.path), what) from error


def _early_body(settings: Settings, home: Home) -> Body:
    """The body of early recordings: there were only those of the instant world and of PyBullet."""
    if settings.world != "physics":
        return Body(in_map=False, views={})
    views = {place: len(home.view_targets(place)) for place in places_viewed(home)[:-1]}
    return Body(in_map=True, views={**views, FLOOR: FLOOR_VIEWS})
