"""Leads a participant through a study: what is over is written down before what comes next."""

import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from executive.app.session import Session
from executive.events import THE_PERSON, Inbox, StopRequested
from executive.page.study.data import RUNS, Journal, StudyData, number_of
from executive.page.study.file import settings_of
from executive.page.study.page import StudyPage
from executive.page.study.showing import Shown, declined, shown
from executive.page.study.steps import Kind, Step, steps
from executive.page.study.tables import FINISHED, GAVE_UP, LEFT, STOP, TIME, renew_tables
from executive.page.study.watching import SteppedIn, Watch
from executive.types.outcome import Outcome

AGREED, DECLINED, READ = "agreed", "declined", "read"


class Leader:
    """Goes through the steps of a participant that are not over yet."""

    def __init__(self, data: StudyData, journal: Journal, page: StudyPage) -> None:
        """Lead the participant of this journal by this page."""
        self._data, self._study = data, data.study
        self._journal, self._page = journal, page
        self._inbox = Inbox()
        self._talks: _Talks | None = None
        self._out_of_time = False

    def lead(self) -> bool:
        """Go on to the end; whether they took part.

        Raises:
            KeyboardInterrupt: if it was interrupted: the same goes on another time.
            ExecutiveError: if the robot of a condition cannot be built, or nothing can be written.
        """
        done = self._journal.done()
        todo = steps(self._study, number_of(self._journal.code))
        with ExitStack() as opened:
            for over, step in enumerate(todo):
                if step.key in done:
                    continue
                if self._talks and step.kind is not Kind.TASK:
                    opened.close()
                    self._talks = None
                if not self._go(step, self._seen(step, over, len(todo)), opened):
                    self._page.show(declined(self._journal.code), lambda value: "It is over.")
                    return False
        return True

    def interrupt(self, by: str) -> None:
        """End it in order, as soon as the robot is at rest; from a signal handler, too."""
        self._inbox.post(StopRequested(by))
        self._page.interrupt()

    def _seen(self, step: Step, over: int, steps: int) -> Shown:
        """What the page is told; that the time of the task before was over, once."""
        told = {"out_of_time": self._out_of_time}
        self._out_of_time = False
        return {**shown(self._study, self._journal.code, step, over, steps), **told}

    def _go(self, step: Step, seen: Shown, opened: ExitStack) -> bool:
        """One step; False if the participant takes no part."""
        match step.kind:
            case Kind.CONSENT:
                return self._consent(step, seen)
            case Kind.TASK:
                self._task(step, seen, opened)
            case Kind.QUESTIONNAIRE:
                self._ask(step, seen)
            case Kind.THANKS:
                self._page.show(seen, lambda value: "It is over.")
                self._note("finished", step)
                renew_tables(self._data)
            case _:
                self._page.show(seen, one_of(READ))
                self._page.wait()
                self._note("read", step)
        return True

    def _note(self, kind: str, step: Step, **values: Any) -> None:
        """Write down that a step is over."""
        where = {"condition": step.condition, "position": step.position}
        self._journal.append(kind, done=step.key, **where, **values)

    def _consent(self, step: Step, seen: Shown) -> bool:
        self._page.show(seen, one_of(AGREED, DECLINED))
        if self._page.wait() == DECLINED:
            return False
        self._note("consent", step, sha256=self._study.consent_sha256)
        return True

    def _ask(self, step: Step, seen: Shown) -> None:
        asked = self._study.questionnaire(step.name)
        self._page.show(seen, asked.fault)
        answers = asked.kept(self._page.wait())
        self._note("answers", step, questionnaire=step.name, answers=answers)

    def _task(self, step: Step, seen: Shown, opened: ExitStack) -> None:
        where = {"condition": step.condition, "position": step.position, "task": step.name}
        if self._talks is None:
            self._page.show({**seen, "waits": True}, lambda value: "The robot is not ready yet.")
            self._talks = opened.enter_context(self._meeting(step))
        talks = self._talks
        talks.session.heard.clear()
        talks.page.person.begin()
        self._journal.append("task_began", step=step.key, **where)
        began = time.monotonic()
        self._page.show(seen, one_of(FINISHED, GAVE_UP), talks.page.person.leave)
        with _at_most(self._study.task(step.name).limit_s, talks.page.person.leave):
            talks.until_over(where)
        self._out_of_time = talks.page.person.ended == TIME
        self._note(
            "task",
            step,
            task=step.name,
            turn=step.turn,
            ended=talks.page.person.ended,
            duration_s=round(time.monotonic() - began, 3),
        )
        renew_tables(self._data)

    @contextmanager
    def _meeting(self, step: Step) -> "Iterator[_Talks]":
        """The robot of a condition, in a conversation of its own."""
        condition = self._study.condition(step.condition)
        runs = self._journal.folder / RUNS / condition.name
        settings = settings_of(self._study, condition, "study", runs=runs)
        self._inbox = Inbox()
        person, watch = self._page.converse(self._inbox), Watch()
        with Session(
            settings, inbox=self._inbox, user=person, sinks=[*self._page.sinks, watch]
        ) as session:
            self._page.follow(session)
            if self._page.desk and self._page.desk.wizard:
                self._page.desk.wizard.done = watch.beside
            yield _Talks(session, self._page, self._journal, watch, self._data.folder)


class _Talks:
    """The conversations of a participant with the robot of one condition."""

    def __init__(
        self, session: Session, page: StudyPage, journal: Journal, watch: Watch, root: Path
    ) -> None:
        self.session, self.page = session, page
        self._journal, self._watch, self._root = journal, watch, root

    def until_over(self, where: dict[str, Any]) -> None:
        """Do what is said until the task is over.

        Raises:
            KeyboardInterrupt: if a signal says stop.
        """
        person, session = self.page.person, self.session
        while not person.ended and (line := session.next_command(person)) is not None:
            if session.talk(line):
                self._journal.append("answered", words=line, **where)
                continue
            outcome = session.run(line)
            self._write(line, outcome, where)
            if session.stopped_by:
                raise KeyboardInterrupt
        self._write_unheard(where)

    def _stepped_in(self) -> list[SteppedIn]:
        """Who stepped in; the last stop of a participant who left is no stop."""
        seen = self._watch.take_all()
        theirs = [i for i, one in enumerate(seen) if (one.what, one.by) == (STOP, THE_PERSON)]
        if self.page.person.left_it_running and theirs:
            seen[theirs[-1]] = replace(seen[theirs[-1]], what=LEFT)
        return seen

    def _write_unheard(self, where: dict[str, Any]) -> None:
        for one in self._watch.take_unheard():
            self._journal.append("intervention", recording="", **asdict(one), **where)

    def _write(self, words: str, outcome: Outcome, where: dict[str, Any]) -> None:
        folder = outcome.run_dir
        recording = str(Path(folder).relative_to(self._root)) if folder else ""
        self._write_unheard(where)
        for one in self._stepped_in():
            self._journal.append("intervention", recording=recording, **asdict(one), **where)
        self._journal.append(
            "mission",
            words=words,
            status=outcome.status,
            reason=outcome.reason,
            questions=outcome.inquiries,
            visits=len(outcome.visited),
            llm_calls=outcome.llm_calls,
            mission_time_s=outcome.mission_time_s,
            recording=recording,
            **where,
        )


@contextmanager
def _at_most(limit_s: float | None, leave: Any) -> Iterator[None]:
    """Have the participant led on when the time is over."""
    if limit_s is None:
        yield
        return
    timer = threading.Timer(limit_s, leave, [TIME])
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


def one_of(*known: str) -> Any:
    """Takes one of these, and finds fault with all else."""
    return lambda value: "" if value in known else f"This should be {' or '.join(known)}."
