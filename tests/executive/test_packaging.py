"""What an installation brings, as pyproject.toml has it."""

import tomllib
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
PACKAGES = PYPROJECT["tool"]["mypy"]["packages"]
HELPERS = ("requests",)
SUITES = sorted(
    file.stem
    for file in (ROOT / "executive/testing/contracts").glob("[a-z]*.py")
    if file.stem not in HELPERS
)


@pytest.mark.parametrize("package", PACKAGES)
def test_every_package_says_that_it_is_typed(package: str) -> None:
    assert "py.typed" in PYPROJECT["tool"]["setuptools"]["package-data"][package]
    assert (ROOT / package / "py.typed").exists()


@pytest.mark.parametrize("suite", SUITES)
def test_every_suite_says_what_it_needs_and_promises_something(suite: str) -> None:
    module = import_module(f"executive.testing.contracts.{suite}")
    [contract] = [value for name, value in vars(module).items() if name.endswith("Contract")]
    assert contract.__name__ in module.__doc__
    assert [name for name in vars(contract) if name.startswith("test_")]
