"""What the person is asked."""

from dataclasses import dataclass
from enum import StrEnum


class QuestionKind(StrEnum):
    """What a question is after."""

    WHICH_OBJECT = "which_object"
    WHERE_IS = "where_is"
    CONFIRM = "confirm"
    WHERE_TO_PUT = "where_to_put"
    WHERE_TO_GO = "where_to_go"


@dataclass(frozen=True, slots=True)
class Question:
    """Something that only the person can say.

    `about` is the object or class in question; `options` are the known answers, if they are few,
    or the objects that it is about, if yes or no is the answer.
    """

    kind: QuestionKind
    about: str
    text: str
    options: tuple[str, ...] = ()
