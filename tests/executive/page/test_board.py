"""What pages show is the same for all, whenever they come."""

import asyncio
import json

import pytest
from patience import PATIENCE_S

import executive.page.board
from executive.page.board import MOST_SAID, Board
from executive.page.site import news


def names(board: Board, known: int = 0) -> list[str]:
    return [change.name for change in board.since(known)]


def test_who_comes_late_is_told_each_notice_once_as_it_is_now() -> None:
    board = Board()
    for value in range(10):
        board.put("robot", value)
    board.put("doing", {"state": "ready"})
    assert names(board) == ["robot", "doing"]
    assert json.loads(board.since(0)[0].json) == 9


def test_who_comes_back_is_told_what_is_newer_and_nothing_else() -> None:
    board = Board()
    board.put("doing", "ready")
    known = board.say({"text": "before"})
    board.say({"text": "meanwhile"})
    board.put("doing", "busy")
    assert names(board, known) == ["said", "doing"]


def test_what_is_the_same_as_before_is_no_change() -> None:
    board = Board()
    board.put("path", [])
    last = board.since(0)[-1].number
    board.put("path", [])
    assert not board.since(last)


def test_what_is_forgotten_is_told_to_no_page_and_those_that_know_it_forget_it() -> None:
    board = Board()
    board.put("home", "plan")
    known = board.say({"text": "before"})
    board.forget()
    board.put("home", "plan")
    assert names(board) == ["fresh", "home"]
    assert names(board, known) == ["fresh", "home"]


def test_a_long_conversation_is_kept_as_far_as_pages_may_need_it() -> None:
    board = Board()
    for number in range(MOST_SAID + 10):
        board.say({"text": str(number)})
    assert len(board.since(0)) == MOST_SAID


def test_who_waits_is_woken_by_what_is_said_until_they_go() -> None:
    board, woken = Board(), list[float]()
    wake = woken.append
    board.wait_with(wake)
    board.say({"text": "Hello"})
    board.wait_no_more(wake)
    board.say({"text": "Hello?"})
    assert woken == [0.0]


def test_who_waits_is_not_woken_when_there_is_nothing_new_and_is_when_it_is_over() -> None:
    board, woken = Board(), list[float]()
    board.put("robot", 1)
    board.wait_with(woken.append)
    board.flush()
    board.put("robot", 1)
    board.flush()
    assert woken == [0.0]
    board.end()
    assert woken == [0.0, 0.0]


def test_what_waits_is_told_once_in_a_while_and_with_all_that_does_not(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(executive.page.board, "WAITS_S", PATIENCE_S)
    board, woken = Board(), list[float]()
    board.say({"text": "Hello"})
    board.wait_with(woken.append)
    for step in range(3):
        board.put("robot", step, waits=True)
        board.flush()
    (later,) = woken
    assert 0.0 < later <= PATIENCE_S
    board.put("doing", "busy")
    board.flush()
    assert woken == [later, 0.0]


def test_the_last_of_what_waits_reaches_the_page_though_nothing_more_happens() -> None:
    async def until_told() -> None:
        board = Board()
        async with asyncio.timeout(PATIENCE_S):
            async for piece in news(board, 0):
                if "event: caught_up" in piece:
                    for step in range(3):
                        board.put("robot", step, waits=True)
                        board.flush()
                if "event: robot\ndata: 2" in piece:
                    return

    asyncio.run(until_told())
