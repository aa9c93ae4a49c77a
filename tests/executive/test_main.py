"""The door: options, exit codes, the JSON outcome, the run folder, stopping."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest
from ontologies import ANNA, OWL
from patience import PATIENCE_S

from executive.__main__ import main
from executive.app import run_folder, session

pytestmark = pytest.mark.usefixtures("own_folder_and_signals")

FAKE = ["--world", "fake", "--search", "paper", "--llm", "none"]
QUICK = [*FAKE, "--user", "oracle", "--json"]
FIELDS = "command, kind, target, object, status, reason, source, location, inquiries, visited, \
llm_calls, candidates, mission_time_s, thinking_time_s, wall_time_s, run_dir, model_failure, \
goals, tasks"


def test_a_done_mission_exits_0_with_one_json_outcome(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*QUICK, "Bring a sugar_box"]) == 0
    outcome = json.loads(capsys.readouterr().out)
    assert ", ".join(outcome) == FIELDS
    assert (outcome["status"], outcome["location"]) == ("done", "counter_wagon")
    assert outcome["source"] == "user"


def test_words_that_are_no_text_do_not_cost_the_log(
    capsys: pytest.CaptureFixture[str], caplog: pytest.LogCaptureFixture
) -> None:
    assert main([*QUICK, "Bring \udcff the sugar_box"]) == 0
    assert json.loads(capsys.readouterr().out)["object"] == "sugar_box"
    assert "was dropped" not in caplog.text


def test_a_run_leaves_its_folder(capsys: pytest.CaptureFixture[str]) -> None:
    main([*QUICK, "Bring a sugar_box"])
    outcome = json.loads(capsys.readouterr().out)
    folder = Path(outcome["run_dir"])
    assert folder.parent.name == "runs"
    assert folder.name.endswith("Z-bring-a-sugar-box")
    assert {file.name for file in folder.iterdir()} == {
        "config.toml",
        "mission.mcap",
        "mission.rrd",
        "outcome.json",
    }
    assert json.loads((folder / "outcome.json").read_text()) == outcome


@pytest.mark.parametrize("taken", ["mission.mcap", "mission.rrd", "outcome.json.new"])
def test_a_recording_that_lacks_something_is_not_called_whole(
    taken: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = [*FAKE, "--user", "oracle", "Find the mug"]
    assert main(words) == 0
    assert "but not all of it" not in capsys.readouterr().out
    made = run_folder.new_folder

    def with_a_name_taken(*asked: Any) -> Path:
        folder = made(*asked)
        (folder / taken).mkdir()
        return folder

    monkeypatch.setattr(session, "new_folder", with_a_name_taken)
    assert main(words) == 0
    assert "but not all of it: see the warnings" in capsys.readouterr().out


def test_the_kept_config_runs_the_same_mission_again(capsys: pytest.CaptureFixture[str]) -> None:
    main([*QUICK, "Find an apple"])
    first = json.loads(capsys.readouterr().out)
    main(["--json", "--config", f"{first['run_dir']}/config.toml", "Find an apple"])
    second = json.loads(capsys.readouterr().out)
    assert first["mission_time_s"] == second["mission_time_s"]
    assert first["visited"] == second["visited"]


@pytest.mark.parametrize(
    ("arguments", "code", "sentence"),
    [
        (["--user", "none", "Find an apple"], 1, "there is nobody to ask"),
        (["--user", "none", "Find a zebra"], 1, "I know no 'zebra'"),
        ([""], 2, "I do not understand what you said"),
        (["Fnord fnord"], 2, "I do not understand 'Fnord fnord'"),
    ],
)
def test_a_mission_that_is_not_done_says_why(
    arguments: list[str], code: int, sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*QUICK, *arguments]) == code
    assert sentence in json.loads(capsys.readouterr().out)["reason"]


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--home", "castle"], "packaged are four_rooms"),
        (["--home", "none.toml"], "none.toml"),
        (["--place", "mug=moon"], "cabinet_kitchen"),
        (["--place", "grail=desk"], "mug"),
        (["--llm", "none.gguf", "--knowledge", "okb+llm"], "none.gguf"),
        (["--llm", "http://127.0.0.1:1/v1", "--elicit", "rank"], "use --elicit generate"),
        (["--config", "none.toml"], "none.toml: cannot be read"),
        (["--prompts", "none.toml"], "none.toml: cannot be read"),
        (["--kb", "none.owl"], "none.owl: cannot be read"),
        (["--person", "Anna"], "person Anna: the ontology knows nobody of this name"),
        (["--memory", "."], "is no memory"),
        (["--runs", "/dev/null/runs"], "--runs"),
        (["--profile", "nav2"], "needs none: it says what a robot over the wire has; give --robot"),
    ],
)
def test_bad_input_exits_2_with_one_sentence(
    arguments: list[str], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*QUICK, *arguments, "Find an apple"]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("error: ")
    assert sentence in captured.err
    assert "Traceback" not in captured.err


@pytest.mark.parametrize("arguments", [["--place", "mug"], ["--seed", "x"], ["--wrld", "fake"]])
def test_bad_usage_exits_2(arguments: list[str]) -> None:
    with pytest.raises(SystemExit) as error:
        main([*QUICK, *arguments, "Find an apple"])
    assert error.value.code == 2


def test_a_broken_model_file_is_bad_input(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model = tmp_path / "broken.gguf"
    model.write_bytes(b"not a model")
    assert main([*QUICK, "--llm", str(model), "Find an apple"]) == 2
    assert "broken.gguf" in capsys.readouterr().err


def start(*arguments: str) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "executive", *FAKE, *arguments],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
    )


def asked(process: subprocess.Popen[str]) -> None:
    assert process.stderr
    for line in process.stderr:
        if "Where is the apple?" in line:
            return
    raise AssertionError("the robot did not ask")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_stops_the_robot_and_closes_the_logs(number: signal.Signals) -> None:
    with start("--json", "Find an apple") as process:
        asked(process)
        process.send_signal(number)
        out, _ = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 130
    outcome = json.loads(out)
    assert outcome["status"] == "stopped"
    assert (Path(outcome["run_dir"]) / "outcome.json").exists()


def test_the_word_stop_stops_it() -> None:
    with start("--json", "Find an apple") as process:
        asked(process)
        out, _ = process.communicate("stop\n", timeout=PATIENCE_S)
    assert process.returncode == 130
    assert json.loads(out)["reason"] == "stopped by the person"


def test_end_of_input_is_no_answer_and_no_hang() -> None:
    with start("--json", "Find an apple") as process:
        out, _ = process.communicate("", timeout=PATIENCE_S)
    assert process.returncode == 1
    assert "the input has ended" in json.loads(out)["reason"]


def test_interactive_runs_one_command_a_line() -> None:
    with start("--json") as process:
        out, _ = process.communicate(
            "Find an apple\nliving room\nTake a hammer\n", timeout=PATIENCE_S
        )
    assert process.returncode == 0
    outcomes = [json.loads(line) for line in out.splitlines()]
    assert [o["object"] for o in outcomes] == ["apple", "hammer"]
    assert [o["status"] for o in outcomes] == ["done", "done"]
    assert outcomes[0]["run_dir"] != outcomes[1]["run_dir"]


def test_a_persons_own_file_settles_which_fruit(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "more.owl").write_text(OWL.format(ANNA))
    assert main([*QUICK, "--kb", "more.owl", "--person", "Anna", "Find a fruit"]) == 0
    outcome = json.loads(capsys.readouterr().out)
    assert (outcome["object"], outcome["inquiries"]) == ("pear", 1)


@pytest.mark.parametrize(
    ("options", "sources"),
    [
        ([], ["user", "user"]),
        (["--memory", "facts.sqlite"], ["user", "memory"]),
        (["--memory", "facts.sqlite", "--no-learn"], ["user", "user"]),
    ],
)
def test_facts_outlive_the_session_in_a_file_only(
    options: list[str], sources: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    said = []
    for _ in range(2):
        assert main([*QUICK, *options, "Find a sugar_box"]) == 0
        said.append(json.loads(capsys.readouterr().out)["source"])
    assert said == sources


def test_facts_outlive_the_mission(tmp_path: Path) -> None:
    with start("--json") as process:
        out, _ = process.communicate(
            "Find an apple\nliving room\nFind an apple\n", timeout=PATIENCE_S
        )
    assert [json.loads(line)["source"] for line in out.splitlines()] == ["user", "memory"]


def test_a_signal_before_the_first_command_ends_the_session() -> None:
    with start() as process:
        assert process.stderr
        assert "What can I do" in process.stderr.readline()
        time.sleep(0.2)
        process.send_signal(signal.SIGINT)
        process.wait(timeout=PATIENCE_S)
    assert process.returncode == 130


def test_an_option_without_effect_is_told_and_the_rest_done(
    caplog: pytest.LogCaptureFixture,
) -> None:
    assert main([*QUICK, "--detector", "mine.onnx", "Find the mug"]) == 0
    assert "--detector has no effect: the instant world knows what is" in caplog.text
