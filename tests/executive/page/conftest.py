"""One browser for all tests of the page, and a robot to each."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from browsing import chromium
from paging import Robot, robot
from playwright.sync_api import Browser


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    with chromium() as browser:
        yield browser


@pytest.fixture
def talking(tmp_path: Path) -> Iterator[Robot]:
    with robot(tmp_path, recorded=True) as made:
        yield made
