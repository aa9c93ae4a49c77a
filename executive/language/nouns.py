"""Things and places, as the rules of a grammar have them."""

from dataclasses import replace

from lark import Token, Transformer

from executive.language.meaning import ME, Relation, Said, Thing, Things, Where
from executive.language.parts import (
    From,
    Part,
    To,
    Unfit,
    either_of,
    exceptions_of,
    is_a,
    purpose_of,
    said_of,
)
from executive.language.phrases import in_pieces
from executive.types.commands import ALL


class Nouns(Transformer[Token, Said]):
    """Makes things and places of the rules about them.

    Args:
        numbers: what words for numbers and ordinals stand for.
        relations: which relation a preposition says.
        superlatives: which measure a word like "biggest" is about.
        wishes: how a wish begins that may be to have a thing, or to have it put somewhere.
    """

    def __init__(
        self,
        numbers: dict[str, int],
        relations: dict[str, Relation],
        superlatives: dict[str, str],
        wishes: tuple[str, ...],
    ) -> None:
        """Take the words that have a value."""
        super().__init__()
        self._numbers = numbers
        self._relations = relations
        self._superlatives = superlatives
        self._wishes = wishes

    def __default_token__(self, token: Token) -> Token:
        """Any token, with the words of names in it apart again."""
        return token.update(value=in_pieces(token))

    # --- things ---

    def words(self, parts: list[Part]) -> str:
        """The words of a name."""
        return " ".join(parts)

    def determiner(self, parts: list[Part]) -> Token:
        """An article, or a number; "1" is the article that "one" is."""
        (token,) = parts
        assert isinstance(token, Token)
        return Token("A", token) if is_a(token, "NUMBER") and token == "1" else token

    def noun(self, parts: list[Part]) -> Thing:
        """As in "box of sugar", "tool for nails"."""
        name = " ".join(p for p in parts if type(p) is str or is_a(p, "OF", "POSE"))
        first, _, rest = name.partition(" ")
        most = self.most(first)
        words = rest if most else name
        return Thing(words, purpose=purpose_of(parts, "USE"), superlative=most, said=said_of(parts))

    def thing(self, parts: list[Part]) -> Thing:
        """As in "the two mugs but not the red one"."""
        noun = next(p for p in parts if isinstance(p, Thing))
        numbers = [self.count_of(p) for p in parts if is_a(p, "NUMBER")]
        definite = any(is_a(p, "THE") for p in parts) and not any(is_a(p, "SOME") for p in parts)
        number = numbers[0] if numbers else 1 if any(is_a(p, "A") for p in parts) else None
        return replace(
            noun,
            number=number,
            definite=definite,
            exceptions=exceptions_of(parts),
            said=said_of(parts),
        )

    def something(self, parts: list[Part]) -> Thing:
        """As in "something yellow to drink from"."""
        words = " ".join(p for p in parts if type(p) is str)
        purpose = purpose_of(parts, "PURPOSE")
        return Thing(
            words, number=1, purpose=purpose, exceptions=exceptions_of(parts), said=said_of(parts)
        )

    def pronoun(self, parts: list[Part]) -> Thing:
        """As in "it", "them"."""
        return Thing(str(parts[0]), pronoun=True, definite=True, said=said_of(parts))

    def every_pronoun(self, parts: list[Part]) -> Thing:
        """As in "all of them", "them both", "all three of them"."""
        word = next(str(p) for p in parts if is_a(p, "PRONOUN"))
        how_many = next(str(p) for p in parts if is_a(p, "ALL", "BOTH", "EVERY_OF"))
        numbers = (self._numbers[said] for said in how_many.split() if said in self._numbers)
        return Thing(
            word,
            number=next(numbers, ALL),
            pronoun=True,
            definite=True,
            exceptions=exceptions_of(parts),
            said=said_of(parts),
        )

    def some_of_them(self, parts: list[Part]) -> Thing:
        """As in "two of them", "any of those"."""
        number = self.count_of(parts[0]) if is_a(parts[0], "NUMBER") else 1
        return Thing(str(parts[-1]), number, pronoun=True, said=said_of(parts))

    def which_of_them(self, parts: list[Part]) -> Thing:
        """As in "the second one"."""
        said = said_of(parts)
        number = self.number_of(parts[-1])
        return Thing(said, pronoun=True, definite=True, place_in_list=number, said=said)

    def the_few(self, parts: list[Part]) -> Things:
        """As in "the first two", "the last three of them"."""
        which, number = parts[-1].split()[:2]
        count = self.number_of(Token("NUMBER", number))
        places = range(1, count + 1) if self._numbers[which] > 0 else range(-count, 0)
        said = said_of(parts)
        members = (
            Thing(said, pronoun=True, definite=True, place_in_list=place, said=said)
            for place in places
        )
        return Things(tuple(members))

    def another(self, parts: list[Part]) -> Thing:
        """As in "another apple", "the other one", "two more apples"."""
        noun = next((p for p in parts if isinstance(p, Thing)), Thing())
        number = next((self.count_of(p) for p in parts if is_a(p, "NUMBER")), 1)
        return replace(noun, number=number, pronoun=not noun.words, other=True, said=said_of(parts))

    def every(self, parts: list[Part]) -> Thing:
        """As in "all the fruit", "everything but the mug"."""
        noun = next((p for p in parts if isinstance(p, Thing)), Thing())
        left_out = exceptions_of(parts)
        if so_many := [t.said for t in left_out if t.number and not t.definite]:
            raise Unfit(so_many[0])  # "all but two fruits", "all but one of them": which?
        return replace(noun, number=ALL, definite=True, exceptions=left_out, said=said_of(parts))

    def some_of(self, parts: list[Part]) -> Thing:
        """As in "one of the tools", "two of my mugs"."""
        noun = next(p for p in parts if isinstance(p, Thing))
        numbers = (self.count_of(p) for p in parts if is_a(p, "NUMBER"))
        number = next(numbers, None if is_a(parts[0], "SOME_OF") else 1)
        return replace(noun, number=number, exceptions=exceptions_of(parts))

    def except_(self, parts: list[Part]) -> tuple[Thing, ...]:
        """As in "but a banana", "except the pear and the apple"."""
        things = tuple(p for p in parts if isinstance(p, Thing))
        if one := next((t.said for t in things if t.words in ("one", "ones")), ""):
            raise Unfit(one)  # "all tools but one": which?
        if every := next((t.said for t in things if t.number == ALL and not t.words), ""):
            raise Unfit(every)  # "all but what is on the desk": where they are is said of these
        if things[0].definite and any(thing.number and not thing.definite for thing in things):
            raise Unfit(things[-1].said)  # "not the peach, and a mug": the mug may be wanted
        return things

    def left_alone(self, parts: list[Part]) -> tuple[Thing, ...]:
        """As in "and do not touch the banana", "but leave the apple and the pear alone"."""
        return tuple(replace(p, alone=True) for p in parts if isinstance(p, Thing))

    def rather(self, parts: list[Part]) -> Things:
        """As in "not the hammer but the drill"."""
        wrong = parts[-1]
        if len(wrong.exceptions) != 1:
            raise Unfit(str(parts[0]))
        [meant] = wrong.exceptions
        return Things((replace(meant, exceptions=(replace(wrong, exceptions=()),)),))

    def all_of(self, parts: list[Part]) -> Things:
        """As in "an apple and a banana", "both the apple and the banana"."""
        things = tuple(p for p in parts if isinstance(p, Thing))
        if is_a(parts[0], "BOTH_AND") and len(things) == 1:  # "both mugs and go to the desk"
            return Things((replace(things[0], number=2),))
        in_order = any(is_a(p, "AND") and not p.endswith(("and", "also")) for p in parts)
        return Things(things, in_order=in_order)

    def one_of(self, parts: list[Part]) -> Things:
        """As in "either the hammer or the drill"."""
        return Things(tuple(p for p in parts if isinstance(p, Thing)), one_of=True)

    # --- places ---

    def place(self, parts: list[Part]) -> Where:
        """As in "the kitchen table"."""
        noun = next(p for p in parts if isinstance(p, Thing))
        return Where(noun.words)

    def pronoun_place(self, parts: list[Part]) -> Where:
        """As in "it", as in "next to it"."""
        return Where(parts[0], pronoun=True)

    def where(self, parts: list[Part]) -> Where | From:
        """As in "on the desk": where it is or where it is to go, as the verb says."""
        places, relation = [], Relation.AT
        for part in parts:
            if is_a(part, "RELATION"):
                relation = self._relations[part]
            elif isinstance(part, Where):
                places.append(replace(part, relation=relation))
        either = either_of(places)
        return From(either, told=True) if is_a(parts[0], "THAT_IS") else either

    def between(self, parts: list[Part]) -> Where:
        """As in "between the sofa and the desk"."""
        names = (part.words for part in parts if isinstance(part, Where))
        return Where(" and ".join(names), Relation.BETWEEN)

    def source(self, parts: list[Part]) -> From:
        """As in "from the desk"."""
        return From(either_of(parts))

    def goal(self, parts: list[Part]) -> To:
        """As in "to the desk"."""
        return To(either_of(parts))

    def to_person(self, parts: list[Part]) -> To:
        """As in "to her"."""
        return To(Where(parts[-1], pronoun=True))

    def dative(self, parts: list[Part]) -> Where:
        """As in "bring Anna the mug"."""
        return Where(parts[0])

    def dative_pronoun(self, parts: list[Part]) -> Where:
        """As in "bring her the mug"."""
        return Where(parts[0], pronoun=True)

    def to_me(self, parts: list[Part]) -> To:
        """As in "to me", "here"."""
        return To(ME)

    def there(self, parts: list[Part]) -> Where:
        """As in "there": where it was spoken of."""
        return Where(parts[0], pronoun=True)

    def most(self, words: str) -> str:
        """Which measure a word like "biggest" is about; empty if about none."""
        return self._superlatives.get(words.partition(" ")[0], "")

    def count_of(self, token: Token) -> int:
        """How many things a number stands for; of none of them there is nothing to do."""
        if not (number := self.number_of(token)):
            raise Unfit(str(token))
        return number

    def number_of(self, token: Token) -> int:
        """What a number or an ordinal stands for."""
        digits = token.removeprefix("number ").partition(" ")[0]
        if digits.isdecimal():
            return int(digits)
        return self._numbers.get(token) or self._numbers[token.rpartition(" ")[0]]
