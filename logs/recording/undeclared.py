"""Recordings from before behaviours declared what they mean: there it is told from their names.

Nobody else goes by a name, and this table is closed: what is written today declares itself.
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
"""Who speaks through which classes."""

ACTIVITIES = {
    Activity.DRIVING: "DriveToCandidate Visit DriveBack DriveToSurface",
    Activity.LOOKING: "LookAtCandidate SeeTarget LookCloser LookForLost SeeLost",
    Activity.HANDLING: "PickUp PutDownAt PutDownThere",
    Activity.THINKING: "RankPlaces RankKinds WriteCommand Inquire Summarize Again AskFurniture",
    Activity.ASKING: SOURCES["user"],
}
"""What the robot does while a behaviour of one of these classes is running."""

SEARCHES = ("/go and look", "/another approach")
"""How the paths of the sequences end in which the robot looks for the thing."""

STAGE_DEPTH = 2
"""How many levels below the root the parts of the mission are."""


def told_from_names(node: NodeShape) -> NodeShape:
    """The behaviour with what its class and its path meant when it was recorded."""
    searches = node.path.endswith(SEARCHES)
    return replace(
        node,
        source=_SOURCE_OF.get(node.class_name, ""),
        activity=Activity.SEARCHING if searches else _ACTIVITY_OF.get(node.class_name, ""),
        stage=node.path.count("/") == STAGE_DEPTH,
    )


def _rows(table: dict[str, str] | dict[Activity, str]) -> dict[str, str]:
    """The table the other way round; of a name that is in two rows the first counts."""
    return {name: row for row, names in reversed(table.items()) for name in names.split()}


_SOURCE_OF, _ACTIVITY_OF = _rows(SOURCES), _rows(ACTIVITIES)
