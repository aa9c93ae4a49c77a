"""The page in a real browser, as a person uses it."""

import random
import re
from itertools import combinations
from pathlib import Path

import pytest
from browsing import DESKTOP, PHONE, answer, opened, said, say, wait_until_ready
from paging import TOKEN, Robot, heard, page_alone, robot
from playwright.sync_api import Browser, Route, expect

from executive.events import Inbox
from executive.page.address import Address
from executive.page.page import Page
from executive.records import NodeShape, NodeState, Tick, TreeShape
from executive.testing.bench import run_mission
from logs.recorder import Stamp

pytestmark = pytest.mark.browser

BROUGHT = "Here is the peach from the high table."


def test_a_whole_mission_by_the_page(browser: Browser, talking: Robot) -> None:
    with opened(browser, talking.page) as tab:
        wait_until_ready(tab)
        say(tab, "Bring a fruit")
        answer(tab, "peach").click()
        answer(tab, "sofa").click()
        answer(tab, "high table").click()
        wait_until_ready(tab)
        expect(tab.locator("#last")).to_have_text("Last time: done.")
        assert said(tab)[-1].endswith(BROUGHT)
        expect(tab.locator("#places caption")).to_have_text("Where I found the peach")
        expect(tab.locator("#places tr.found")).to_contain_text("high table")
        expect(tab.locator("#places tr.empty")).to_contain_text("sofa")
    assert [outcome.status for outcome in talking.outcomes] == ["done"]


def test_what_was_chosen_from_is_gone_at_once_and_two_taps_are_one(
    browser: Browser, talking: Robot
) -> None:
    with opened(browser, talking.page) as tab:
        wait_until_ready(tab)
        say(tab, "Find a fruit")
        answer(tab, "peach").evaluate(
            "button => { button.click(); window.left = answers.children.length; }"
        )
        assert tab.evaluate("window.left") == 0
        expect(answer(tab, "high table")).to_be_visible()
        answer(tab, "sofa").dblclick()
        expect(tab.locator("#said .person", has_text="sofa")).to_have_count(1)


def test_a_choice_that_came_too_late_is_told(browser: Browser, talking: Robot) -> None:
    def meanwhile(route: Route) -> None:
        """On another page they were faster."""
        talking.page.says("peach")
        heard(talking.page, "question", kind="where_is")
        route.continue_()

    with opened(browser, talking.page) as tab:
        wait_until_ready(tab)
        say(tab, "Find a fruit")
        expect(answer(tab, "banana")).to_be_visible()
        tab.route("**/say*", meanwhile)
        answer(tab, "banana").click()
        expect(tab.get_by_role("alert")).to_contain_text("came when its question was over")
        expect(answer(tab, "high table")).to_be_visible()


def test_things_to_choose_from_are_shown_in_pictures(browser: Browser, talking: Robot) -> None:
    with opened(browser, talking.page) as tab:
        wait_until_ready(tab)
        say(tab, "Bring a fruit")
        pictures = tab.locator("#answers img")
        expect(pictures).to_have_count(6)
        for picture in pictures.all():
            expect(picture).to_have_js_property("complete", True)
            expect(picture).to_have_js_property("naturalWidth", 160)


def test_a_place_may_be_chosen_on_the_map(browser: Browser, talking: Robot) -> None:
    with opened(browser, talking.page) as tab:
        wait_until_ready(tab)
        say(tab, "Find the peach")
        tab.locator("#map .choice", has_text="high table").locator("rect").click()
        expect(tab.locator("#last")).to_have_text("Last time: done.")
        expect(tab.locator("#said .person > p").last).to_have_text("You: high table")
    assert talking.outcomes[0].location == "high_table"


def test_the_header_counts_the_places_of_the_table(browser: Browser) -> None:
    chances = {"desk": 0.5, "sofa": 0.3, "bed": 0.1, "shelf": 0.05, "cabinet": 0.04}
    candidates = [{"place": place, "source": "llm"} for place in ("sofa", "bed")]
    places = [{"place": place, "probability": chance} for place, chance in chances.items()]
    situation = {
        "object": "mug",
        "candidate": candidates[0],
        "candidates": candidates,
        "visited": ["desk"],
        "belief": {"places": places},
    }
    node = NodeShape("search", "", "search", "sequence", "Search", activity="searching")
    tick = Tick(3, "Saw", "search", (NodeState("search", "RUNNING"),), situation, 0.001)
    with page_alone() as page, opened(browser, page) as tab:
        for record in (TreeShape((node,)), tick):
            page.sink.write(Stamp(1.0, 0), record)
        page.sink.flush()
        expect(tab.locator("#progress")).to_have_text("Place 2 of 5")
        expect(tab.locator("#places tbody tr")).to_have_count(5)


def test_where_things_are_counted_no_one_thing_is_looked_for(browser: Browser) -> None:
    records = run_mission("How many fruits are on the desk?", llm=False).notebook.records
    with page_alone() as page, opened(browser, page) as tab:
        told: list[str] = []
        for record in records:
            page.sink.write(Stamp(1.0, 0), record)
            if isinstance(record, Tick):
                page.sink.flush()
                tab.wait_for_timeout(20)
                told.append(tab.locator("#doing").inner_text())
        assert "I am on my way to the desk to have a look." in told
        assert "I am having a look: desk." in told
        expect(tab.locator("#places caption")).to_have_text("Places on my way")
        expect(tab.locator("#places tbody th")).to_have_text("• desk" + "been there")


def test_why_is_told_beside_the_sentence(browser: Browser, talking: Robot) -> None:
    with opened(browser, talking.page) as tab:
        wait_until_ready(tab)
        say(tab, "Find the peach")
        answer(tab, "high table").click()
        wait_until_ready(tab)
        why = tab.get_by_role("button", name=re.compile("^Why did the robot say: I look for"))
        why.click()
        because = tab.locator(".because")
        expect(because).to_contain_text("which places: high table (you said so)")
        why.press("Enter")
        expect(because).to_have_count(0)


def test_why_is_told_in_the_persons_words(browser: Browser, tmp_path: Path) -> None:
    planning = robot(tmp_path, recorded=True, search="plan", place={"sugar_box": "high_table"})
    with planning as talking, opened(browser, talking.page) as tab:
        wait_until_ready(tab)
        say(tab, "Find the sugar_box")
        talking.ended(1)
        tab.get_by_role("button", name=re.compile("^Why did the robot say: I look for")).click()
        because = tab.locator(".because")
        expect(because).to_contain_text("I look at high table 32\u00a0% (known of homes): asking")
        expect(because).to_contain_text("not “counter wagon”: 32\u00a0% (known of homes), 9 s away")
        expect(because).not_to_contain_text(re.compile(r"ontology|anywhere|\d\.\d\d"))


@pytest.mark.parametrize(
    ("noted", "told"),
    [
        (
            "0.51 (ontology 0.49, llm 0.02), 9 s away",
            "51 % (known of homes 49 %, language model 2 %), 9 s away",
        ),
        ("0.41 (my_shelf 0.40, anywhere 0.00)", "41 % (my shelf)"),
        ("cabinet_kitchen 0.20, sugar_box", "cabinet in the kitchen 20 %, sugar box"),
        ("desk 0.62, sofa 0.00", "desk 62 %, sofa < 1 %"),
        (
            "llm ranks places: the ontology has 3 places for it",
            "the language model ranks places: my knowledge of homes has 3 places for it",
        ),
        ("noise=0.25, and 0.45 m too high", "noise=0.25, and 0.45 m too high"),
    ],
)
def test_what_was_not_taken_is_told_in_the_persons_words(
    browser: Browser, talking: Robot, noted: str, told: str
) -> None:
    because = {
        "question": "which",
        "answer": "",
        "alternatives": [{"what": "it", "why_not": noted}],
    }
    with opened(browser, talking.page) as tab:
        tab.route("**/why*", lambda route: route.fulfill(json=[because]))
        wait_until_ready(tab)
        say(tab, "Find the peach")
        tab.get_by_role("button", name=re.compile("^Why did the robot say")).first.click()
        expect(tab.locator(".because li li")).to_have_text(f"not “it”: {told}")


def test_by_the_keyboard_alone(browser: Browser, talking: Robot) -> None:
    with opened(browser, talking.page) as tab:
        wait_until_ready(tab)
        tab.keyboard.press("Tab")
        tab.keyboard.press("Enter")  # skip to what you say
        tab.keyboard.type("Bring a fruit")
        tab.keyboard.press("Enter")
        expect(answer(tab, "peach")).to_be_visible()
        while tab.locator(":focus").inner_text() != "peach":
            tab.keyboard.press("Shift+Tab")
        tab.keyboard.press("Space")
        expect(answer(tab, "sofa")).to_be_visible()
        expect(tab.locator("#words")).to_be_focused()
        tab.keyboard.type("on the high table")
        tab.keyboard.press("Enter")
        wait_until_ready(tab)
        assert said(tab)[-1].endswith(BROUGHT)


@pytest.mark.parametrize("how", ["Escape", "button"])
def test_a_question_is_stopped_as_well(browser: Browser, talking: Robot, how: str) -> None:
    with opened(browser, talking.page) as tab:
        wait_until_ready(tab)
        say(tab, "Bring a fruit")
        expect(answer(tab, "peach")).to_be_visible()
        if how == "button":
            tab.get_by_role("button", name="Stop").click()
        else:
            tab.keyboard.press(how)
        expect(tab.locator("#last")).to_have_text("Last time: stopped by the person.")
        expect(tab.locator("#answers")).to_be_hidden()


def test_it_is_stopped_at_any_moment(
    browser: Browser, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sim.fake.SPEED_M_S", 0.1)  # not there before a busy machine says stop
    chance = random.Random(0)
    with (
        robot(tmp_path, world="paging:in_real_time") as made,
        opened(browser, made.page) as tab,
    ):
        for number in range(1, 7):
            wait_until_ready(tab)
            say(tab, "Find the sugar_box at the sofa" if number % 2 else "Bring a fruit")
            tab.wait_for_timeout(chance.uniform(0, 600))
            tab.keyboard.press("Escape")
            expect(tab.locator("#said .stopped")).to_have_count(number)
            answered = tab.locator("#said .robot", has_text=re.compile("Stopping|nothing to stop"))
            expect(answered).to_have_count(number)
        wait_until_ready(tab)
        assert {outcome.status for outcome in made.outcomes} == {"stopped"}


def test_two_pages_show_the_same(browser: Browser, talking: Robot) -> None:
    with opened(browser, talking.page) as one, opened(browser, talking.page) as other:
        wait_until_ready(one)
        say(one, "Find a fruit")
        answer(other, "peach").click()
        answer(one, "high table").click()
        for tab in (one, other):
            wait_until_ready(tab)
            expect(tab.locator("#answers")).to_be_hidden()
        assert said(one) == said(other)
        assert len(said(one)) > 5
        with opened(browser, talking.page) as late:
            wait_until_ready(late)
            assert said(late) == said(one)


def test_a_page_that_is_closed_and_opened_again_goes_on(browser: Browser, talking: Robot) -> None:
    with opened(browser, talking.page) as tab:
        wait_until_ready(tab)
        say(tab, "Find a fruit")
        expect(answer(tab, "peach")).to_be_visible()
        tab.close()
    with opened(browser, talking.page) as tab:
        answer(tab, "peach").click()
        answer(tab, "high table").click()
        wait_until_ready(tab)
    assert [outcome.status for outcome in talking.outcomes] == ["done"]


def test_the_end_of_the_conversation_stays_in_sight(browser: Browser, talking: Robot) -> None:
    with opened(browser, talking.page, viewport=PHONE) as tab:
        wait_until_ready(tab)
        say(tab, "Bring a fruit")
        for label in ("peach", "sofa", "high table"):
            answer(tab, label).click()
        expect(tab.locator("#last")).to_have_text("Last time: done.")
        expect(tab.locator("#said > li").last).to_contain_text("Here is the peach")
        expect(tab.locator("#said > li").last).to_be_in_viewport(ratio=0.95)


@pytest.mark.parametrize("size", [PHONE, DESKTOP], ids=["phone", "desk"])
def test_a_long_conversation_does_not_lengthen_the_page(
    browser: Browser, size: dict[str, int]
) -> None:
    with page_alone() as page, opened(browser, page, viewport=size) as tab:
        for number in range(40):
            who = ("robot", "person")[number % 2]
            page.board.say({"who": who, "text": f"Sentence {number}", "at": 0.0})
        expect(tab.locator("#said > li")).to_have_count(40)
        assert tab.evaluate("document.documentElement.scrollHeight") == size["height"]


def test_a_choice_that_was_lost_on_the_way_is_told_until_its_question_is_over(
    browser: Browser, talking: Robot
) -> None:
    with opened(browser, talking.page) as tab:
        wait_until_ready(tab)
        say(tab, "Find a fruit")
        expect(answer(tab, "peach")).to_be_visible()
        tab.route("**/say*", lambda route: route.abort())
        answer(tab, "peach").click()
        expect(tab.get_by_role("alert")).to_have_text(
            "Your answer could not be sent: choose again."
        )
        expect(answer(tab, "peach")).to_be_visible()
        talking.page.says("banana")
        expect(tab.get_by_role("alert")).to_be_hidden()


def test_the_browsers_buttons_go_between_what_is_shown_on_a_phone(
    browser: Browser, talking: Robot
) -> None:
    with opened(browser, talking.page, viewport=PHONE) as tab:
        wait_until_ready(tab)
        say(tab, "Find a fruit")
        tab.get_by_role("button", name="Home and camera").click()
        expect(tab.locator("#map")).to_be_visible()
        tab.reload()
        expect(tab.locator("#map")).to_be_visible()
        tab.go_back()
        expect(answer(tab, "peach")).to_be_visible()
        expect(tab.locator("#map")).to_be_hidden()


def test_texts_that_are_lost_on_the_way_are_asked_for_again(
    browser: Browser, talking: Robot
) -> None:
    lost: list[str] = []

    def lose_once(route: Route) -> None:
        if lost:
            route.continue_()
        else:
            lost.append(route.request.url)
            route.abort()

    with opened(browser, talking.page) as tab:
        tab.route("**/english.json", lose_once)
        tab.reload()
        wait_until_ready(tab)
    assert lost


def test_a_connection_that_falls_silent_is_told_and_made_again(
    browser: Browser, talking: Robot
) -> None:
    with opened(browser, talking.page) as tab:
        wait_until_ready(tab)
        tab.clock.install()
        tab.route("**/events*", lambda route: None)  # never answered
        tab.reload()
        expect(tab.locator("#words")).to_have_attribute("placeholder", "Bring the mug")
        tab.clock.fast_forward(60_000)
        expect(tab.get_by_role("alert")).to_contain_text("No connection to the robot.")
        tab.unroute("**/events*")
        tab.clock.fast_forward(60_000)
        wait_until_ready(tab)
        expect(tab.get_by_role("alert")).to_be_hidden()


def test_a_stop_that_nobody_answers_is_told_and_sent_again(
    browser: Browser, talking: Robot
) -> None:
    with opened(browser, talking.page) as tab:
        wait_until_ready(tab)
        tab.route("**/stop*", lambda route: None)
        tab.keyboard.press("Escape")
        expect(tab.get_by_role("alert")).to_contain_text("STOP has not reached the robot")
        tab.unroute("**/stop*")
        expect(tab.locator("#said .stopped")).to_have_count(1)
        expect(tab.get_by_role("alert")).to_be_hidden()


def test_a_lost_connection_is_told_and_made_again(browser: Browser) -> None:
    with Page(Inbox(), Address(port=0), token=TOKEN) as first, opened(browser, first) as tab:
        first.board.say({"who": "robot", "text": "before", "at": 0})
        expect(tab.locator("#said")).to_contain_text("before")
        port = int(first.url.rsplit(":", 1)[1].split("/")[0])
        first._server.close()  # as if the program had been killed
        expect(tab.get_by_role("alert")).to_contain_text("No connection to the robot.")
        tab.keyboard.press("Escape")
        expect(tab.get_by_role("alert")).to_contain_text("STOP has not reached the robot")
        with Page(Inbox(), Address(port=port), token=TOKEN) as second:
            expect(tab.get_by_role("alert")).to_be_hidden()
            expect(tab.locator("#said .stopped")).to_have_count(1)
            second.board.say({"who": "robot", "text": "after", "at": 0})
            expect(tab.locator("#said")).to_contain_text("after")
            assert "before" not in tab.locator("#said").inner_text()


HOSTILE = (
    "<img src=x onerror=alert(1)>",
    "<script>alert(2)</script>",
    "</li></ol><h1>Owned</h1>",
    "javascript:alert(3) \u202e \x07 \x00",
    'Bring the <b>mug</b> & "it\'s"',
)


def test_names_of_things_side_by_side_in_the_picture_can_all_be_read(browser: Browser) -> None:
    things = [("strawberry", 40), ("apple", 10), ("potted_meat_can", 70), ("x" * 40, 50)]
    seen = [{"label": name, "confidence": 1, "box": [x, 200, 20, 20]} for name, x in things]
    with page_alone() as page, opened(browser, page) as tab:
        page.board.put("camera", {"number": 1, "width": 320, "height": 240, "seen": seen})
        page.board.flush()
        names = tab.locator(".picture text")
        expect(names).to_have_text([name.replace("_", " ") for name, _ in things])
        boxes = names.evaluate_all(
            "all => all.map((one) => one.getBBox()).map((b) => [b.x, b.y, b.width, b.height])"
        )
    for (x, y, width, height), (u, v, _, other) in combinations(sorted(boxes), 2):
        assert u > x + width or v > y + 0.9 * height or y > v + 0.9 * other


def test_hostile_words_are_words(browser: Browser, talking: Robot) -> None:
    with opened(browser, talking.page) as tab:
        wait_until_ready(tab)
        for number, words in enumerate(HOSTILE, 1):
            talking.page.says(words)
            expect(tab.locator("#said .person:not(.stopped)")).to_have_count(number)
            tab.keyboard.press("Escape")
            wait_until_ready(tab)
        assert tab.locator("#said img, #said script, #said h1, #said b").count() == 0
        assert tab.locator("h1").count() == 1
        assert HOSTILE[0] in tab.locator("#said").inner_text()


def test_what_is_too_long_stays_in_the_box(browser: Browser, talking: Robot) -> None:
    with opened(browser, talking.page) as tab:
        wait_until_ready(tab)
        box = tab.locator("#words")
        box.evaluate("box => { box.maxLength = 2e6; box.value = 'a'.repeat(1e6); }")
        box.press("Enter")
        expect(tab.get_by_role("alert")).to_contain_text("reads at most 1000 characters")
        assert len(box.input_value()) == 1_000_000
