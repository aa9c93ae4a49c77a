"""Questions to the person."""

from dataclasses import dataclass
from enum import StrEnum


class QuestionKind(StrEnum):
    """What a question asks for."""

    WHICH_OBJECT = "which_object"
    WHERE_IS = "where_is"
    CONFIRM = "confirm"
    WHERE_TO_PUT = "where_to_put"
    WHERE_TO_GO = "where_to_go"


@dataclass(frozen=True, slots=True)
class Question:
    """A question that only the person can answer.

    Attributes:
        about: the object or class in question.
        text: the question as the person gets it.
        options: the possible answers, if they are few; of a yes-or-no question, the objects that it
            is about.
    """

    kind: QuestionKind
    about: str
    text: str
    options: tuple[str, ...] = ()
