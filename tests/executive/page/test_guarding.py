"""Nobody uses the page who has not its token, or who comes from another page."""

import pytest
from paging import ask, page_alone, post

from executive.page.guarding import HEADERS
from executive.page.page import Page


@pytest.fixture(scope="module")
def page() -> Page:
    with page_alone() as page:
        yield page


PATHS = ["/", "/events", "/why", "/camera/0.jpg", "/thing/mug.png"]


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize("token", ["", "guessed", "the-token-and-more"])
def test_without_the_token_nothing_is_told(page: Page, path: str, token: str) -> None:
    assert ask(page, path, token=token).status == 403


@pytest.mark.parametrize("path", ["/say", "/stop"])
def test_without_the_token_nothing_is_done(page: Page, path: str) -> None:
    before = len(page.board.since(0))
    assert post(page, path, {"words": "Bring the mug"}, token="guessed") == 403
    assert len(page.board.since(0)) == before


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:8080", "127.0.0.1.evil.example", ""]
)
def test_under_a_name_that_is_not_its_own_the_page_is_not_served(page: Page, host: str) -> None:
    assert ask(page, "/", headers={"host": host}).status == 403


@pytest.mark.parametrize("host", ["localhost:8080", "127.0.0.1", "[::1]:8080", "LOCALHOST"])
def test_under_each_name_of_this_machine_it_is(page: Page, host: str) -> None:
    assert ask(page, "/", headers={"host": host}).status == 200


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "https://127.0.0.1", None])
def test_what_another_page_sends_is_refused_though_it_has_the_token(
    page: Page, origin: str | None
) -> None:
    headers = {} if origin is None else {"origin": origin}
    assert post(page, "/say", {"words": "Bring the mug"}, headers=headers) == 403


def test_what_is_answered_may_run_only_the_pages_own_scripts(page: Page) -> None:
    answer = ask(page, "/")
    for name, value in HEADERS.items():
        assert answer.headers[name] == value


@pytest.mark.parametrize("path", ["/../pyproject.toml", "/%2e%2e/page.py", "/page.py", "/none"])
def test_no_other_file_is_served(page: Page, path: str) -> None:
    assert ask(page, path).status == 404
