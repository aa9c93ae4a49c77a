"""Where the page is served is said in a sentence if it cannot be."""

import argparse
import logging
import socket
from contextlib import closing
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from executive.errors import InputError
from executive.page.address import EXAMPLES, Address, add_page, address_of
from executive.page.serving import Server


def options(*words: str) -> Address | None:
    parser = argparse.ArgumentParser()
    add_page(parser)
    return address_of(vars(parser.parse_args(words)))


def test_no_page_is_served_unless_it_is_asked_for() -> None:
    assert options() is None


@pytest.mark.parametrize(
    "words", [["--page-experimenter"], ["--page-address", "::"], ["--page-key", "x"]]
)
def test_what_is_said_of_a_page_that_is_not_served_is_told(words: list[str]) -> None:
    with pytest.raises(InputError, match=f"{words[0]}: no page .*; give --page, too"):
        options(*words)


def test_it_is_served_to_this_machine_alone_unless_told_otherwise() -> None:
    assert options("--page") == Address(8080, "127.0.0.1")
    assert options("--page", "9000", "--page-address", "0.0.0.0") == Address(9000, "0.0.0.0")


@pytest.mark.parametrize("port", ["Bring the mug", "65536", "-1", "٣"])
def test_what_is_no_port_is_refused(port: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        options("--page", port)
    assert "--page" in capsys.readouterr().err


def test_a_port_that_is_taken_is_told_with_what_to_do() -> None:
    taken = Server(Address(0))
    with pytest.raises(InputError, match=f"127.0.0.1:{taken.port} cannot be had: .* --page 8081"):
        Server(Address(taken.port))
    taken.close()


def test_an_address_of_no_machine_is_told() -> None:
    with pytest.raises(InputError, match="192.0.2.1:0 cannot be had"):
        Server(Address(0, "192.0.2.1"))


def test_other_devices_without_encryption_are_warned_of(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING):
        Address(0, "0.0.0.0").checked()
        Address(0, "localhost").checked()
    assert [record.message for record in caplog.records] == [
        "the page is open to the network, unencrypted: give --page-cert and --page-key"
    ]


def test_what_is_opened_is_an_address_of_this_machine_that_a_phone_can_open() -> None:
    host = urlsplit(Address(8080, "0.0.0.0").url(8080, "x")).hostname
    with socket.socket() as ours:
        ours.bind((host, 0))
        name, _ = ours.getsockname()
    with socket.socket(type=socket.SOCK_DGRAM) as way:
        if way.connect_ex((EXAMPLES["0.0.0.0"], 9)):
            return  # in no network there is none
        assert way.getsockname()[0] == name != "0.0.0.0"


def test_a_certificate_that_is_none_is_told(tmp_path: Path) -> None:
    text = tmp_path / "cert.pem"
    text.write_text("no certificate")
    told = ((text, "no PEM"), (tmp_path / "none.pem", "No such file"), (tmp_path, "Is a directory"))
    for certificate, why in told:
        with pytest.raises(InputError, match=f"--page-cert: cannot be used: .*{why}"):
            Address(0, certificate=certificate).checked()


def test_a_key_without_a_certificate_is_told(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="give --page-cert, too"):
        Address(0, key=tmp_path / "key.pem").checked()


def test_what_is_answered_in_two_parts_does_not_wait_for_a_receipt() -> None:
    server = Server(Address(port=0))
    with closing(server), socket.create_connection(("127.0.0.1", server.port)):
        accepted, _ = server._socket.accept()
        with accepted:  # by this, asyncio sets TCP_NODELAY
            assert accepted.proto == socket.IPPROTO_TCP
