"""The profile that docs/own-robot.md shows can be read, and the page has every key."""

import re
from pathlib import Path

from executive.ros.profile import GOALS, OFFERED, Profile, load_profile

PAGE = (Path(__file__).parents[2] / "docs" / "own-robot.md").read_text()


def test_the_profile_of_the_page_is_right(tmp_path: Path) -> None:
    (text,) = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    (tmp_path / "page.toml").write_text(text)
    profile = load_profile(str(tmp_path / "page.toml"))
    assert not profile.has_arm
    assert profile.limits.rooms


def test_the_page_has_every_section_and_every_word_of_goals() -> None:
    names = set(Profile.model_fields) - {"about", "tried"}
    assert {name for name in names if f"[{name}]" not in PAGE and f"`{name}`" not in PAGE} == set()
    assert {kind for kind in GOALS if kind not in PAGE} == set()
    words = {word for offered in OFFERED.values() for word in offered}
    assert {word for word in words if f"`{word}`" not in PAGE} == set()
