"""The file of facts may be anybody's: nothing in it runs, and what is wrong with it is said."""

import os
import sqlite3
import subprocess
import sys
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from executive.errors import InputError
from executive.testing.bench import run_mission
from executive.types.outcome import MissionStatus
from kb.__main__ import main
from kb.facts import FactStore
from kb.facts_file import APPLICATION_ID

MADE_BY_EACH = 5
MAKE = """
import sys
from pathlib import Path
from kb.facts import FactStore
print("ready", flush=True)
sys.stdin.readline()
store = FactStore(Path(sys.argv[1]))
for number in range(5):
    store.saw([f"thing_{sys.argv[2]}_{number}"], "desk")
store.close()
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """A memory in which the mug is on the desk."""
    path = tmp_path / "facts.sqlite"
    store = FactStore(path)
    store.saw(["mug"], "desk")
    store.close()
    return path


def change(file: Path, *statements: str) -> None:
    with closing(sqlite3.connect(file)) as database, database:
        for statement in statements:
            database.execute(statement)


def test_four_processes_make_one_memory_at_a_time(tmp_path: Path) -> None:
    file = tmp_path / "facts.sqlite"
    makers = [
        subprocess.Popen(
            [sys.executable, "-c", MAKE, str(file), str(number)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        for number in range(4)
    ]
    for maker in makers:
        assert maker.stdout
        maker.stdout.readline()
    for maker in makers:
        assert maker.stdin
        maker.stdin.write(b"go\n")
        maker.stdin.flush()
    assert [maker.communicate()[1] for maker in makers] == [b""] * 4
    store = FactStore(file)
    assert len(store.all()) == 4 * MADE_BY_EACH
    store.close()


OTHERS: dict[str, tuple[str, ...]] = {
    "a trigger": ("CREATE TRIGGER t AFTER INSERT ON fact BEGIN DELETE FROM fact; END",),
    "a view": ("CREATE VIEW v AS SELECT * FROM fact",),
    "a view in place of the table": (
        "DROP TABLE fact",
        "CREATE VIEW fact AS SELECT 1 number, 1.0 time_s, 'seen' kind, 'mug' object, 'x' place",
    ),
    "a virtual table": ("CREATE VIRTUAL TABLE f USING fts5(text)",),
    "a column that is computed": (
        "ALTER TABLE belief ADD COLUMN much AS (hex(zeroblob(100000000)))",
    ),
    "another trigger of our name": (
        "DROP TRIGGER is_nowhere",
        "CREATE TRIGGER is_nowhere AFTER INSERT ON fact BEGIN SELECT load_extension('x'); END",
    ),
    "no index": ("DROP INDEX belief_newest",),
    "another's mark": ("PRAGMA application_id = 7",),
}


@pytest.mark.parametrize("statements", OTHERS.values(), ids=OTHERS)
def test_a_memory_with_anything_else_in_it_is_not_opened(
    file: Path, statements: tuple[str, ...]
) -> None:
    change(file, *statements)
    with pytest.raises(InputError, match="it is a database of something else; name a file"):
        FactStore(file)


def test_anothers_database_with_our_mark_is_not_opened(tmp_path: Path) -> None:
    file = tmp_path / "other"
    change(file, "CREATE TABLE fact (diary)", f"PRAGMA application_id = {APPLICATION_ID}")
    with pytest.raises(InputError, match="of something else"):
        FactStore(file)


@pytest.mark.parametrize(
    "make",
    [os.mkfifo, Path.mkdir, lambda path: path.symlink_to("/dev/zero")],
    ids=["pipe", "folder", "device"],
)
def test_what_is_no_file_is_no_memory(tmp_path: Path, make: Callable[[Path], object]) -> None:
    make(tmp_path / "x")
    with pytest.raises(InputError, match="is no memory"):
        FactStore(tmp_path / "x")


def test_a_memory_in_a_folder_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="name a file in a folder that is there"):
        FactStore(tmp_path / "none" / "facts.sqlite")


def test_a_damaged_memory_is_refused(file: Path) -> None:
    data = bytearray(file.read_bytes())
    data[4096 + 8 : 4096 * 3] = os.urandom(4096 * 2 - 8)
    file.write_bytes(data)
    with pytest.raises(InputError, match="is no memory: "):
        FactStore(file)


def test_a_memory_that_can_only_be_read_is_refused_unless_it_is_only_read(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    connect = sqlite3.connect

    def only_reading(where: str, **options: Any) -> sqlite3.Connection:
        return connect(f"file:{where}?mode=ro", uri=True, **options)

    monkeypatch.setattr(sqlite3, "connect", only_reading)
    with pytest.raises(InputError, match="readonly database; let it be written, or add --no-learn"):
        FactStore(file)
    store = FactStore(file, learns=False)
    assert store.places_of("mug") == ("desk",)
    with pytest.raises(InputError, match="cannot be changed"):
        store.forget()
    store.close()


def test_values_of_a_wrong_kind_are_passed_over(
    file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    change(
        file,
        "INSERT INTO fact VALUES (10, 'long ago', 'seen', 'mug', 'sofa')",
        "INSERT INTO fact VALUES (11, 9e999, 'seen', 'mug', 'sofa')",
        "INSERT INTO fact VALUES (12, 1.0, 'dreamt', 'mug', 'sofa')",
        "INSERT INTO belief VALUES ('mug', x'00ff', 1, 20)",
        "INSERT INTO belief VALUES (x'00', 'desk', 1, 20)",
        "INSERT INTO belief VALUES ('cup', cast(x'ff' AS TEXT), 0, 20)",
    )
    store = FactStore(file)
    assert [fact.place for fact in store.all()] == ["desk"]
    assert set(store.beliefs()) == {"cup"}
    store.close()
    assert main(["facts", "--memory", str(file), "--json"]) == 0
    assert "sofa" not in capsys.readouterr().out


def test_a_huge_value_is_not_read(file: Path) -> None:
    change(file, "INSERT INTO belief VALUES ('mug', hex(zeroblob(2000000)), 1, 20)")
    store = FactStore(file)
    assert store.places_of("mug") == ()
    assert store.beliefs() == {}
    store.close()


def test_names_in_a_memory_forge_no_line(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    store = FactStore(file)
    store.saw(["cup\n\x1b[2Jmug"], "de\u202esk")
    store.close()
    assert main(["facts", "--memory", str(file)]) == 0
    assert all(line.isprintable() for line in capsys.readouterr().out.split("\n"))


def test_what_fails_in_the_middle_is_told_once_and_the_mission_goes_on(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    store = FactStore(tmp_path / "facts.sqlite")
    store._database.execute("PRAGMA query_only = on")
    run = run_mission("Bring a hammer.", facts=store)
    assert run.outcome.status == MissionStatus.DONE
    assert [r.message for r in caplog.records if "facts.sqlite" in r.message] == [
        r.message for r in caplog.records
    ][:1]
    store.close()
    assert store.beliefs() == {}


def test_a_name_that_no_database_takes_costs_the_fact_only(
    caplog: pytest.LogCaptureFixture,
) -> None:
    store = FactStore()
    store.saw(["half \ud83d", "mug"], "desk")
    assert store.beliefs() == {"mug": ("desk",)}
    assert "could not be kept (half \\ud83d seen desk)" in caplog.text
    store.close()


@pytest.mark.parametrize("ending", ["-journal", "-wal", "-shm"])
def test_a_pipe_beside_a_memory_holds_nothing_up(tmp_path: Path, ending: str) -> None:
    file = tmp_path / "memory.db"
    FactStore(file).close()
    os.mkfifo(f"{file}{ending}")
    with pytest.raises(InputError, match=f"memory.db{ending} beside it is no file"):
        FactStore(file)
