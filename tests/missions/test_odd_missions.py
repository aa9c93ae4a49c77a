"""Missions with servers as people have them."""

import io
import json
import logging
from pathlib import Path
from typing import Any

import pytest
from mcap.reader import make_reader
from odd_server import Handler, answer, refuses, serving, streams, word

from executive.__main__ import main, parser
from executive.app.session import Session
from executive.config import load_settings
from executive.errors import InputError
from executive.types.outcome import MissionStatus, Outcome

ANSWER = '{"places": ["counter\\_wagon", "desk",]}'
SECRET = "sk-4f5e6d7c"


def run(url: str, runs: Path, **more: Any) -> Outcome:
    settings = load_settings(
        llm=url,
        defaults=False,
        world="fake",
        search="paper",
        user="none",
        runs=runs,
        temperature=0.0,
        **more,
    )
    session = Session(settings, out=io.StringIO())
    try:
        return session.run("Bring a sugar_box")
    finally:
        session.close()


def picky(handler: Handler, body: dict[str, Any]) -> None:
    """No system turn, no seed, thoughts before a reply that is no JSON to the letter."""
    if any(turn["role"] == "system" for turn in body["messages"]):
        refuses(400, "System role not supported")(handler, body)
    elif "seed" in body:
        refuses(422, {"detail": [{"loc": ["body", "seed"], "msg": "not permitted"}]})(handler, body)
    else:
        thought = '<think>Is it {"places": ["sofa"]}? No.</think>'
        usage = {"usage": {"prompt_tokens": -1, "completion_tokens": 2.5}}
        draft = 'First: {"places": ["desk"]}. Better:'
        streams(word(thought), word(draft), word(ANSWER), usage, "[DONE]")(handler, body)


def test_a_mission_is_done_with_a_server_that_is_odd_in_many_ways(tmp_path: Path) -> None:
    with serving(picky, models=("an-embedding", "chat")) as odd:
        outcome = run(odd.url, tmp_path)
    assert (outcome.status, outcome.location) == (MissionStatus.DONE, "counter_wagon")
    assert outcome.visited == ("counter_wagon",)


def test_a_key_is_in_no_file_and_in_no_line(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
    caplog: pytest.LogCaptureFixture,
) -> None:
    def locked(handler: Handler, body: dict[str, Any]) -> None:
        if handler.headers["Authorization"] != f"Bearer {SECRET}":
            answer(handler, 401, {"error": {"message": "who are you?"}})
        elif body:
            streams(word(f"{SECRET}: {ANSWER}"), word("", "stop"), "[DONE]")(handler, body)
        else:
            answer(handler, 200, {"data": [{"id": "m"}]}, X_Your_Key=SECRET)

    caplog.set_level(logging.DEBUG)
    monkeypatch.setenv("EXECUTIVE_LLM_API_KEY", SECRET)
    options = ["--world", "fake", "--user", "none", "--no-defaults", "--runs", str(tmp_path)]
    with serving(locked, models=locked) as odd:
        assert main([*options, "--json", "-vv", "--llm", odd.url, "Bring a sugar_box"]) == 0
    printed = capfd.readouterr()
    told = [printed.out + printed.err + caplog.text]
    files = [path for path in tmp_path.rglob("*") if path.is_file()]
    told += [path.read_bytes().decode(errors="replace") for path in files]
    (recording,) = tmp_path.rglob("*.mcap")
    with recording.open("rb") as file:
        reader = make_reader(file)
        told += [m.data.decode(errors="replace") for _, _, m in reader.iter_messages()]
        told += [a.data.decode(errors="replace") for a in reader.iter_attachments()]
        told += [str(m.metadata) for m in reader.iter_metadata()]
    assert len(files) > 3
    assert any("counter" in text for text in told)
    assert not any(SECRET in text for text in told)


def test_a_named_model_is_asked_and_recorded(tmp_path: Path) -> None:
    options = vars(parser().parse_args(["--llm-model", "mine"]))
    with serving(streams(word(ANSWER, "stop")), models=("other",)) as odd:
        outcome = run(odd.url, tmp_path, llm_model=options["llm_model"])
    assert outcome.status == MissionStatus.DONE
    assert [body["model"] for body in odd.bodies] == ["mine"]
    assert 'llm_model = "mine"' in (Path(str(outcome.run_dir)) / "config.toml").read_text()


@pytest.mark.parametrize("name", ["", " ", "a\nb", "x" * 300])
def test_a_model_has_a_name_of_one_line(name: str) -> None:
    with pytest.raises(InputError, match="llm_model"):
        load_settings(llm_model=name)


def test_the_settings_never_hold_a_key(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("EXECUTIVE_LLM_API_KEY", SECRET)
    settings = load_settings(llm="http://127.0.0.1:1")
    assert SECRET not in f"{settings!r}{settings.to_toml()}{json.dumps(settings.model_dump_json())}"


def test_a_home_that_fills_the_context_window_is_asked_about_by_rooms(tmp_path: Path) -> None:
    def knows_rooms(handler: Handler, body: dict[str, Any]) -> None:
        within = "Its furniture is" in body["messages"][-1]["content"]
        place = "counter_wagon" if within else "kitchen"
        streams(word(json.dumps({"places": [place]}), "stop"))(handler, body)

    with serving(knows_rooms) as odd:
        outcome = run(odd.url, tmp_path, context_tokens=512)
    assert (outcome.status, outcome.location) == (MissionStatus.DONE, "counter_wagon")
    assert "counter_wagon" not in odd.bodies[0]["messages"][0]["content"]
