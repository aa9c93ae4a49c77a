"""The face of the library: `from executive import ...` has what users need, and costs nothing."""

import ast
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

import executive

PACKAGES = Path(executive.__file__).parents[1]
FACES = ("executive", "executive.types", "executive.interfaces")
HEAVY = ("pybullet", "llama_cpp", "rerun", "cv2", "numpy", "pydantic", "owlready2", "py_trees")


def loaded(statement: str, modules: tuple[str, ...]) -> str:
    """Which of the modules a fresh Python has loaded after the statement."""
    show = f"{statement}; import sys; print([m for m in {modules} if m in sys.modules])"
    shown = subprocess.run([sys.executable, "-c", show], capture_output=True, text=True, check=True)
    return shown.stdout.strip()


def test_every_name_of_the_face_is_there():
    for name in executive.__all__:
        assert getattr(executive, name) is not None


def test_the_names_are_sorted_and_editors_see_the_same():
    constants = [n for n in executive.__all__ if n.isupper()]
    rest = executive.__all__[len(constants) :]
    assert executive.__all__ == sorted(constants) + sorted(rest)
    assert set(executive.__all__) <= set(dir(executive))
    source = ast.parse(Path(executive.__file__).read_text())
    (seen_by_types,) = (node for node in source.body if isinstance(node, ast.If))
    imported = [
        a.name for s in ast.walk(seen_by_types) if isinstance(s, ast.ImportFrom) for a in s.names
    ]
    assert sorted(imported) == sorted(executive.__all__)


def test_the_table_of_contents_names_everything():
    contents = executive.__doc__ or ""
    assert [name for name in executive.__all__ if name not in contents] == []


@pytest.mark.parametrize("package", ["executive.types", "executive.interfaces"])
def test_a_package_has_what_its_modules_define(package):
    face = import_module(package)
    for file in sorted(Path(face.__path__[0]).glob("[!_]*.py")):
        module = import_module(f"{package}.{file.stem}")
        own = [n.name for n in ast.parse(file.read_text()).body if isinstance(n, ast.ClassDef)]
        for name in own:
            assert getattr(face, name) is getattr(module, name)
            assert name in face.__all__


def test_importing_it_loads_nothing_heavy():
    assert loaded("import executive", HEAVY) == "[]"


def test_protocols_and_errors_come_without_simulator_or_model():
    names = "Robot, Inbox, InputError, Outcome, load_settings"
    heavy = ("pybullet", "llama_cpp", "rerun", "owlready2")
    assert loaded(f"from executive import {names}", heavy) == "[]"


def test_what_help_needs_comes_without_numpy():
    assert loaded("import executive.__main__", ("numpy", "cv2", "pybullet")) == "[]"


def test_a_session_without_a_model_imports_no_library_of_one():
    assert loaded("import executive.app.session", ("llama_cpp", "httpx2", "jinja2")) == "[]"


def test_replay_is_a_function_of_its_own_package():
    from executive.replay import replay

    assert callable(replay)
    assert "replay" not in executive.__all__


def test_a_name_that_is_not_there_is_an_attribute_error():
    with pytest.raises(AttributeError, match="'executive' has no attribute 'Robott'"):
        executive.Robott  # noqa: B018


def test_the_house_itself_does_not_go_through_its_faces():
    """Else what a room needs would no longer be seen in its imports."""
    inside = [
        f for p in ("executive", "trees", "kb", "sim", "logs") for f in (PACKAGES / p).rglob("*.py")
    ]
    through = [
        str(file.relative_to(PACKAGES))
        for file in inside
        for node in ast.walk(ast.parse(file.read_text()))
        if isinstance(node, ast.ImportFrom)
        and node.module in FACES
        and any(alias.name in import_module(node.module).__all__ for alias in node.names)
    ]
    assert through == []


@pytest.mark.parametrize(
    "door",
    [
        *("executive.__main__", "executive.campaign.__main__", "kb.__main__", "logs.__main__"),
        *("kb.benchmark.__main__", "sim.__main__", "trees.__main__"),
    ],
)
def test_no_door_loads_what_its_help_does_not_need(door: str) -> None:
    heavy = ("numpy", "scipy", "mcap", "rdflib", "py_trees", "lark", "executive.types")
    assert loaded(f"import {door}", heavy) == "[]"
