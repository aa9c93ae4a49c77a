"""The mission's rules, as the settings give them."""

from executive.config import Settings
from trees.team import Rules


def rules(settings: Settings) -> Rules:
    """What the behaviours keep to."""
    return Rules(
        elicit=settings.elicitation,
        top=settings.top,
        answer_s=settings.answer_timeout_s,
        model_s=settings.llm_timeout_s,
        action_s=settings.action_timeout_s,
        sure=settings.sure,
    )
