"""A wire of small bandwidth makes pictures late; it is no loss, and no stop waits for it."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from linking import link_to
from patience import until
from served import served
from thin_wire import ThinWire

from executive.events import Inbox
from executive.ros import peer
from executive.ros.connection import Connection
from executive.ros.profile import profile_text
from executive.testing.contracts.requests import end_of
from executive.types.goals import Halt
from executive.types.results import Succeeded

PICTURE_BYTES = 160 * 120 * (3 + 4)
SILENT_S = 0.5


@pytest.fixture
def inbox() -> Inbox:
    return Inbox()


@pytest.fixture
def wire() -> Iterator[ThinWire]:
    """A picture takes four times as long as silence may."""
    with served() as there, ThinWire(there.server.address, PICTURE_BYTES / 4 / SILENT_S) as wire:
        yield wire


@pytest.fixture
def here(
    wire: ThinWire, inbox: Inbox, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Connection]:
    monkeypatch.setattr(peer, "PING_S", SILENT_S / 5)
    monkeypatch.setattr(peer, "SILENT_S", SILENT_S)
    text = profile_text("served_instant")[0].decode()
    patient = tmp_path / "patient.toml"
    patient.write_text(text.replace("[camera]", "[camera]\nlate_s = 60"))
    with link_to(wire.url, inbox, patient) as here:
        yield here


def test_a_picture_on_its_way_is_a_sign_of_life(here: Connection) -> None:
    assert here.camera.capture().color.any()
    assert not here.line.link.losses


def test_a_stop_does_not_wait_for_a_picture(here: Connection, inbox: Inbox) -> None:
    with ThreadPoolExecutor() as beside:
        picture = beside.submit(here.camera.capture)
        assert end_of(inbox, here.robot.start(Halt())) == Succeeded()
        assert not picture.done()


def test_who_does_not_say_anything_any_more_is_lost(here: Connection, wire: ThinWire) -> None:
    wire.bytes_per_s = 0
    until(lambda: here.line.link.loss, "the loss")
