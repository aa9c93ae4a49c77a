"""`python -m executive.page study`: its options, and what each of them does."""

import argparse
import sys
from pathlib import Path
from typing import Any

from executive.errors import InputError
from executive.page.address import PORT, add_page, address_of
from executive.page.study.data import StudyData, code_of, number_of
from executive.page.study.file import Study, read_study, settings_of
from executive.page.study.order import rows
from executive.page.study.steps import order
from executive.page.study.tables import renew_tables
from executive.page.study.withdrawal import withdraw
from executive.shell import DONE, NOT_DONE, all_is_kept, on_stop_signals, stops_in_order
from executive.text import counted, printable


def add_to(commands: Any) -> None:
    """Add the command to a parser's."""
    p = commands.add_parser(
        "study",
        help="lead a participant through a study, in the browser",
        description="Lead a participant through a study, in the browser (docs/study.md).",
        epilog="exit: 0 the participant has come to the end, 1 takes no part (or, withdrawn, was "
        "found somewhere), 2 bad usage or input, 130 stopped: --participant goes on",
    )
    p.add_argument("file", type=Path, metavar="FILE.toml", help="what the study is")
    p.add_argument(
        "--data", type=Path, metavar="DIR", help="where its data lie (default: studies/FILE)"
    )
    what = p.add_mutually_exclusive_group()
    what.add_argument(
        "--participant", metavar="P07", help="who (default: the lowest number that is free)"
    )
    what.add_argument("--check", action="store_true", help="read the file, tell the orders")
    what.add_argument("--report", action="store_true", help="write what came of it so far")
    what.add_argument("--withdraw", metavar="P07", help="erase a participant, and search for them")
    add_page(p)
    p.set_defaults(run=run, page=PORT)


def run(options: argparse.Namespace) -> int:
    """Do what the options say; the exit code."""
    given = vars(options)
    study = read_study(options.file)
    address = address_of(given)
    if not (options.report or options.withdraw):
        try_conditions(study, str(options.file))
    if options.check:
        return check(study)
    folder = options.data or Path("studies") / options.file.stem
    if (options.report or options.withdraw) and not folder.exists():
        right = "lead a participant first, or name the folder of this study"
        raise InputError(f"--data {folder}", "there is no such folder", right)
    data = StudyData(folder, study)
    if options.withdraw:
        return erase(data, options.withdraw)
    if options.report:
        from executive.page.study.report import write_report  # heavy

        print(printable(write_report(data)))
        return DONE
    return lead(data, options.participant or next_of(data), address)


def check(study: Study) -> int:
    """Tell in which order participants meet the conditions."""
    many = len(rows(len(study.conditions))) if study.order == "balanced" else 1
    print(f"{printable(study.title)}: {counted(len(study.conditions), 'condition')}, ", end="")
    print(f"{counted(len(study.tasks), 'task')} in each")
    for number in range(1, many + 1):
        names = ", ".join(condition.name for condition in order(study, number))
        print(f"  {code_of(number)}, {code_of(number + many)}, ...: {names}")
    return DONE


def try_conditions(study: Study, where: str) -> None:
    """Read what the conditions' settings name, before anyone sits down.

    Raises:
        InputError: if a file is not there, or something in it is wrong.
    """
    with all_is_kept():
        from executive.app.building import try_files  # heavy
    for condition in study.conditions:
        try:
            try_files(settings_of(study, condition, where))
        except InputError as error:
            which, what, right = error.args
            inside = f"{where}: settings of condition {condition.name!r}"
            raise InputError(f"{inside}: {which}", what, right) from None


def erase(data: StudyData, code: str) -> int:
    """Erase a participant, and tell what a search came to."""
    done = withdraw(data, code)
    print(f"{code} is erased: {counted(done.files, 'file')}, {done.size:,} bytes.")
    if not done.found:
        print(f"Searched {counted(done.searched, 'file')} that are left: nothing of {code} in any.")
        return DONE
    print(f"Something of {code} is still in {counted(len(done.found), 'file')}; see to it:")
    for path in done.found:
        print(f"  {printable(path)}")
    return NOT_DONE


def next_of(data: StudyData) -> str:
    """Who comes next.

    Raises:
        InputError: if someone has begun and not come to the end.
    """
    code, unfinished = data.next(), data.unfinished()
    if unfinished:
        what = f"{', '.join(unfinished)} {'have' if unfinished[1:] else 'has'} not come to the end"
        right = f"go on with --participant {unfinished[0]}, or begin with --participant {code}"
        raise InputError(f"--data {data.folder}", what, right)
    return code


def lead(data: StudyData, code: str, address: Any) -> int:
    """Lead a participant to the end."""
    number_of(code)
    with all_is_kept():
        from executive.page.study.leading import Leader  # heavy
        from executive.page.study.page import StudyPage
    with (
        data.one(code) as journal,
        data.if_only_begun(journal),
        StudyPage(address, speech=data.study.speech) as page,
    ):
        if any(entry["kind"] == "finished" for entry in journal.entries()):
            right = f"the next one is {data.next()}"
            raise InputError("--participant", f"{code} has come to the end", right)
        leader = Leader(data, journal, page)
        stopping = f"Stopping. Go on with --participant {code}."
        print(f"{code}: open {page.url}", file=sys.stderr, flush=True)
        if page.experimenter_url:
            print(f"Experimenter: {page.experimenter_url}", file=sys.stderr, flush=True)
        try:
            with on_stop_signals(stops_in_order(leader.interrupt, stopping)):
                took_part = leader.lead()
        finally:
            renew_tables(data)
    if not took_part:
        renew_tables(data)
        print(f"{code} takes no part; nothing was kept.", file=sys.stderr)
        return NOT_DONE
    print(f"{code} has come to the end.", file=sys.stderr)
    return DONE
