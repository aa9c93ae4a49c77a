"""Reads what a person says, by the grammar of a language and its words: two files in `assets/`."""

import re
import tomllib
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache, lru_cache
from hashlib import sha256
from pathlib import Path
from typing import Any

from lark import Lark, UnexpectedInput
from lark.exceptions import VisitError

from executive.cache import cache_folder
from executive.language import others
from executive.language.asides import beside_a_request
from executive.language.building import Builder
from executive.language.commands import LEAVE_OUT_PLACES
from executive.language.contrasts import in_its_place
from executive.language.meaning import Refusal, Relation, Request, Said, Unable, Unread
from executive.language.parts import Unfit
from executive.language.phrases import in_one_piece, in_pieces, plain_letters
from executive.language.run_on import with_pauses
from executive.language.second_thoughts import answered_in_one_breath, corrected_in_one_breath
from executive.text import LONGEST, too_long

ASSETS = Path(__file__).parent / "assets"
_PAUSES = re.compile(r"[.!?;:\"“”…)\]]+(?=\s|$|,)|(?<!\S)[-–—(\[\"“”]+(?!\d)")
_QUOTES = re.compile('["“”„«»]')
_LEADING_SIGNS = re.compile("^[\\s\U0001f300-\U0001faff\u2600-\u27bf\ufe0f]+(?=[^\\W\\d_])")
"""Pictures of hands and faces, as one writes them before a sentence."""
KEPT = 64
"""Sentences that are kept, with their meaning: in a mission several ask for the same one."""
AT_A_TIME = "do things at a set time, only at once"
NOTHING = r"(?!)x"
"""A pattern that fits nothing."""


class Reader:
    """Reads a language: some ms for a sentence of a new form, and then less than one.

    Args:
        language: the name of its two files, `.lark` and `.toml`.
        names: of things and places, as far as they have words in them that mean something else.
    """

    def __init__(self, language: str = "english", names: Iterable[str] = ()) -> None:
        """Read the files, and prepare all that reading needs."""
        words = tomllib.loads((ASSETS / f"{language}.toml").read_text("utf-8"))
        self.deeds = tuple(words["deeds"].split())
        """Words that ask for a deed."""
        self.read: Callable[[str], Said] = lru_cache(KEPT)(self._read_anew)
        """What words mean; what cannot be read is `Unread`, and says where."""
        self.likely: Callable[[str], Request | None] = lru_cache(KEPT)(self._likely_anew)
        """What words probably ask for that cannot be read for sure; None if they do not."""
        self.plain: Callable[[str], str] = lru_cache(KEPT)(self._plain_anew)
        """Lower case, one space between words, no punctuation but the comma, no short forms.

        A full stop between sentences is a comma, and so are a dash and a bracket; what was no text
        is left out.
        """
        self._gerunds = gerunds = {_gerund(deed): deed for deed in self.deeds}
        self._short: dict[str, str] = words["short_forms"]
        self._short_form = re.compile(rf"\b(?:{_any_of(self._short)})(?!\w)")
        self._spellings = [(re.compile(p), whole) for p, whole in words["spellings"]]
        self._manners = [re.compile(p) for p in words["manners"]]
        deed = f"(?:{_any_of(self.deeds)})"
        self._ways = [(re.compile(p.replace("%DEED", deed)), q) for p, q in words["ways"]]
        joins, after = _any_of(words["no_new_deeds"]), _any_of(words["after_deeds"])
        self._deed = re.compile(rf"\b((?!(?:{joins}) )[^\s,]+) (?={deed} (?:{after})\b)")
        self._instead: dict[str, str] = words["instead"]
        self._next_deed = re.compile(rf"(?:, |\b(?:and|then) ){deed}\b")
        self._mind = re.compile(rf"^(?:please )?(?:would|do) you mind ({_any_of(gerunds)})(?= )")
        self._times = re.compile(rf",? ?\b(?:{'|'.join(words['times'])})(?=[ ,]|$)")
        self._left_out = re.compile(rf",? ?\b(?:{'|'.join(words['places_left_out'])})(?=,|$)")
        self._asides = [re.compile(pattern) for pattern in words["asides"]]
        self._pause = re.compile(words["pause"].replace("%DEED", deed))
        self._turn = re.compile(words["second_thoughts"])
        self._denials = re.compile(rf"\b(?:{_any_of(words['negations'] + words['denials'])})\b")
        self._perhaps = re.compile(rf"\b(?:{_any_of(words['perhaps_denials'])})\b")
        self._declines = re.compile(rf"\b(?:{_any_of(words['declines'])})\b")
        self._only = re.compile(rf"^(?:no,? )?(?:please )?(?:{_any_of(words['only'])})(?= )")
        self._conditions = re.compile(rf"\b(?:{_any_of(words['conditions'])})\b")
        self._numbers: dict[str, int] = words["numbers"]
        self.wish = re.compile(rf"(?:{_any_of(words['wishes'])}) ")
        """How a wish begins that may be to have something, or to have it put somewhere."""
        self._names = tuple(sorted({self.plain(name) for name in names if name.strip()}))
        self._named = re.compile(rf"(?<![^ ,])(?:{_any_of(self._names)})(?=[ ,]|$)")
        self._builder = _builder(words)
        grammar = (ASSETS / f"{language}.lark").read_text("utf-8")
        self.vocabulary = frozenset(re.findall(r"[^\W\d_]+", grammar))
        """Words that may be more than a part of a name."""
        unable = _any_of([*words["unable"].split(), *self._instead])
        deeds = _any_of([*words["before_deeds"], *self.deeds])
        self.parser = _parser(
            grammar,
            DEED_AHEAD=rf"(?=(?:{deeds}|{unable})(?=[ ,]|$))",
            UNABLE=rf"(?:{unable})(?=[ ,]|$)",
        )

    def _read_anew(self, words: str) -> Said:
        if too_long(words):
            return Unread(words)
        plain = self.plain(words)
        said = self._read(plain)
        if self._is_asked_for_without(self._times, plain):
            return Unable(AT_A_TIME)
        if isinstance(said, Unread):
            said = self._read_in_parts(plain) or said
        if isinstance(said, Unread) and self._is_asked_for_without(self._left_out, plain):
            return Unable(LEAVE_OUT_PLACES)
        if isinstance(said, Refusal):
            said = in_its_place(said, self._read)
        if isinstance(said, Refusal):
            return replace(said, more=said.more or self._asks_for_more(said.words))
        if isinstance(said, Unable):
            more = said.more or self._asks_for_more(said.rest)
            return replace(said, instead=self._instead.get(said.verb, ""), more=more)
        return replace(said, words=words) if isinstance(said, Unread) else said

    def _asks_for_more(self, rest: str) -> bool:
        """Whether a deed is asked for in what follows, by a word that is no part of a name."""
        return self._next_deed.search(self._named.sub("", rest)) is not None

    def _read_in_parts(self, plain: str) -> Said | None:
        """What is no sentence of the grammar, and may be several of them; None if it is not."""
        if said := corrected_in_one_breath(plain, self._turn, self._read):
            return said
        if answer := answered_in_one_breath(plain, self._turn, self._read):
            return answer
        if said := beside_a_request(plain, self._asides, self._pause, self._read_loosely):
            return said
        return with_pauses(plain, self._deed, self._read)

    def _read_loosely(self, plain: str) -> Said:
        """The same of one of several sentences."""
        said = self._read(plain)
        if not isinstance(said, Unread):
            return said
        corrected = corrected_in_one_breath(plain, self._turn, self._read)
        return corrected or with_pauses(plain, self._deed, self._read) or said

    def _likely_anew(self, words: str) -> Request | None:
        plain = self.plain(words)
        if not isinstance(self.read(words), Unread):
            return None
        corrected = corrected_in_one_breath(plain, self._turn, self._read, likely=True)
        if corrected or (likely := with_pauses(plain, self._deed, self._read, likely=True)):
            return corrected or likely
        return beside_a_request(plain, self._asides, self._pause, self._read_loosely, likely=True)

    def _read(self, text: str) -> Said:
        """The same of words in plain form; the names among them stay whole."""
        whole = self._named.sub(lambda name: in_one_piece(name[0]), text)
        try:
            return self._builder.transform(self.parser.parse(whole))
        except UnexpectedInput as error:
            at = len(in_pieces(whole[: max(error.pos_in_stream or 0, 0)]))
            return Unread(text, re.split(r"[ ,]", text[at:])[0], at)
        except VisitError as error:
            if not isinstance(error.orig_exc, Unfit):
                raise
            return Unread(text, str(error.orig_exc))

    def _is_asked_for_without(self, part: re.Pattern[str], plain: str) -> bool:
        """Whether the words are a request with such a part in them."""
        rest = part.sub("", plain)
        return rest != plain and isinstance(self._read(rest.strip(", ")), Request)

    def knows(self, words: str) -> bool:
        """Whether there is a word among them that may be more than a part of a name."""
        vocabulary = self.vocabulary
        return not all(w.isalpha() and w not in vocabulary for w in self.plain(words).split())

    def _plain_anew(self, words: str) -> str:
        text = plain_letters(words[:LONGEST])[:LONGEST].replace("\ufffd", " ")
        for spelling, whole in self._spellings:
            text = spelling.sub(whole, text)
        text = _QUOTES.sub(" ", _LEADING_SIGNS.sub("", text))
        text = self._short_form.sub(lambda match: self._short[match[0]], text)
        text = _PAUSES.sub(",", text)
        text = re.sub(r"(?:\s*,)+(?!\S)\s*|(?:\s+,)+", ", ", text)
        return self._without_manners(" ".join(text.split()).strip(", "))

    def _without_manners(self, text: str) -> str:
        """Less what asks for nothing; of other ways to say a thing, the one that is known."""
        plain = text
        for manners in self._manners:
            plain = manners.sub("", plain)
        plain = " ".join(plain.split()).strip(", ") or text
        for way, known in self._ways:
            plain = way.sub(known, plain)
        return self._mind.sub(lambda found: f"could you {self._gerunds[found[1]]}", plain)

    def denial(self, words: str) -> str:
        """A word among them that denies, or may; empty if there is none."""
        plain = self.plain(words)
        apart = re.sub(r"[_\W]+", " ", plain)
        found = self._denials.search(apart) or self._perhaps.search(apart)
        return found[0] if found else others.denial(plain)

    def denial_in_name(self, name: str) -> str:
        """A word in what was read as a name that denies; empty if there is none, or it is known."""
        if name in self._names:
            return ""
        found = self._denials.search(name)
        return found[0] if found else others.denial(name)

    def is_other_language(self, words: str) -> bool:
        """Whether the words are of a language that this is not, as far as that can be told."""
        return others.is_other(self.plain(words), self.vocabulary)

    def conditions(self, words: str) -> list[str]:
        """Words among them that make it depend on something."""
        return [found[0] for found in self._conditions.finditer(self.plain(words))]

    def numbers(self, words: str) -> list[tuple[str, int]]:
        """Numbers of things among them, as they were said, and as they are."""
        each = self.plain(words).replace(",", " ").split()
        said = ((w, int(w) if w.isdecimal() else self._numbers.get(w, 1)) for w in each)
        return [(word, number) for word, number in said if number != 1]

    def only(self, words: str) -> bool:
        """Whether they begin with a word that says that nothing else is meant."""
        return self._only.search(plain_letters(words)) is not None

    def declines(self, words: str) -> bool:
        """Whether there is something among them that people say who do not know."""
        return self._declines.search(self.plain(words)) is not None


@cache
def english(names: tuple[str, ...] = ()) -> Reader:
    """The reader of English, built once for all who know the same names."""
    return Reader("english", names)


def _builder(words: dict[str, Any]) -> Builder:
    relations = {said: Relation(name) for name, all_ in words["relations"].items() for said in all_}
    most = {said: name for name, all_ in words["superlatives"].items() for said in all_}
    numbers = words["numbers"] | words["ordinals"]
    return Builder(numbers, relations, most, tuple(words["wishes"]))


@cache
def _parser(grammar: str, **terminals: str) -> Lark:
    """A parser of the grammar with these terminals added; names make no other one."""
    priorities = {"DEED_AHEAD": "", "UNABLE": ".1"}
    added = (f"{name}{priorities[name]}: /{pattern}/" for name, pattern in terminals.items())
    text = "\n".join([grammar, *added, ""])
    return Lark(
        text, start="said", parser="lalr", maybe_placeholders=False, cache=_kept(text) or False
    )


def _kept(grammar: str) -> str | None:
    """The file in which Lark keeps the tables that it makes of this grammar; None: nowhere.

    They take half a second to make. A file that is damaged, or of another version, is made anew.
    """
    folder = cache_folder()
    return str(folder / f"{sha256(grammar.encode()).hexdigest()}.lark") if folder else None


def _gerund(deed: str) -> str:
    """As it follows "would you mind": "bringing", "taking", "getting"."""
    if deed.endswith("e"):
        return f"{deed.removesuffix('e')}ing"
    doubled = re.fullmatch(r"[^aeiou]*[aeiou][bdgmnprt]", deed)
    return f"{deed}{deed[-1] if doubled else ''}ing"


def _any_of(words: Iterable[str]) -> str:
    """A pattern for any of the words, the longest first."""
    found = "|".join(re.escape(word) for word in sorted(words, key=len, reverse=True))
    return found.replace("/", r"\/") or NOTHING
