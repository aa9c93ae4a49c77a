"""Reads recordings from before behaviours declared their meaning: it is taken from their names.

Nothing else relies on names, and nothing is added to these tables: whatever is written today
declares itself.
"""

from dataclasses import replace

from executive.records import Activity, NodeShape

SOURCES = {
    "person": "ReadCommand",
    "memory": "MemoryKnowsPlaces",
    "ontology": "OntologyKnowsObject OntologyKnowsPlace",
    "llm": "RankPlaces RankKinds WriteCommand Inquire Summarize Again AskFurniture AdoptFurniture",
    "user": "AskWhere AskWhichObject AskDoYouMean AskWhereToPut AskToPutDown ConfirmCommand",
}
"""The classes of each source."""

ACTIVITIES = {
    Activity.DRIVING: "DriveToCandidate Visit DriveBack DriveToSurface",
    Activity.LOOKING: "LookAtCandidate SeeTarget LookCloser LookForLost SeeLost",
    Activity.HANDLING: "PickUp PutDownAt PutDownThere",
    Activity.THINKING: "RankPlaces RankKinds WriteCommand Inquire Summarize Again AskFurniture",
    Activity.ASKING: SOURCES["user"],
}
"""The classes of each activity: what the robot does while one of them is running."""

SEARCHES = ("/go and look", "/another approach")
"""How the paths end of the sequences that search for the thing."""

STAGE_DEPTH = 2
"""How many levels below the root the stages of the mission are."""


def told_from_names(node: NodeShape) -> NodeShape:
    """The behaviour with the meaning that its class and path had when it was recorded."""
    searches = node.path.endswith(SEARCHES)
    return replace(
        node,
        source=_SOURCE_OF.get(node.class_name, ""),
        activity=Activity.SEARCHING if searches else _ACTIVITY_OF.get(node.class_name, ""),
        stage=node.path.count("/") == STAGE_DEPTH,
    )


def _rows(table: dict[str, str] | dict[Activity, str]) -> dict[str, str]:
    """The inverse table; if a name is in two rows, the first one counts."""
    return {name: row for row, names in reversed(table.items()) for name in names.split()}


_SOURCE_OF, _ACTIVITY_OF = _rows(SOURCES), _rows(ACTIVITIES)
