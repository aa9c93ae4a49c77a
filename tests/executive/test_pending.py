from executive.pending import Pending
from executive.types.results import Failed, Succeeded


def test_two_behaviours_of_one_name_wait_each_for_its_own() -> None:
    pending = Pending()
    pending.wait_until(5.0, 1, "drive")
    pending.wait_until(3.0, 2, "drive")
    pending.wait_no_more(2)
    assert pending.next_deadline == 5.0


def test_nothing_is_due_where_nobody_waits() -> None:
    assert Pending().next_deadline is None


def test_an_end_is_read_once_by_who_waits_for_it() -> None:
    pending = Pending()
    pending.end(1, Succeeded())
    pending.end(2, Failed("no way"))
    assert pending.take_end(2) == Failed("no way")
    assert pending.take_end(2) is None
    assert pending.take_end(1) == Succeeded()


def test_the_log_shows_who_waits_until_when() -> None:
    pending = Pending()
    pending.wait_until(5.0, 1, "drive")
    assert pending.deadlines() == {"drive": 5.0}
