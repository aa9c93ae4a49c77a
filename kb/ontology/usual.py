"""What a default location says in a home that it may not have been written for.

Files are written with a home in mind, and used in others: the paper's survey names eight pieces of
its own flat. In another home a name stands for its kind of furniture in its kind of room, and a
piece that happens to bear the name is no better than its like. How far a file means this home is
counted in the home: it is the share of the furniture it names that is here.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

from rdflib import OWL, RDF
from rdflib.term import Identifier

from executive.types.home import Place
from kb.ontology.graph import Graph
from kb.ontology.owl import OwlFile, ending

Kind: TypeAlias = tuple[str, str]
"""A class of furniture, and of the room that it stands in."""


def meant_here(
    files: Iterable[OwlFile], recorded: Iterable[str], relation: Identifier, here: Iterable[str]
) -> dict[str, float]:
    """How far each default location means the piece of this home that bears its name, 0 to 1.

    Args:
        files: who says so; where several name it, the one that is nearest to this home counts.
        recorded: all default locations that are used.
        relation: `hasDefaultLocation`.
        here: the furniture of this home.
    """
    used, home, found = set(recorded), set(here), dict[str, float]()
    for file in files:
        said = (end for _, how, end in file.triples if how in (relation, OWL.hasValue))
        named = set(map(ending, said)) & used
        share = len(named & home) / max(len(named), 1)
        found |= {name: max(share, found.get(name, 0.0)) for name in named}
    return found


def kind_of(piece: Identifier, graph: Graph, is_in: Identifier) -> Kind | None:
    """What a file says of a piece of furniture: its class and that of its room."""
    rooms = graph.objects(piece, is_in)
    kinds = (graph.objects(one, RDF.type) for one in (piece, *rooms[:1]))
    said = [next((ending(k) for k in of if k != OWL.NamedIndividual), "") for of in kinds]
    return (said[0], said[1]) if len(said) == 2 and all(said) else None


def standing_for(
    named: Mapping[str, Kind | None], home: Sequence[Place], meant: Mapping[str, float]
) -> dict[str, float]:
    """The share of the default locations that each piece of this home stands for; at most 1 in all.

    What has neither its name nor its kind here stands for nothing, and is missing from the sum.

    Args:
        named: the default locations, and the kind of each if a file says it.
        home: the furniture of this home.
        meant: how far each of them means the piece of its name.
    """
    shares = dict.fromkeys((place.name for place in home), 0.0)
    for name, kind in named.items():
        alike = [p.name for p in home if name == p.name or (p.kind, p.room_kind) == kind]
        itself = meant.get(name, 0.0) if name in shares else 0.0
        for place in alike:
            of_it = (1 - itself) / len(alike) + (itself if place == name else 0.0)
            shares[place] += of_it / len(named)
    return {place: share for place, share in shares.items() if share > 0}
