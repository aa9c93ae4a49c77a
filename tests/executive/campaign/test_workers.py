"""Worker processes: forked off one that has loaded what missions import."""

import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import pytest
from patience import PATIENCE_S

from executive.campaign import workers
from executive.campaign.workers import start_loading

pytestmark = pytest.mark.skipif(not workers.FORKS, reason="workers are not forked on this system")

ASK_A_WORKER = """\
from concurrent.futures import ProcessPoolExecutor
from executive.campaign.workers import start_loading

if __name__ == "__main__":
    with ProcessPoolExecutor(1, mp_context=start_loading()) as pool:
        print(pool.submit(eval, "__import__('sim').__file__").result())
"""


def test_a_worker_has_loaded_what_missions_import_before_it_begins() -> None:
    with ProcessPoolExecutor(1, mp_context=start_loading()) as pool:
        asked = pool.submit(eval, "{'sim.world', 'kb.llm.llama'} <= {*__import__('sys').modules}")
        assert asked.result()


def test_workers_of_two_pools_are_forked_off_the_same_process() -> None:
    def parent() -> int:
        with ProcessPoolExecutor(1, mp_context=start_loading()) as pool:
            return pool.submit(eval, "__import__('os').getppid()").result()

    assert parent() == parent()


def test_workers_import_nothing_from_the_folder_that_they_are_run_in(tmp_path: Path) -> None:
    (tmp_path / "sim").mkdir()
    (tmp_path / "sim" / "__init__.py").write_text("print('not ours')")
    (tmp_path / "apart").mkdir()
    (tmp_path / "apart" / "ask.py").write_text(ASK_A_WORKER)
    run = subprocess.run(
        [sys.executable, tmp_path / "apart" / "ask.py"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
    )
    assert run.stdout.strip().endswith("sim/__init__.py")
    assert str(tmp_path) not in run.stdout
    assert "not ours" not in run.stdout
    assert not run.stderr
