"""In campaigns of draws the language model's thinking takes no mission time."""

from dataclasses import replace
from threading import Timer

from executive.app.parts import Parts
from executive.campaign.timeless import Timeless
from executive.events import Inbox
from executive.testing.bench import Run, four_rooms, run_mission
from executive.types.llm import RankRequest, Usage
from executive.types.results import Scored
from kb.llm.scripted import Scripted

SCORES = tuple(1.0 if place.name == "desk" else 0.0 for place in four_rooms().places())


class Sleepy(Scripted):
    """Takes its time, as the world outside has it."""

    def rank(self, request: RankRequest) -> int:
        self.requests.append(request)
        number = self._inbox.open(real=True)
        Timer(0.2, self._inbox.end, (number, Scored(request, SCORES, Usage()))).start()
        return number


def mission(model: Sleepy, within: Inbox) -> Run:
    def change(parts: Parts) -> Parts:
        return replace(parts, model=Timeless(model, within, parts.inbox))

    return run_mission("Find the mug", defaults=False, place={"mug": "desk"}, change=change)


def test_mission_time_stands_still_while_it_thinks_and_what_it_ranked_is_known() -> None:
    within = Inbox()
    model = Sleepy((), within)
    model.name = "sleepy"
    first, second = mission(model, within), mission(model, within)
    assert first.outcome.visited == second.outcome.visited == ("desk",)
    assert first.outcome.thinking_time_s == second.outcome.thinking_time_s == 0.0
    assert first.outcome.mission_time_s == second.outcome.mission_time_s
    assert len(model.requests) == 1
