"""Programs and sessions: how a signal, a closed terminal, a word end them."""

import json
import os
import pty
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import IO

import pytest
from patience import PATIENCE_S

from executive.replay.replaying import replay

DOORS = ("executive", "executive.campaign", "kb", "logs", "sim", "trees", "kb.benchmark")
ROBOT = [
    *(sys.executable, "-m", "executive"),
    *("--world", "fake", "--llm", "none", "--search", "paper"),
]
SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT]


@pytest.fixture(autouse=True)
def _own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONUNBUFFERED", "1")


def wait_for(words: str, stream: IO[str] | None, *more: str) -> None:
    """Until these words were said; and more, in any order, as threads say them."""
    assert stream
    waited_for = {words, *more}
    for line in stream:
        waited_for = {words for words in waited_for if words not in line}
        if not waited_for:
            return
    raise AssertionError(f"never said {waited_for}")


# --- in the first second ---


@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGHUP])
def test_a_signal_during_imports_ends_a_program_without_a_traceback(
    door: str, number: signal.Signals, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    slow = f"import os, time\nos.kill(os.getpid(), {number:d})\ntime.sleep(600)\n"
    (tmp_path / "argparse.py").write_text(slow)  # every door imports it
    monkeypatch.setenv("PYTHONPATH", f"{tmp_path}{os.pathsep}{os.getenv('PYTHONPATH', '')}")
    ended = subprocess.run(
        [sys.executable, "-m", door], capture_output=True, text=True, timeout=PATIENCE_S
    )
    assert (ended.returncode, ended.stderr) == (130, "")


def test_a_program_looks_for_garbage_once_it_has_begun() -> None:
    code = """if True:
        import gc, sys
        from executive.start import begin
        begin()
        from executive.shell import all_is_kept, entry_point

        @entry_point
        def main(arguments):
            before = gc.isenabled()
            with all_is_kept():
                meanwhile = gc.isenabled()
            return 10 * before + 5 * meanwhile + gc.isenabled()

        sys.exit(main())
    """
    assert subprocess.run([sys.executable, "-c", code], timeout=PATIENCE_S).returncode == 11


def test_a_program_under_nohup_outlives_its_terminal() -> None:
    code = "import os, signal; from executive.start import begin; begin(); os.kill(os.getpid(), 1)"
    ended = subprocess.run(
        ["nohup", sys.executable, "-c", code], stdin=subprocess.DEVNULL, capture_output=True
    )
    assert ended.returncode == 0


def test_a_stuck_thread_does_not_keep_a_program_from_ending() -> None:
    code = """if True:
        import threading, time
        from executive import shell
        shell.begin()
        threading.Thread(target=time.sleep, args=[600]).start()
        shell.leave_within(0.1, 7)
    """
    assert subprocess.run([sys.executable, "-c", code], timeout=PATIENCE_S).returncode == 7


# --- a session ---


def start(*arguments: str, **options: object) -> "subprocess.Popen[str]":
    streams = {name: subprocess.PIPE for name in ("stdin", "stdout", "stderr")} | options
    return subprocess.Popen([*ROBOT, *arguments], text=True, **streams)  # type: ignore[call-overload,no-any-return]


@pytest.mark.parametrize("number", SIGNALS)
def test_a_signal_ends_a_conversation_in_order(number: signal.Signals) -> None:
    with start("--json") as process:
        print("Find an apple", file=process.stdin, flush=True)
        wait_for("Where is the apple?", process.stderr)
        process.send_signal(number)
        out, said = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 130
    assert "Stopping." in said
    outcome = json.loads(out)
    assert outcome["status"] == "stopped"
    assert (Path(outcome["run_dir"]) / "outcome.json").exists()


def test_a_stop_ends_the_mission_and_not_the_session() -> None:
    with start("--json") as process:
        print("Find an apple", file=process.stdin, flush=True)
        wait_for("Where is the apple?", process.stderr)
        print("CANCEL, please!", file=process.stdin, flush=True)
        wait_for("Stopping.", process.stderr, "What can I do for you?")
        print("stop", file=process.stdin, flush=True)
        wait_for("There is nothing to stop", process.stderr)
        out, _ = process.communicate("Find an apple\nliving room\nquit\n", timeout=PATIENCE_S)
    assert process.returncode == 0
    outcomes = [json.loads(line) for line in out.splitlines()]
    assert [o["status"] for o in outcomes] == ["stopped", "done"]


def test_a_session_that_ends_after_a_stop_says_so_by_its_exit_status() -> None:
    with start() as process:
        print("Find an apple", file=process.stdin, flush=True)
        wait_for("Where is the apple?", process.stderr)
        process.communicate("stop\n", timeout=PATIENCE_S)
    assert process.returncode == 130


@pytest.fixture
def typed() -> Iterator[tuple[int, "subprocess.Popen[str]"]]:
    keys, terminal = pty.openpty()
    process = start(stdin=terminal)
    os.close(terminal)
    yield keys, process
    process.kill()
    process.communicate()
    os.close(keys)


def test_at_a_real_terminal_stop_and_quit_are_heard(
    typed: tuple[int, "subprocess.Popen[str]"],
) -> None:
    keys, process = typed
    wait_for("What can I do for you?", process.stderr)
    os.write(keys, b"Find an apple\n")
    wait_for("Where is the apple?", process.stderr)
    os.write(keys, b"Stop!\n")
    wait_for("Stopping.", process.stderr, "What can I do for you?")
    os.write(keys, b"quit\n")
    assert process.wait(timeout=PATIENCE_S) == 130


# --- closed and broken streams ---


def shell(redirections: str, *options: str) -> "subprocess.CompletedProcess[str]":
    command = [*ROBOT, "--json", *options, "Find a mug"]
    script = f'exec "$@" {redirections}'
    return subprocess.run(
        ["bash", "-c", script, "bash", *command], capture_output=True, text=True, timeout=PATIENCE_S
    )


def test_a_closed_standard_input_is_nobody_at_once() -> None:
    ended = shell("0<&-")
    assert ended.returncode == 1
    assert "there is nobody to ask" in json.loads(ended.stdout)["reason"]


@pytest.mark.parametrize(
    "redirections",
    [">&-", "2>&-", ">&- 2>&- 0<&-", ">/dev/full", "2>/dev/full", "2> >(true)", "> >(true)"],
)
def test_a_lost_terminal_ends_no_mission(redirections: str) -> None:
    ended = shell(redirections, "--user", "oracle")
    assert ended.returncode == 0
    assert "Traceback" not in ended.stderr
    [run] = Path("runs").iterdir()
    assert json.loads((run / "outcome.json").read_text())["status"] == "done"
    assert replay(run).parting is None


def test_a_terminal_that_knows_ascii_only_is_told_everything(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("PYTHONIOENCODING", "ascii")
    ended = subprocess.run(
        [*ROBOT, "--user", "none", "Find a K\u00e4sekuchen \N{SNOWMAN}"],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
    )
    assert ended.returncode == 1
    assert "K\\xe4sekuchen \\u2603" in ended.stdout
    assert "Traceback" not in ended.stderr


def test_too_long_a_command_is_refused_at_once() -> None:
    ended = subprocess.run(
        [*ROBOT, "!" * 20_000], capture_output=True, text=True, timeout=PATIENCE_S
    )
    assert ended.returncode == 2
    assert "at most 1,000 characters" in ended.stderr
