from executive.events import Broke, Ended, Started, StopRequested
from executive.situation import Situation
from executive.types.llm import RankRequest, Usage
from executive.types.outcome import MissionStatus
from executive.types.results import Failed, Scored


def test_what_was_found_out_since_it_was_saved_is_forgotten_in_every_part() -> None:
    situation = Situation.at_start("Find a mug")
    situation.search.looks.reached("desk")
    before, search = situation.saved(), situation.search
    search.looks.reached("bed")
    search.consultation.rooms.append("kitchen")
    situation.hand.unplaced["bed"] = "no room"
    situation.dialogue.inquiries = 3
    situation.restore(before)
    assert situation == before
    assert situation.search is search
    assert search.looks.visited == ["desk"]


def test_the_first_thing_that_cuts_a_mission_short_is_how_it_ends() -> None:
    situation = Situation()
    for event in (Started("Find a mug"), StopRequested("a"), Broke("oops"), StopRequested("b")):
        situation.fold(event)
    assert situation.ending.is_cut_short
    assert (situation.ending.status, situation.ending.why) == (
        MissionStatus.STOPPED,
        "stopped by a",
    )


def test_what_comes_after_the_decision_changes_nothing() -> None:
    situation = Situation()
    situation.ending.status, situation.ending.decided = MissionStatus.DONE, True
    situation.fold(StopRequested("a"))
    assert situation.ending.status == MissionStatus.DONE


def test_calls_of_the_model_are_counted_if_it_answered() -> None:
    situation = Situation()
    situation.fold(Ended(1, Failed("no answer")))
    situation.fold(Ended(2, Scored(RankRequest("", (), (), (), ()), (), Usage())))
    assert situation.model.calls == 1
