"""The report of a campaign: the paper's tables with our figures, tests and plots."""

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path

from executive.campaign.journal import CRASHED, Row
from executive.campaign.report import comparisons, paper, tables
from executive.campaign.report.document import (
    NO_PLOTS,
    Heading,
    Part,
    Table,
    Text,
    write_document,
)
from executive.campaign.report.variants import Variant, variants

IN_BRACKETS = "In brackets: the paper's figures."
NOT_COMPARED = (
    "The paper's figures are not beside these: they are of its own commands in its own home."
)
READING = (
    "Intervals (95 %, of the mean) are bootstrapped over the commands.",
    "Differences are tested with Wilcoxon's signed-rank test, two-sided, Holm-corrected over the "
    "pairs of systems of a situation; * p < 0.05, ** p < 0.01. By command: the mean of a command's "
    "seeds is one pair. By mission: a command with a seed is one pair, which takes repetitions of "
    "a command for independent, and so overstates what is known.",
    "A mission is completed if the robot says so and the simulator's truth agrees: it went to the "
    "furniture that it names and the thing is there (find), the thing is in its hand (take), or "
    "on the delivery table (bring). SPL is success weighted by path length (Anderson et al., "
    "2018): the shortest way on the home's grid, to the thing and on to where the command ends, "
    "as a share of the way driven; 0 for a mission that is not completed.",
)
TIME = (
    "Thinking: the seconds in which the robot only waited for the language model; what it thought "
    "while it drove or looked is not in it. The last column: how much longer that made the mission."
)
SEARCHING = (
    "Search: the seconds of going to places and looking there. Cost: the same, and for each "
    "question to the person its price, the setting question_s. Stars: the cost differs from that "
    "of the first variant in the same condition and home, by command, Holm-corrected over all "
    "variants of the condition."
)
DIFFERENCES = (
    "By how much the cost differs, command by command, each the mean of its seeds: the mean, its "
    "interval, and p as for the stars. An interval without 0 and a p below 0.05 are beyond chance."
)
TRUST = (
    "Of the belief before the first look: how likely its likeliest place was said to be, and how "
    "often that was right; the expected calibration error of that place; and the mean logarithm of "
    "how likely the true place was said to be (log score, 0 is best)."
)
COMPARED = (
    "Stars: the difference from the first variant in the same condition and home, by command, "
    "Holm-corrected over all variants of the condition. Failed visits: places that the robot set "
    "out for and could not get to. Invented names: of those that the model wrote, how many no room "
    "and no furniture goes by."
)

HEADINGS = {"inquiries": "Inquiries to the person", "visits": "Pieces of furniture visited"}
"""Headings of the measures."""

Plots = Mapping[str, Sequence[Part]]
"""The figures of each section, by its name."""


def write_report(
    rows: Sequence[Row], about: Mapping[str, str], folder: Path, as_in_paper: Collection[str]
) -> None:
    """Write `report.md` with picture files, and the self-contained `report.html`; see `report`."""
    write_document(report(rows, about, folder, as_in_paper), folder)


def report(
    rows: Sequence[Row],
    about: Mapping[str, str],
    folder: Path = Path(),
    as_in_paper: Collection[str] = (paper.HOME,),
) -> list[Part]:
    """All parts of the report.

    A crashed mission counts as not completed; all other figures leave it out. Missions whose
    language model did not work are left out of all figures; a sentence says how many they are.

    Args:
        rows: the missions that have ended; the campaign need not be complete.
        about: settings, versions and other facts, for the table at the end.
        folder: the folder of the report; links to recordings are relative to it.
        as_in_paper: the homes with the paper's conditions and commands; only their tables have the
            paper's figures, too.
    """
    without_model = [row for row in rows if row.model_failure]
    rows = [row for row in rows if not row.model_failure]
    ran = [row for row in rows if row.status != CRASHED]
    found, all_found = variants(ran, as_in_paper), variants(rows, as_in_paper)
    plots = dict(_plots(found))
    compared = any(variant.as_in_paper for variant in all_found)
    parts: list[Part] = [Heading(f"Campaign: {len(rows)} missions", 1)]
    parts += map(Text, (IN_BRACKETS if compared else NOT_COMPARED, *READING))
    if without_model:
        parts.append(Text(not_counted(without_model)))
    if not plots and ran:
        parts.append(Text(NO_PLOTS))
    parts += _measured(found, all_found, plots)
    parts += _searched(found, ran)
    parts += [Heading("Execution cost of missions that consulted the LLM"), tables.cost(found)]
    if len(found) > 1:
        parts += [Heading("Policies, homes and models compared"), Text(COMPARED)]
        parts += [comparisons.policies(found), *plots.get("policies", ())]
    failed = tables.failures(rows, folder)
    parts += [Heading("Missions not completed"), failed if failed.rows else Text("None.")]
    return [*parts, Heading("Settings"), Table(["what", "value"], list(about.items()))]


def _measured(found: Sequence[Variant], all_found: Sequence[Variant], plots: Plots) -> list[Part]:
    """The sections on what the paper measured: completion, time, inquiries and visits.

    `all_found` includes the crashed missions, `found` does not.
    """
    parts: list[Part] = [Heading("Overview"), tables.overview(found)]
    parts += [Heading("Task completion rate"), tables.completion(all_found)]
    parts += [Heading("Mission time of completed missions [s]"), tables.times(found)]
    parts += [Heading("What the time goes into"), Text(TIME), tables.time_split(found)]
    parts += plots.get("time", ())
    for title, heading in HEADINGS.items():
        parts += [Heading(heading), tables.measure(found, title), *plots.get(title, ())]
        parts.append(tables.differences(found, title))
    return [*parts, *plots.get("distributions", ())]


def _searched(found: Sequence[Variant], ran: Sequence[Row]) -> list[Part]:
    """The sections on the cost of searches and on the calibration of beliefs.

    Each is left out if no mission has such figures: earlier results have none.
    """
    parts: list[Part] = []
    if any(row.search_s for row in ran):
        parts += [Heading("What the search cost"), Text(SEARCHING), comparisons.searching(found)]
        if len(found) > 1:
            parts += [Text(DIFFERENCES), comparisons.cost_differences(found)]
    if any(row.sure for row in ran):
        parts += [Heading("Whether the belief could be trusted"), Text(TRUST)]
        parts.append(comparisons.trust(found))
    return parts


def not_counted(rows: Sequence[Row]) -> str:
    """A sentence about missions whose language model did not work."""
    why, number = Counter(row.model_failure for row in rows).most_common(1)[0]
    whose = "1 mission" if len(rows) == 1 else f"{len(rows)} missions"
    often = f", {number} times" if number < len(rows) else ""
    return (
        f"{whose} had no working language model ({why}{often}) and "
        f"{'is' if len(rows) == 1 else 'are'} not counted; run again to try them."
    )


def _plots(found: Sequence[Variant]) -> Iterator[tuple[str, Sequence[Part]]]:
    """Sections with their figures; none without matplotlib."""
    try:
        from executive.campaign.report import plots
    except ImportError:
        return
    if found:
        yield from plots.figures(found)
