"""A robot behind TLS is driven like any other; a door that is not trusted is not gone through."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from second_robot import PROFILE, SecondRobot
from tls import certificate, tls_before

from executive.ros.__main__ import main
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
    assert "SSL_CERT_FILE" in said


def test_a_robot_without_tls_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    with SecondRobot(four_rooms().robot_start) as robot:
        door = robot.url.replace("ws:", "wss:")
        assert main(["check", door, "--profile", str(PROFILE)]) == 2
    assert "does it speak TLS?" in capsys.readouterr().err
