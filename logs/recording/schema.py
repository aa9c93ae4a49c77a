"""Defines the mcap messages without a well-known schema, and makes protobuf classes of them.

Names follow py_trees_ros for the tree (`own_id`, `tip_id`, `is_active`, status 1 to 4), Foxglove
for time (`timestamp`), and OpenTelemetry's conventions for generative AI, with underscores for dots
(`gen_ai_usage_input_tokens`). `timestamp` is run start + mission time, the time base of the log;
`wall_time` is when the record was made.
"""

from collections.abc import Mapping
from typing import Any

from foxglove_schemas_protobuf import KeyValuePair_pb2, Point3_pb2
from google.protobuf import message_factory, timestamp_pb2
from google.protobuf.descriptor_pb2 import (
    DescriptorProto,
    FieldDescriptorProto,
    FileDescriptorProto,
)
from google.protobuf.descriptor_pool import DescriptorPool

Definitions = Mapping[str, Mapping[str, str]]
"""Messages by name: their fields, as in a .proto file, in the order of their numbers (from 1)."""

PACKAGE = "robot_executive"
STATUS = ("UNKNOWN", "INVALID", "RUNNING", "SUCCESS", "FAILURE")

STAMPED = {
    "timestamp": "google.protobuf.Timestamp",
    "wall_time": "google.protobuf.Timestamp",
}
"""The first fields of every message on a topic."""

# The messages of one topic each, and their parts.

TREE: Definitions = {
    "Behaviour": {
        "own_id": "string",
        "parent_id": "string",
        "child_ids": "repeated string",
        "name": "string",
        "class_name": "string",
        "type": "string",
        "source": "optional string",
        "activity": "optional string",
        "stage": "optional bool",
    },
    "BehaviourTree": {**STAMPED, "behaviours": "repeated Behaviour"},
}

TICK: Definitions = {
    "BehaviourState": {
        "own_id": "string",
        "status": "Status",
        "message": "string",
        "is_active": "bool",
    },
    "Tick": {
        **STAMPED,
        "tick": "uint64",
        "cause": "string",
        "tip_id": "string",
        "behaviours": "repeated BehaviourState",
        "situation": "repeated foxglove.KeyValuePair",
        "duration_s": "double",
    },
}

LLM_CALL: Definitions = {
    "ChatMessage": {"role": "string", "content": "string"},
    "Option": {"text": "string", "place": "string", "score": "double"},
    "Precedent": {"question": "string", "places": "repeated string", "kind": "string"},
    "LlmCall": {
        **STAMPED,
        "label": "string",
        "gen_ai_operation_name": "string",
        "gen_ai_request_model": "string",
        "gen_ai_request_temperature": "optional double",
        "gen_ai_request_top_p": "optional double",
        "gen_ai_request_top_k": "optional int64",
        "gen_ai_request_seed": "optional int64",
        "gen_ai_request_max_tokens": "optional int64",
        "other_parameters": "repeated foxglove.KeyValuePair",
        "gen_ai_input_messages": "repeated ChatMessage",
        "gen_ai_output_messages": "repeated ChatMessage",
        "gen_ai_response_finish_reasons": "repeated string",
        "gen_ai_response_time_to_first_chunk": "double",
        "gen_ai_usage_input_tokens": "uint64",
        "gen_ai_usage_cache_read_input_tokens": "uint64",
        "gen_ai_usage_output_tokens": "uint64",
        "duration_s": "double",
        "prepared_tokens": "uint64",
        "prepared_s": "double",
        "output_schema": "string",
        "neutral_messages": "repeated ChatMessage",
        "options": "repeated Option",
        "precedents": "repeated Precedent",
        "kind": "string",
    },
}

EVENT: Definitions = {
    "Detection": {
        "label": "string",
        "confidence": "double",
        "left": "int64",
        "top": "int64",
        "width": "int64",
        "height": "int64",
        "position": "foxglove.Point3",
        "cut_off": "bool",
    },
    "Event": {
        **STAMPED,
        "name": "string",
        "request": "optional uint64",
        "result": "string",
        "text": "string",
        "mission_time_s": "double",
        "deadline_s": "optional double",
        "frame_number": "optional int64",
        "detections": "repeated Detection",
        "llm_call": "LlmCall",
        "lost": "bool",
        "holding": "bool",
        "numb": "bool",
        "by": "string",
        "deed": "string",
        "was": "string",
        "confidence": "double",
        "unreachable": "bool",
    },
}

OUTCOME: Definitions = {
    "Candidate": {"place": "string", "source": "string", "probability": "optional double"},
    "TaskOutcome": {
        "kind": "string",
        "target": "string",
        "object": "optional string",
        "status": "string",
        "reason": "string",
        "location": "optional string",
        "goals": "repeated string",
        "visited": "repeated string",
        "things": "repeated string",
        "among": "repeated string",
        "parts": "repeated TaskOutcome",
        "put_at": "string",
    },
    "Outcome": {
        **STAMPED,
        "command": "string",
        "kind": "optional string",
        "target": "optional string",
        "object": "optional string",
        "status": "string",
        "reason": "string",
        "source": "optional string",
        "location": "optional string",
        "inquiries": "uint64",
        "visited": "repeated string",
        "llm_calls": "uint64",
        "candidates": "repeated Candidate",
        "mission_time_s": "double",
        "thinking_time_s": "double",
        "wall_time_s": "double",
        "run_dir": "optional string",
        "model_failure": "string",
        "goals": "repeated string",
        "tasks": "repeated TaskOutcome",
    },
}

_SCALARS = {
    "double": FieldDescriptorProto.TYPE_DOUBLE,
    "int64": FieldDescriptorProto.TYPE_INT64,
    "uint64": FieldDescriptorProto.TYPE_UINT64,
    "bool": FieldDescriptorProto.TYPE_BOOL,
    "string": FieldDescriptorProto.TYPE_STRING,
}


_DEPENDENCIES = (timestamp_pb2, KeyValuePair_pb2, Point3_pb2)

_UNUSED = 100_000
"""Fields that an older recording does not have get numbers from here on."""

Numbers = Mapping[tuple[str, str], int]
"""Field numbers, by message and field name."""


def _add_field(message: DescriptorProto, name: str, spec: str, number: int) -> None:
    """Add a field to a message; `spec` is as in a .proto file, without name and number."""
    label, _, kind = spec.rpartition(" ")
    field = message.field.add(name=name, number=number)
    field.label = (
        FieldDescriptorProto.LABEL_REPEATED
        if label == "repeated"
        else FieldDescriptorProto.LABEL_OPTIONAL
    )
    if label == "optional":
        field.proto3_optional = True
        field.oneof_index = len(message.oneof_decl)
        message.oneof_decl.add(name=f"_{name}")
    if kind in _SCALARS:
        field.type = _SCALARS[kind]
    else:
        field.type = (
            FieldDescriptorProto.TYPE_ENUM
            if kind == "Status"
            else FieldDescriptorProto.TYPE_MESSAGE
        )
        field.type_name = f".{kind}" if "." in kind else f".{PACKAGE}.{kind}"


def _describe(definitions: Definitions, numbers: Numbers) -> FileDescriptorProto:
    file = FileDescriptorProto(
        name=f"{PACKAGE}.proto",
        package=PACKAGE,
        syntax="proto3",
        dependency=[module.DESCRIPTOR.name for module in _DEPENDENCIES],
    )
    status = file.enum_type.add(name="Status")
    for number, name in enumerate(STATUS):
        status.value.add(name=name, number=number)
    for name, fields in definitions.items():
        message = file.message_type.add(name=name)
        for place, (field, spec) in enumerate(fields.items()):
            _add_field(message, field, spec, numbers.get((name, field), _UNUSED + place))
    return file


def classes(pool: DescriptorPool, definitions: Definitions, numbers: Numbers) -> dict[str, Any]:
    """The message classes by name, with these field numbers.

    Raises:
        TypeError: if the pool does not accept them.
    """
    pool.AddSerializedFile(_describe(definitions, numbers).SerializeToString())
    return {
        name: message_factory.GetMessageClass(pool.FindMessageTypeByName(f"{PACKAGE}.{name}"))
        for name in definitions
    }


def fresh_pool() -> DescriptorPool:
    """A separate pool, for classes other than today's."""
    pool = DescriptorPool()
    for module in _DEPENDENCIES:
        pool.AddSerializedFile(module.DESCRIPTOR.serialized_pb)
    return pool
