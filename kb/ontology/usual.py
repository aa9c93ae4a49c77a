"""What default locations mean in a home for which they may not have been written.

A file is written for one home and used in others: the paper's survey names eight pieces of its own
flat. In another home, a name stands for furniture of the same class in a room of the same class,
and a piece that happens to have the name is no better than others of its kind. How far a file was
written for this home is measured by the share of its furniture that exists here.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

from rdflib import OWL, RDF
from rdflib.term import Identifier

from executive.types.home import Place
from kb.ontology.graph import Graph
from kb.ontology.owl import OwlFile, ending

Kind: TypeAlias = tuple[str, str]
"""The class of a piece of furniture, and the class of its room."""


def meant_here(
    files: Iterable[OwlFile], recorded: Iterable[str], relation: Identifier, here: Iterable[str]
) -> dict[str, float]:
    """How far each default location means the piece of the same name in this home (0 to 1).

    Args:
        files: the files with default locations; if several name one, the best match counts.
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
    """The class of a piece of furniture and of its room, if a file states both."""
    rooms = graph.objects(piece, is_in)
    kinds = (graph.objects(one, RDF.type) for one in (piece, *rooms[:1]))
    said = [next((ending(k) for k in of if k != OWL.NamedIndividual), "") for of in kinds]
    return (said[0], said[1]) if len(said) == 2 and all(said) else None


def standing_for(
    named: Mapping[str, Kind | None], home: Sequence[Place], meant: Mapping[str, float]
) -> dict[str, float]:
    """The share of the default locations that each piece of this home represents.

    The shares sum to 1 at most: a location without a piece of its name or kind here is missing.

    Args:
        named: the default locations, each with its kind if a file states it.
        home: the furniture of this home.
        meant: for each location, how far it means the piece of its name (see `meant_here`).
    """
    shares = dict.fromkeys((place.name for place in home), 0.0)
    for name, kind in named.items():
        alike = [p.name for p in home if name == p.name or (p.kind, p.room_kind) == kind]
        itself = meant.get(name, 0.0) if name in shares else 0.0
        for place in alike:
            of_it = (1 - itself) / len(alike) + (itself if place == name else 0.0)
            shares[place] += of_it / len(named)
    return {place: share for place, share in shares.items() if share > 0}
