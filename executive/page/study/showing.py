"""What the participant's page is told of a step: text and questions, and no condition's name."""

from collections.abc import Mapping
from typing import Any

from executive.page.study.file import Study
from executive.page.study.questionnaire import Questionnaire
from executive.page.study.steps import Kind, Step

Shown = Mapping[str, Any]
DECLINED = "declined"
"""Shown to who does not consent."""


def shown(study: Study, code: str, step: Step, done: int, steps: int) -> Shown:
    """A step as the page has it; `done` of so many `steps` are over."""
    return {
        "step": "/".join((step.kind, str(step.position), step.name)),
        "kind": step.kind,
        "participant": code,
        "done": done,
        "steps": steps,
        **_content(study, step),
    }


def declined(code: str) -> Shown:
    """That a participant takes no part."""
    return {"step": DECLINED, "kind": DECLINED, "participant": code, "done": 0, "steps": 0}


def _content(study: Study, step: Step) -> dict[str, Any]:
    match step.kind:
        case Kind.CONSENT:
            return {"title": study.title, "text": study.consent}
        case Kind.INSTRUCTIONS:
            return {"text": study.instructions}
        case Kind.PART:
            text = study.condition(step.condition).text
            return {"text": text, "number": step.position, "of": len(study.conditions)}
        case Kind.TASK:
            text = study.task(step.name).text
            return {"text": text, "number": step.turn, "of": len(study.tasks)}
        case Kind.QUESTIONNAIRE:
            return _asked(study.questionnaire(step.name))
        case Kind.THANKS:
            return {"text": study.thanks}


def _asked(questionnaire: Questionnaire) -> dict[str, Any]:
    """What is to be seen of it: not how it is scored."""
    seen = questionnaire.model_dump(mode="json", exclude={"score"})
    kept = ("name", "text", "left", "right", "answer", "needed")
    seen["items"] = [{key: item[key] for key in kept} for item in seen["items"]]
    return seen
