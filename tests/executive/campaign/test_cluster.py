"""A campaign on a real Dask scheduler with two real worker processes."""

import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
from llama_server import llama_server
from patience import PATIENCE_S

from executive.campaign.__main__ import main
from executive.campaign.journal import Entry, Journal, Row

pytest.importorskip("distributed")
pytestmark = pytest.mark.usefixtures("no_plots")

COMMANDS = ("Find an apple.", "Find a power_drill.", "Take a mug.", "Bring a sugar_box.")


@pytest.fixture
def start() -> Iterator[Callable[..., subprocess.Popen[str]]]:
    """Starts `dask` with these arguments; all of it is ended after the test."""
    with ExitStack() as stack:

        def run(*arguments: str) -> subprocess.Popen[str]:
            command = [sys.executable, "-m", "dask", *arguments, "--no-dashboard"]
            process = stack.enter_context(
                subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
            )
            stack.callback(process.kill)
            return process

        yield run


def address_of(scheduler: "subprocess.Popen[str]") -> str:
    assert scheduler.stderr is not None
    for line in scheduler.stderr:
        if "Scheduler at:" in line:
            return line.split()[-1]
    raise AssertionError("the scheduler did not start")


def rows_of(out: Path) -> list[Row]:
    return [entry.row for entry in Journal(out / "journal.jsonl").entries()]


def test_a_campaign_that_is_stopped_and_loses_a_worker_loses_no_mission_and_counts_none_twice(
    start: Callable[..., "subprocess.Popen[str]"], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file, out = tmp_path / "commands.txt", tmp_path / "out"
    file.write_text("\n".join(COMMANDS))
    address = address_of(start("scheduler", "--port", "0", "--host", "127.0.0.1"))
    worker = ("worker", address, "--nthreads", "1", "--no-nanny")
    workers = [start(*worker), start(*worker)]
    append = Journal.append

    def append_and_act(journal: Journal, entry: Entry) -> None:
        append(journal, entry)
        ended = len(rows_of(out))
        if ended == 5:
            raise KeyboardInterrupt
        if ended == 12:
            workers[0].kill()

    monkeypatch.setattr(Journal, "append", append_and_act)
    options = ["--llm", "none", "--seeds", "2", "--commands", str(file), "--out", str(out)]
    assert main([*options, "--cluster", address]) == 130
    stopped = rows_of(out)
    assert main([*options, "--cluster", address]) == 0
    rows = rows_of(out)
    assert rows[:5] == stopped
    assert len(rows) == len({row.key for row in rows}) == 3 * 2 * 4 * 2
    assert all(row.completed for row in rows)
    assert workers[0].wait() != 0
    assert workers[1].poll() is None


@pytest.mark.llm
def test_the_workers_of_a_cluster_share_one_server_of_the_language_model(
    start: Callable[..., "subprocess.Popen[str]"], tmp_path: Path
) -> None:
    file, out = tmp_path / "commands.txt", tmp_path / "out"
    file.write_text("Find an apple.")
    (tmp_path / "patient.toml").write_text(f"llm_timeout_s = {10 * PATIENCE_S}")
    address = address_of(start("scheduler", "--port", "0", "--host", "127.0.0.1"))
    worker = ("worker", address, "--nthreads", "1", "--no-nanny")
    start(*worker), start(*worker)
    options = ["--seeds", "2", "--commands", str(file), "--systems", "okb+llm", "--out", str(out)]
    options += ["--config", str(tmp_path / "patient.toml")]
    with llama_server(tmp_path / "log") as server:
        assert main([*options, "--llm", server.url, "--cluster", address]) == 0
    rows = rows_of(out)
    assert len(rows) == 2 * 2
    assert all(row.completed and row.llm_calls for row in rows), rows


def test_an_address_without_a_scheduler_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("executive.campaign.cluster.CONNECTING_S", 1)
    options = ["--llm", "none", "--seeds", "1", "--out", str(tmp_path / "out")]
    assert main([*options, "--cluster", "tcp://127.0.0.1:9"]) == 2
    assert "dask scheduler" in capsys.readouterr().err
