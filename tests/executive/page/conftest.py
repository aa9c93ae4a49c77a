"""A browser for the tests of a file, and a robot to each.

The browser is driven by an event loop in the thread of the tests: it has to end with the file, so
that other tests may run a loop of their own.
"""

from collections.abc import Iterator
from pathlib import Path

import pytest
from browsing import chromium
from paging import Robot, robot
from playwright.sync_api import Browser


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with chromium() as browser:
        yield browser


@pytest.fixture
def talking(tmp_path: Path) -> Iterator[Robot]:
    with robot(tmp_path, recorded=True) as made:
        yield made
