"""Which known name looks most like what was said: a slip of the finger, or what may be meant."""

from collections.abc import Iterable

from rapidfuzz import fuzz, process

from executive.language.phrases import spoken

MOST_NAMES = 3
LEAST_SIMILARITY = 60.0
"""Of 100, as rapidfuzz counts; below it two names share little but a few letters."""
SLIP_SIMILARITY, SLIP_MARGIN = 75.0, 10.0
"""A slip of the finger is as similar as this, and more similar by this than to anything else."""


class SimilarNames:
    """All names that somebody may have meant, each with the one name of what it stands for."""

    def __init__(self, names: Iterable[tuple[str, str]]) -> None:
        """Each is what something may be called, and its name; an earlier one counts first."""
        self._said, self._names = list[str](), list[str]()
        for called, name in names:
            self._said.append(spoken(called))
            self._names.append(name)

    def nearest(self, words: str) -> tuple[str, ...]:
        """The names that look most like the words, best first; none if none does."""
        return tuple(self._similar(words))[:MOST_NAMES]

    def slip(self, words: str) -> str | None:
        """The one name that the words are most likely a slip of, if it is clear."""
        (best, similarity), (_, next_best) = (*self._similar(words).items(), *2 * [("", 0.0)])[:2]
        clear = similarity >= SLIP_SIMILARITY and similarity - next_best >= SLIP_MARGIN
        return best if clear else None

    def _similar(self, words: str) -> dict[str, float]:
        """Names that look like the words, most similar first, and how similar (of 100)."""
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
