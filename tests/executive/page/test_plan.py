"""The home as the page draws it."""

from executive.language.wording import Wording
from executive.page.plan import plan
from executive.testing.bench import four_rooms, ontology


def test_furniture_is_called_as_the_robot_calls_it() -> None:
    drawn = plan(four_rooms(), Wording(ontology(True).called))
    called = {piece["name"]: (piece["label"], piece["words"]) for piece in drawn["furniture"]}
    assert called["cabinet_kitchen"] == ("cabinet in the kitchen", "cabinet")
    assert called["high_table"] == ("high table", "high table")
