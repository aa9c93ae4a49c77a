"""The experimenter's page in a real browser."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from browsing import DESKTOP, PHONE, opened, say, wait_until_ready
from paging import Robot, heard, robot, step_in
from playwright.sync_api import Browser, Locator, Route, expect
from playwright.sync_api import Page as Tab

pytestmark = pytest.mark.browser

RULES = {
    "runOnly": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"],
    "resultTypes": ["violations"],
}
HOSTILE = "<img src=x onerror=alert(1)> mug"


@pytest.fixture(scope="module")
def busy(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Robot]:
    """A robot that has found something, was told nonsense, and now waits for an answer."""
    with robot(tmp_path_factory.mktemp("runs"), recorded=True, experimenter=True) as made:
        page = made.page
        heard(page, "doing", state="ready")
        page.says("Find the peach")
        heard(page, "question", kind="where_is")
        page.says("high_table")
        made.ended(1)
        page.says(HOSTILE)
        made.ended(2)
        page.says("Find a fruit")
        heard(page, "question", kind="which_object")
        yield made


@contextmanager
def desk(browser: Browser, robot: Robot, **given: object) -> Iterator[Tab]:
    with opened(browser, robot.page, robot.page.experimenter_url, **given) as tab:
        yield tab


def row(tab: Tab, name: str) -> Locator:
    rows = tab.locator("section:visible [role=treeitem]")
    return rows.filter(has=tab.get_by_text(name, exact=True)).first


def open_past(tab: Tab, words: str) -> None:
    tab.get_by_role("button", name="Past runs").click()
    tab.get_by_label("Words", exact=True).fill(words)
    expect(tab.locator("#runs tbody tr")).to_have_count(1)
    tab.locator("#runs th button").click()
    expect(tab.locator("#one .moment")).to_contain_text("Tick 0 of")


def test_the_branch_at_work_is_shown_and_why(browser: Browser, busy: Robot) -> None:
    with desk(browser, busy) as tab:
        asking = row(tab, "ask which object")
        expect(asking).to_have_attribute("data-status", "RUNNING")
        row(tab, "which object").click()
        why = tab.locator("#live .why")
        expect(why).to_contain_text("It waits for “ask” in it.")
        expect(why.locator(".because li").last).to_contain_text("ask which object running")


def test_what_happens_is_followed_until_one_looks_back(browser: Browser, busy: Robot) -> None:
    with desk(browser, busy) as tab:
        expect(tab.locator("#live .moment")).to_have_attribute("data-step", "0")
        busy.page.says("banana")
        heard(busy.page, "question", kind="where_is")
        expect(tab.locator("#live .moment")).to_have_attribute("data-step", "1")
        expect(tab.locator("#live .strip .mark-said")).to_have_attribute("d", re.compile("M1 "))
        tab.locator("#live").get_by_role("button", name="Tick before").click()
        expect(tab.locator("#live .moment")).to_have_attribute("data-step", "0")
        expect(tab.locator("#live").get_by_label("Follow what happens")).not_to_be_checked()
        busy.page.says("Where are you?")
        heard(busy.page, "said", who="robot")
        tab.wait_for_timeout(500)
        expect(tab.locator("#live .moment")).to_have_attribute("data-step", "0")


def test_a_past_run_is_found_and_gone_through_by_the_keyboard(
    browser: Browser, busy: Robot
) -> None:
    with desk(browser, busy) as tab:
        open_past(tab, "peach done")
        slider = tab.locator("#one input[type=range]")
        slider.focus()
        tab.keyboard.press("End")
        expect(row(tab, "mission")).to_have_attribute("data-status", "SUCCESS")
        expect(tab.locator("#one .lines li").last).to_contain_text("done: The peach is on")
        tab.keyboard.press("Home")
        expect(row(tab, "mission")).to_have_attribute("data-status", "RUNNING")
        row(tab, "mission").focus()
        for key in ("ArrowDown", "ArrowDown", "Enter"):
            tab.keyboard.press(key)
        expect(tab.locator("#one [aria-selected=true]")).to_have_count(1)


def test_what_is_looked_at_outlives_loading_and_one_goes_back(
    browser: Browser, busy: Robot
) -> None:
    with desk(browser, busy) as tab:
        open_past(tab, "peach done")
        title = tab.locator("#one-title").inner_text()
        tab.reload()
        expect(tab.locator("#one-title")).to_have_text(title)
        expect(tab.locator("#one .moment")).to_contain_text("Tick 0 of")
        tab.go_back()
        expect(tab.locator("#runs tbody tr").first).to_be_visible()
        tab.go_back()
        expect(tab.locator("#live")).to_be_visible()


def test_on_a_phone_it_is_read_in_lines_that_no_run_was_found(
    browser: Browser, busy: Robot
) -> None:
    with desk(browser, busy, viewport=PHONE) as tab:
        tab.get_by_role("button", name="Past runs").click()
        tab.get_by_label("Words", exact=True).fill("nothing of the kind")
        told = tab.locator("#runs caption")
        expect(told).to_contain_text("None of them")
        assert (told.bounding_box() or {})["width"] > PHONE["width"] / 2


def test_a_list_that_was_asked_for_before_is_not_shown_later(browser: Browser, busy: Robot) -> None:
    late: list[Route] = []
    with desk(browser, busy) as tab:
        tab.route(
            "**/experiment/runs*", lambda route: route.continue_() if late else late.append(route)
        )
        tab.get_by_role("button", name="Past runs").click()
        tab.get_by_label("Words", exact=True).fill("peach done")
        expect(tab.locator("#runs tbody tr")).to_have_count(1)
        with tab.expect_response("**/experiment/runs*"):
            late[0].continue_()
        tab.wait_for_timeout(200)
        assert tab.locator("#runs tbody tr").count() == 1


def test_a_run_is_held_against_todays_tree(browser: Browser, busy: Robot) -> None:
    with desk(browser, busy) as tab:
        open_past(tab, "peach done")
        tab.get_by_role("button", name="Against today's tree").click()
        expect(tab.locator("#deed")).to_have_text("Today's tree decides the same.")
        expect(tab.locator("#told")).to_contain_text("ticks as recorded")


def test_two_runs_stand_side_by_side_where_they_part(browser: Browser, busy: Robot) -> None:
    with desk(browser, busy) as tab:
        tab.get_by_role("button", name="Past runs").click()
        expect(tab.locator("#runs tbody tr")).to_have_count(3)
        for box in tab.locator("#runs input").all()[1:]:
            box.check()
        tab.get_by_role("button", name="Two side by side").click()
        expect(tab.locator("#parting")).to_contain_text("They part at tick 0")
        expect(tab.locator("#two .moment").first).to_contain_text("Tick 0 of")
        expect(tab.locator("#two .moment").last).to_contain_text("Tick 0 of")
        for status in tab.locator("#parting tr:has(button) td").all_inner_texts():
            assert status.startswith(("succeeded", "failed", "running", "not at work"))
        for differs in tab.locator("#parting th button").all()[:2]:
            differs.click()
            chosen = tab.locator("#two [aria-selected=true]")
            expect(chosen.locator(".name")).to_have_text([differs.inner_text()] * 2)
            for side in chosen.all():
                expect(side).to_be_in_viewport()
        assert not faults(tab)


def test_a_call_of_the_model_has_a_heading_of_its_own(browser: Browser, busy: Robot) -> None:
    line = {"step": 0, "time_s": 0.0, "kind": "model", "text": "rank (0.1 s)", "call": 0}
    call = {"label": "rank", "messages": [["user", "Where?"]], "answer": "", "scores": []}
    usage = {"model": "small", "seconds": 0.1, "tokens_in": 3, "tokens_out": 0}
    with desk(browser, busy) as tab:
        tab.route("**/experiment/lines*", lambda route: route.fulfill(json=[line]))
        tab.route("**/experiment/call*", lambda route: route.fulfill(json={**call, **usage}))
        row(tab, "which object").click()
        panel, chosen = tab.locator("#live .of-why"), tab.locator("#live [aria-selected=true]")
        expect(panel).to_contain_text("which object")
        tab.get_by_role("button", name="Show", exact=True).click()
        expect(panel.locator("pre")).to_have_text("Where?")
        expect(panel.locator("h3")).to_have_text("Call of the model")
        expect(panel.get_by_role("region", name="Call of the model")).to_be_visible()
        expect(chosen).to_have_count(0)
        row(tab, "which object").click()
        expect(panel.locator("h3")).to_have_text("Why")
        expect(chosen).to_have_count(1)


def test_hostile_words_are_words(browser: Browser, busy: Robot) -> None:
    with desk(browser, busy) as tab:
        open_past(tab, "onerror")
        expect(tab.locator("#one .lines")).to_contain_text("<img src=x")
        assert tab.locator("main img").count() == 0


@pytest.mark.parametrize("colors", ["light", "dark"])
@pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_axe_finds_no_fault(
    browser: Browser, busy: Robot, size: dict[str, int], colors: str
) -> None:
    with desk(browser, busy, viewport=size, color_scheme=colors) as tab:
        row(tab, "mission").click()
        assert not faults(tab)
        open_past(tab, "peach done")
        assert not faults(tab)
        tab.get_by_role("button", name="Past runs").click()
        assert not faults(tab)
        assert tab.evaluate("document.documentElement.scrollWidth") <= size["width"]


def faults(tab: Tab) -> list[str]:
    response = Axe().run(tab, options=RULES).response
    return [
        f"{fault['id']}: {node['html'][:160]} {node.get('failureSummary', '')[:300]}"
        for fault in response["violations"]
        for node in fault["nodes"]
    ]


def test_an_experimenter_steps_in(browser: Browser, tmp_path: Path) -> None:
    with robot(tmp_path, recorded=True, experimenter=True) as made, desk(browser, made) as tab:
        heard(made.page, "doing", state="ready")
        panel = tab.locator("#wizard")
        panel.get_by_label("Your name").fill("Anna")
        panel.get_by_label("Hold what the robot says").click()
        expect(panel.get_by_label("Hold what the robot says")).to_be_checked()
        made.page.says("Find the peach")
        sentence = panel.get_by_label("Held sentence 1")
        expect(sentence).to_have_value("Where is the peach?")
        assert not faults(tab)
        sentence.fill("Where may it be?")
        panel.get_by_role("button", name="Say it", exact=True).click()
        assert heard(made.page, "said", who="robot")["text"] == "Where may it be?"
        panel.get_by_label("Hold what the robot says").click()
        panel.get_by_label("Answer for the person").fill("on the high table")
        panel.get_by_role("button", name="Send", exact=True).click()
        made.ended(1)
        expect(tab.locator("#live .lines .of-intervened").last).to_contain_text(
            "Anna: answered 'Where is the peach?': on the high table"
        )


def test_an_experimenter_holds_where_it_goes(browser: Browser, tmp_path: Path) -> None:
    with robot(tmp_path, recorded=True, experimenter=True) as made, desk(browser, made) as tab:
        heard(made.page, "doing", state="ready")
        panel = tab.locator("#wizard")
        panel.get_by_label("Your name").fill("Anna")
        panel.get_by_label("Hold where it goes next").click()
        expect(panel.get_by_label("Hold where it goes next")).to_be_checked()
        made.page.says("Find the peach at the sofa")
        expect(panel.locator(".choice")).to_contain_text("It would look next: sofa.")
        assert not faults(tab)
        panel.get_by_label("Instead").select_option("high table")
        panel.get_by_role("button", name="Send there instead").click()
        assert made.ended(1).visited == ("high_table",)
        expect(panel.locator(".choice")).to_be_hidden()
        expect(tab.locator("#live .lines .of-intervened").last).to_contain_text(
            "Anna: to high_table, not sofa"
        )


def test_a_box_changes_once_when_it_is_pressed(browser: Browser, tmp_path: Path) -> None:
    follow = """() => {
        const box = document.querySelector("#wizard input[type=checkbox]");
        window.seen = [box.checked];
        const look = () => {
            if (window.seen.at(-1) !== box.checked) window.seen.push(box.checked);
            requestAnimationFrame(look);
        };
        look();
    }"""
    with robot(tmp_path, experimenter=True) as made, desk(browser, made) as tab:
        heard(made.page, "doing", state="ready")
        board = made.page.desk.board if made.page.desk else pytest.fail("no desk")

        def meanwhile(route: Route) -> None:
            """What was on its way to the page when the box was pressed."""
            board.put("words", {"holds": False, "held": [{"number": 9, "text": "before"}]})
            board.flush()
            expect(panel.get_by_label("Held sentence 9")).to_be_visible()
            tab.wait_for_timeout(100)
            route.continue_()

        panel = tab.locator("#wizard")
        tab.route("**/experiment/intervene*", meanwhile)
        tab.evaluate(follow)
        panel.get_by_label("Hold what the robot says").click()
        expect(panel.get_by_label("Hold what the robot says")).to_be_checked()
        assert tab.evaluate("window.seen") == [False, True]


def test_the_person_reads_that_the_experimenter_pressed_stop(
    browser: Browser, tmp_path: Path
) -> None:
    with robot(tmp_path, experimenter=True) as made, opened(browser, made.page) as tab:
        wait_until_ready(tab)
        say(tab, "Find a fruit")
        heard(made.page, "question", kind="which_object")
        step_in(made.page, "stop")
        stop = tab.locator("#said .stopped > p")
        expect(stop).to_have_text("Experimenter: The experimenter pressed Stop")
        tab.keyboard.press("Escape")
        expect(stop.last).to_have_text("You: Stop")
