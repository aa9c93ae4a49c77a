"""What a report says of how much policies differ in cost, and what thinking adds."""

from dataclasses import replace

from executive.campaign.journal import Row
from executive.campaign.report import comparisons, tables
from executive.campaign.report.variants import variants

COSTS = {("small", "paper"): 30.0, ("small", "plan"): 20.0} | {
    ("large", "paper"): 90.0,
    ("large", "plan"): 70.0,
}


def rows() -> list[Row]:
    """Eight commands in each of two homes by each of two policies."""
    return [
        Row(policy, home, "m", "okb+llm", True, 0, f"Find {number}", 0, cost_s=cost + number)
        for (home, policy), cost in COSTS.items()
        for number in range(8)
    ]


def test_each_policy_is_held_against_the_first_in_its_home() -> None:
    told = comparisons.cost_differences(variants(rows(), ())).rows
    assert [line[1:5] for line in told] == [
        ["plan, small", "paper, small", "-10.0", "-10.0 to -10.0"],
        ["plan, large", "paper, large", "-20.0", "-20.0 to -20.0"],
    ]


def test_only_the_thinking_that_was_waited_for_makes_a_mission_longer() -> None:
    waited, moving = (
        Row("plan", home, "m", "okb+llm", True, 0, "Find it", 0, mission_time_s=21.0)
        for home in ("waits", "moves")
    )
    thinks = [replace(waited, thinking_time_s=1.0)]
    thinks.append(replace(moving, thinking_time_s=1.0, thought_moving_s=1.0))
    told = {line[0]: line[-1] for line in tables.time_split(variants(thinks, ())).rows}
    assert sorted(told.values()) == ["1.000", "1.050"]


def test_stars_are_not_against_a_policy_in_another_home() -> None:
    told = {line[1]: line[5] for line in comparisons.searching(variants(rows(), ())).rows}
    assert told["paper, large"] == "93.5"
    assert told["plan, large"].startswith("73.5 *")
