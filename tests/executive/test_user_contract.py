"""Whoever can be asked keeps the contract: a person at a pipe, and those who stand in for one."""

import io
import os
from collections.abc import Iterator

import pytest

from executive.events import Inbox
from executive.testing.contracts.user import UserBench, UserContract
from executive.user import Console, Nobody, Oracle, Scripted


class TestConsole(UserContract):
    @pytest.fixture
    def user_bench(self) -> Iterator[UserBench]:
        reads, writes = os.pipe()
        with os.fdopen(writes, "w", buffering=1) as person, os.fdopen(reads) as heard:
            user = Console(inbox := Inbox(), heard, io.StringIO())
            yield UserBench(user, inbox, says=lambda words: print(words, file=person))
            print("quit", file=person)


class Prompted(Scripted):
    """Says next what it is told to."""

    def will_say(self, words: str) -> None:
        self._answers.append(words)


class TestScripted(UserContract):
    @pytest.fixture
    def user_bench(self) -> UserBench:
        user = Prompted(inbox := Inbox())
        return UserBench(user, inbox, will_say=user.will_say)


class TestOracle(UserContract):
    @pytest.fixture
    def user_bench(self) -> UserBench:
        inbox = Inbox()
        return UserBench(Oracle(inbox, {"mug": "desk", "pear": "desk"}.get), inbox)


class TestNobody(UserContract):
    @pytest.fixture
    def user_bench(self) -> UserBench:
        return UserBench(Nobody(inbox := Inbox()), inbox)
