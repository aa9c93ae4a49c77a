"""A robot behind TLS is driven like any other; a door that is not trusted is not gone through."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from second_robot import PROFILE, SecondRobot
from tls import certificate, tls_before

from executive.ros.__main__ import main
from executive.ros.address import HEADERS
from executive.testing.bench import four_rooms


@pytest.fixture(scope="module")
def cert(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return certificate(tmp_path_factory.mktemp("tls"))


@pytest.fixture
def door(cert: Path) -> Iterator[str]:
    with SecondRobot(four_rooms().robot_start) as robot, tls_before(robot.url, cert) as url:
        yield url


def test_a_profile_is_held_against_a_robot_behind_tls(
    door: str, cert: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("SSL_CERT_FILE", str(cert))
    assert main(["check", door, "--profile", str(PROFILE)]) == 0
    assert "fits the robot" in capsys.readouterr().out


def test_a_certificate_that_nobody_signed_is_told(
    door: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", door, "--profile", str(PROFILE)]) == 2
    said = capsys.readouterr().err
    assert "its certificate is not trusted" in said
    assert "if it should be, the environment variable SSL_CERT_FILE names its file" in said


def test_a_certificate_of_another_host_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    cert = certificate(tmp_path, of="DNS:robot.lab")
    monkeypatch.setenv("SSL_CERT_FILE", str(cert))
    with SecondRobot() as robot, tls_before(robot.url, cert) as door:
        assert main(["check", door, "--profile", str(PROFILE)]) == 2
    said = capsys.readouterr().err
    assert "certificate is not valid for '127.0.0.1'); see" in said


def test_a_robot_without_tls_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    with SecondRobot(four_rooms().robot_start) as robot:
        door = robot.url.replace("ws:", "wss:")
        assert main(["check", door, "--profile", str(PROFILE)]) == 2
    assert "does it speak TLS?" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        (401, "it was not let in (HTTP 401): what the door asks for goes into EXECUTIVE_ROBOT_"),
        (404, "there is no websocket at this address (HTTP 404)"),
        (502, "the door is there, but the robot behind it is not (HTTP 502)"),
    ],
)
def test_why_a_door_is_shut_is_told(
    answer: int, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with SecondRobot() as robot:
        robot.shut = answer
        assert main(["check", robot.url, "--profile", str(PROFILE)]) == 2
    assert said in capsys.readouterr().err


def test_a_key_goes_to_nobody_to_whom_the_door_sends(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv(HEADERS, '{"Api-Key": "secret"}')
    with SecondRobot() as robot, SecondRobot() as other:
        robot.sends_to = f"{other.url}/?key=secret"
        assert main(["check", robot.url, "--profile", str(PROFILE)]) == 2
        assert not other.headers
        assert f"it sends to {other.url}/; give that address" in capsys.readouterr().err


def test_a_door_with_tls_that_is_taken_for_one_without_is_told(
    door: str, capsys: pytest.CaptureFixture[str]
) -> None:
    without = door.replace("wss:", "ws:")
    assert main(["check", without, "--profile", str(PROFILE)]) == 2
    assert "wss:// with" in capsys.readouterr().err
