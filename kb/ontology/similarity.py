"""Finds the known names most similar to some words: misspellings, or suggestions."""

from collections.abc import Iterable

from rapidfuzz import fuzz, process

from executive.language.phrases import spoken

MOST_NAMES = 3
LEAST_SIMILARITY = 60.0
"""Minimum similarity (0 to 100, rapidfuzz); names below it share only a few letters."""
SLIP_SIMILARITY, SLIP_MARGIN = 75.0, 10.0
"""Minimum similarity of a misspelling, and its minimum lead over any other name."""


class SimilarNames:
    """All names and synonyms, each with the name of what it stands for."""

    def __init__(self, names: Iterable[tuple[str, str]]) -> None:
        """`names` are pairs (synonym or name, name); earlier ones take precedence."""
        self._said, self._names = list[str](), list[str]()
        for called, name in names:
            self._said.append(spoken(called))
            self._names.append(name)

    def nearest(self, words: str) -> tuple[str, ...]:
        """The names most similar to the words, best first; empty if none is similar."""
        return tuple(self._similar(words))[:MOST_NAMES]

    def slip(self, words: str) -> str | None:
        """The name that the words misspell; None if it is not clear."""
        (best, similarity), (_, next_best) = (*self._similar(words).items(), *2 * [("", 0.0)])[:2]
        clear = similarity >= SLIP_SIMILARITY and similarity - next_best >= SLIP_MARGIN
        return best if clear else None

    def _similar(self, words: str) -> dict[str, float]:
        """Names and their similarity to the words (0 to 100), most similar first."""
        found = process.extract(
            spoken(words),
            self._said,
            scorer=fuzz.token_sort_ratio,
            score_cutoff=LEAST_SIMILARITY,
            limit=None,
        )
        similar: dict[str, float] = {}
        for _, similarity, index in found:
            similar.setdefault(self._names[index], similarity)
        return similar
