"""Groups the missions of a campaign: by policy, home and model, by condition, and by command."""

from collections.abc import Callable, Collection, Hashable, Iterable, Sequence
from dataclasses import dataclass
from statistics import fmean

from executive.campaign.journal import Row
from executive.campaign.report.paper import Condition
from executive.campaign.report.statistics import Summary, grouped, summarize
from executive.config import KnowledgeSystem
from executive.types.commands import CommandKind

OKB = KnowledgeSystem.OKB
Column = Callable[[Row], float]


@dataclass(frozen=True, slots=True)
class Variant:
    """The missions of one policy in one home with one model.

    Attributes:
        name: those of policy, home and model that vary in the campaign; empty if none does.
        rows: its missions, and those of okb in the same home.
        own: the same, but without those of okb if an earlier variant of this home has them.
        as_in_paper: whether home and commands are those of the paper.
    """

    name: str
    rows: Sequence[Row]
    own: Sequence[Row]
    as_in_paper: bool = True


def variants(rows: Sequence[Row], as_in_paper: Collection[str]) -> list[Variant]:
    """The variants among these missions, in the order of the rows.

    The system okb asks no model, so its missions belong to every variant of their home.

    Args:
        rows: the missions of a campaign.
        as_in_paper: the homes with the paper's conditions and commands.
    """
    asking = [row for row in rows if row.key.system != OKB] or rows
    which = list(dict.fromkeys((row.policy, row.home, row.llm) for row in asking))
    differs = [len({one[part] for one in which} - {"none"}) > 1 for part in range(3)]
    found, homes = list[Variant](), set[str]()
    for one in which:
        own = [row for row in asking if (row.policy, row.home, row.llm) == one]
        shared = [] if own[0].key.system == OKB else _of_okb(rows, home=one[1])
        name = ", ".join(part for part, shown in zip(one, differs, strict=True) if shown)
        all_of_it = [*shared, *own]
        mine = own if one[1] in homes else all_of_it
        found.append(Variant(name, all_of_it, mine, one[1] in as_in_paper))
        homes.add(one[1])
    return found


def _of_okb(rows: Iterable[Row], home: str) -> list[Row]:
    return [row for row in rows if row.key.system == OKB and row.home == home]


def select(rows: Iterable[Row], condition: Condition, kind: CommandKind | None = None) -> list[Row]:
    """The missions of a condition, of one kind of command or (None) of all."""
    return [
        row
        for row in rows
        if (row.key.system, row.defaults) == condition and kind in (None, row.kind)
    ]


def summary_of(rows: Iterable[Row], column: Column) -> Summary | None:
    """The column's summary, with the interval over the commands; None without missions."""
    return summarize(grouped((row.command, column(row)) for row in rows))


def by_command(rows: Iterable[Row], column: Column) -> dict[Hashable, float]:
    """For each command, the mean over its missions."""
    return _by(rows, column, lambda row: row.command)


def by_mission(rows: Iterable[Row], column: Column) -> dict[Hashable, float]:
    """For each command and seed, the value of its mission."""
    return _by(rows, column, lambda row: (row.command, row.seed))


def _by(
    rows: Iterable[Row], column: Column, unit: Callable[[Row], Hashable]
) -> dict[Hashable, float]:
    values: dict[Hashable, list[float]] = {}
    for row in rows:
        values.setdefault(unit(row), []).append(column(row))
    return {key: fmean(several) for key, several in values.items()}
