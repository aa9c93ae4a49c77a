"""What a recording keeps of the body that its mission was run with."""

from collections.abc import Mapping

from pydantic import BaseModel, ValidationError

from executive.app.recording import places_viewed
from executive.config import Settings
from executive.errors import InputError
from executive.types.home import FLOOR
from logs.recording.reader import Run
from sim.home.home import FLOOR_VIEWS, Home


class Body(BaseModel):
    """Whether things have positions in `map`; which places take more than one view.

    `blind_to` are objects that it would not recognise.
    """

    in_map: bool
    views: Mapping[str, int]
    blind_to: tuple[str, ...] = ()
    has_arm: bool = True


def recorded_body(run: Run, settings: Settings, home: Home) -> Body:
    """As `executive.app.recording` has written it down.

    Raises:
        InputError: if that cannot be read.
    """
    kept = run.attachments.get("body.json")
    if kept is None:
        return _of_old(settings, home)
    try:
        return Body.model_validate_json(kept)
    except ValidationError as error:
        what = f"its body.json is not understood: {error.errors()[0]['msg']}"
        raise InputError(str(run.path), what) from error


def _of_old(settings: Settings, home: Home) -> Body:
    """Of the days in which nothing was kept of it, and there were only these two."""
    if settings.world != "physics":
        return Body(in_map=False, views={})
    views = {place: len(home.view_targets(place)) for place in places_viewed(home)[:-1]}
    return Body(in_map=True, views={**views, FLOOR: FLOOR_VIEWS})
