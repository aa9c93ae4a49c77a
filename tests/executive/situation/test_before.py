from executive.language.spoken import Spoken
from executive.situation import FIRST, Before, Situation


def test_what_a_recording_keeps_of_what_was_before_is_read_as_it_was() -> None:
    spoken = Spoken(("apple",), "fruit", "desk")
    before = Before(in_hand="apple", restless=True, spoken=spoken, at="desk")
    assert Before.from_metadata(before.to_metadata()) == before
    assert Before.from_metadata(FIRST.to_metadata()) == FIRST


def test_of_what_an_older_recording_does_not_tell_nothing_was_before() -> None:
    assert Before.from_metadata({}) == FIRST


def test_a_robot_that_did_not_drive_stands_where_it_stood_and_holds_what_it_held() -> None:
    before = Before(in_hand="apple", restless=True, at="desk", stands="desk")
    assert Situation.at_start("Find a mug", before).at_end(before) == before
