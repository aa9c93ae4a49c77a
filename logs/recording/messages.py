"""Converts records to the fields of the messages in `schema.py` and back, in pairs.

Input is validated, since a recording may come from a stranger.
"""

import json
from math import isfinite
from typing import Any

from executive.records import Finished, LlmCall, NodeShape, NodeState, Tick, TreeShape
from executive.types.commands import CommandKind
from executive.types.knowledge import Candidate
from executive.types.llm import ChatRequest, Message, Precedent, RankRequest, Usage
from executive.types.outcome import MissionStatus, Outcome, TaskOutcome
from executive.types.results import Replied, Scored
from logs.recording.schema import STATUS
from logs.recording.sound import MOST, MOST_DEEP, check_situation, finite, json_value, whole
from logs.recording.undeclared import told_from_names

MOST_BEHAVIOURS = 2000
_PARAMETERS = ("temperature", "top_p", "top_k", "seed", "max_tokens")


# --- the tree ---


def tree_to_fields(tree: TreeShape) -> dict[str, Any]:
    """`/bt/tree`."""
    children: dict[str, list[str]] = {}
    for node in tree.nodes:
        children.setdefault(node.parent, []).append(node.path)
    return {
        "behaviours": [
            {
                "own_id": node.path,
                "parent_id": node.parent,
                "child_ids": children.get(node.path, ()),
                "name": node.name,
                "class_name": node.class_name,
                "type": node.kind,
                "source": node.source,
                "activity": node.activity,
                "stage": node.stage,
            }
            for node in tree.nodes
        ]
    }


def tree_from_message(message: Any) -> TreeShape:
    """The tree of a `/bt/tree` message.

    Raises:
        ValueError: if it is not a tree (parents come before their children, and paths are unique),
            or has too many behaviours or levels.
    """
    if len(message.behaviours) > MOST_BEHAVIOURS:
        raise ValueError(f"a tree of {len(message.behaviours)} behaviours")
    levels = {"": 0}
    for b in message.behaviours:
        if b.parent_id not in levels or b.own_id in levels:
            raise ValueError(f"a tree in which {b.own_id!r} comes twice, or before its parent")
        levels[b.own_id] = levels[b.parent_id] + 1
        if levels[b.own_id] > MOST_DEEP:
            raise ValueError(f"a tree of more than {MOST_DEEP} levels")
    return TreeShape(tuple(map(_node_from, message.behaviours)))


def _node_from(b: Any) -> NodeShape:
    """In old recordings, behaviours do not declare their meaning; it is taken from their names."""
    node = NodeShape(
        b.own_id, b.parent_id, b.name, b.type, b.class_name, b.source, b.activity, b.stage
    )
    return node if b.HasField("source") else told_from_names(node)


def tick_to_fields(tick: Tick) -> dict[str, Any]:
    """`/bt/tick`: the status of each behaviour, and the mission's facts as JSON values by name."""
    return {
        "tick": tick.number,
        "cause": tick.cause,
        "tip_id": tick.tip,
        "behaviours": [
            {
                "own_id": node.path,
                "status": node.status,
                "message": node.message,
                "is_active": node.status != "INVALID",
            }
            for node in tick.nodes
        ],
        "situation": [
            {"key": key, "value": json.dumps(value, default=str)}
            for key, value in tick.situation.items()
        ],
        "duration_s": tick.duration_s,
    }


def tick_from_message(message: Any) -> Tick:
    """The tick of a `/bt/tick` message.

    Raises:
        ValueError: if it has too many behaviours, an unknown status, an impossible situation, or a
            number that cannot be.
    """
    if len(message.behaviours) > MOST_BEHAVIOURS:
        raise ValueError(f"a tick of {len(message.behaviours)} behaviours")
    situation = {pair.key: json_value(pair.value) for pair in message.situation}
    check_situation(situation)
    return Tick(
        number=whole(message.tick),
        cause=message.cause,
        tip=message.tip_id,
        nodes=tuple(NodeState(b.own_id, _status(b.status), b.message) for b in message.behaviours),
        situation=situation,
        duration_s=finite(message.duration_s),
    )


def _status(number: int) -> str:
    if not 0 < number < len(STATUS):
        raise ValueError(f"{number} is no status of a behaviour")
    return STATUS[number]


# --- the language model ---


def llm_call_to_fields(call: LlmCall) -> dict[str, Any]:
    """`/llm/call`: request and reply, parameters, tokens and times."""
    result, usage = call.result, call.result.usage
    return {
        "label": result.request.label,
        "gen_ai_request_model": usage.model,
        **_parameters_to_fields(usage),
        "gen_ai_input_messages": _turns_to_fields(result.request.messages),
        "gen_ai_response_time_to_first_chunk": usage.first_token_s,
        "gen_ai_usage_input_tokens": _figure(usage.input_tokens),
        "gen_ai_usage_cache_read_input_tokens": _figure(
            usage.input_tokens - usage.evaluated_tokens
        ),
        "gen_ai_usage_output_tokens": _figure(usage.output_tokens),
        "duration_s": usage.total_s,
        "prepared_tokens": _figure(usage.prepared_tokens),
        "prepared_s": usage.prepared_s,
        **(_reply(result) if isinstance(result, Replied) else _ranking(result)),
    }


def _reply(replied: Replied) -> dict[str, Any]:
    schema = replied.request.schema
    return {
        "gen_ai_operation_name": "chat",
        "gen_ai_output_messages": [{"role": "assistant", "content": replied.text}],
        "gen_ai_response_finish_reasons": [replied.finish_reason],
        "output_schema": None if schema is None else json.dumps(schema),
    }


def _ranking(scored: Scored) -> dict[str, Any]:
    request = scored.request
    return {
        "gen_ai_operation_name": "rank",
        "neutral_messages": _turns_to_fields(request.neutral),
        "options": [
            {"text": text, "place": place, "score": score}
            for text, place, score in zip(
                request.options, request.places, scored.scores, strict=True
            )
        ],
        "precedents": [
            {"question": p.messages[-1].content, "places": p.places, "kind": p.kind}
            for p in request.precedents
        ],
        "kind": request.kind,
    }


def llm_call_from_message(message: Any) -> LlmCall:
    """The call of a `/llm/call` message.

    Raises:
        ValueError: if it has no request, or a value in it is invalid.
    """
    read = whole(message.gen_ai_usage_input_tokens)
    usage = Usage(
        model=message.gen_ai_request_model,
        input_tokens=read,
        evaluated_tokens=read - whole(message.gen_ai_usage_cache_read_input_tokens),
        output_tokens=whole(message.gen_ai_usage_output_tokens),
        first_token_s=finite(message.gen_ai_response_time_to_first_chunk),
        total_s=finite(message.duration_s),
        prepared_tokens=whole(message.prepared_tokens),
        prepared_s=finite(message.prepared_s),
        parameters=_parameters(message),
    )
    asked = _turns(message.gen_ai_input_messages)
    if not asked:
        raise ValueError("a call of the model that asks nothing")
    if message.gen_ai_operation_name == "rank":
        ranking = RankRequest(
            label=message.label,
            messages=asked,
            neutral=_turns(message.neutral_messages),
            options=tuple(o.text for o in message.options),
            places=tuple(o.place for o in message.options),
            precedents=tuple(
                Precedent((*asked[:-1], Message("user", p.question)), tuple(p.places), p.kind)
                for p in message.precedents
            ),
            kind=message.kind,
        )
        return LlmCall(Scored(ranking, tuple(o.score for o in message.options), usage))
    schema = json_value(message.output_schema) if message.output_schema else None
    return LlmCall(
        Replied(
            ChatRequest(message.label, asked, schema),
            "".join(m.content for m in message.gen_ai_output_messages),
            usage,
            finish_reason="".join(message.gen_ai_response_finish_reasons),
        )
    )


def _figure(count: float) -> int:
    """A whole number of tokens, as sent by a server; 0 if negative, infinite or too large."""
    return int(count) if isfinite(count) and 0 <= count <= MOST else 0


def _parameters_to_fields(usage: Usage) -> dict[str, Any]:
    fields, others = dict[str, Any](), list[dict[str, str]]()
    for name, value in usage.parameters.items():
        if name in _PARAMETERS and not isinstance(value, str):
            fields[f"gen_ai_request_{name}"] = value
        else:
            others.append({"key": name, "value": json.dumps(value)})
    return {**fields, "other_parameters": others}


def _parameters(message: Any) -> dict[str, float | int | str]:
    return {
        name: getattr(message, f"gen_ai_request_{name}")
        for name in _PARAMETERS
        if message.HasField(f"gen_ai_request_{name}")
    } | {pair.key: json_value(pair.value) for pair in message.other_parameters}


def _turns_to_fields(messages: tuple[Message, ...]) -> list[dict[str, str]]:
    return [{"role": message.role, "content": message.content} for message in messages]


def _turns(field: Any) -> tuple[Message, ...]:
    return tuple(Message(turn.role, turn.content) for turn in field)


# --- the end ---


def finished_to_fields(finished: Finished) -> dict[str, Any]:
    """`/outcome`."""
    outcome = finished.outcome
    return {
        **{name: getattr(outcome, name) for name in Outcome.__slots__},
        "candidates": [
            {"place": c.place, "source": c.source, "probability": c.probability}
            for c in outcome.candidates
        ],
        "tasks": list(map(_task_to_fields, outcome.tasks)),
    }


def _task_to_fields(task: TaskOutcome) -> dict[str, Any]:
    fields = {name: getattr(task, name) for name in TaskOutcome.__slots__}
    return {**fields, "parts": list(map(_task_to_fields, task.parts))}


def finished_from_message(message: Any) -> Finished:
    """The end of an `/outcome` message.

    Raises:
        ValueError: if a kind, a status or a number in it is invalid.
    """

    def optional(name: str) -> str | None:
        return _optional(message, name)

    kind = optional("kind")
    outcome = Outcome(
        command=message.command,
        kind=CommandKind(kind) if kind else None,
        target=optional("target"),
        object=optional("object"),
        status=MissionStatus(message.status),
        reason=message.reason,
        source=optional("source"),
        location=optional("location"),
        inquiries=whole(message.inquiries),
        visited=tuple(message.visited),
        llm_calls=whole(message.llm_calls),
        candidates=tuple(
            Candidate(c.place, c.source, c.probability if c.HasField("probability") else None)
            for c in message.candidates
        ),
        mission_time_s=finite(message.mission_time_s),
        thinking_time_s=finite(message.thinking_time_s),
        wall_time_s=finite(message.wall_time_s),
        run_dir=optional("run_dir"),
        model_failure=message.model_failure,
        goals=tuple(message.goals),
        tasks=tuple(map(_task, message.tasks)),
    )
    return Finished(outcome)


def _task(message: Any) -> TaskOutcome:
    return TaskOutcome(
        kind=CommandKind(message.kind),
        target=message.target,
        object=_optional(message, "object"),
        status=MissionStatus(message.status),
        reason=message.reason,
        location=_optional(message, "location"),
        goals=tuple(message.goals),
        visited=tuple(message.visited),
        things=tuple(message.things),
        among=tuple(message.among),
        parts=tuple(map(_task, message.parts)),
        put_at=message.put_at,
    )


def _optional(message: Any, name: str) -> str | None:
    return getattr(message, name) if message.HasField(name) else None
