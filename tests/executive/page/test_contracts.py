"""The page's person and its log keep what a User and a Sink promise."""

import pytest

from executive.events import Inbox
from executive.page.board import Board
from executive.page.person import PagePerson
from executive.page.sink import PageSink
from executive.testing.contracts.sink import SinkBench, SinkContract
from executive.testing.contracts.user import UserBench, UserContract


class TestPagePerson(UserContract):
    @pytest.fixture
    def user_bench(self) -> UserBench:
        person = PagePerson(inbox := Inbox(), Board())
        return UserBench(person, inbox, says=person.says)


class TestPageSink(SinkContract):
    @pytest.fixture
    def sink_bench(self) -> SinkBench:
        board = Board()
        return SinkBench(lambda: PageSink(board), lambda: len(board.since(0)))
