"""The files of an ontology: which of them count, and what they import."""

import re
from collections.abc import Iterable, Iterator, Sequence

from rdflib import OWL, RDF
from rdflib.term import Identifier

from executive.errors import InputError
from executive.text import printable
from kb.ontology.owl import OwlFile, ending

KEPT_BESIDE = frozenset(("home.owl", "config.toml", "home.toml", "facts.json"))
"""Names of what else is kept with a recording."""
_VERSION = re.compile(r"[/#][vV]?\d[\w.-]*")
"""What people write behind an IRI to name a version of it."""
LONGEST_IRI = 200
"""Characters of an IRI that are shown."""


class Library:
    """The loaded files; a later one with the IRI of an earlier one takes its place."""

    def __init__(self, files: Iterable[OwlFile], replaceable: Sequence[str]) -> None:
        """Choose among the files; those whose names are `replaceable` are replaced silently.

        Raises:
            InputError: if a file is called like another that is kept with a recording.
        """
        chosen: dict[str, OwlFile] = {}
        self._replaced: list[tuple[str, str]] = []
        for file in files:
            earlier = chosen.get(file.iri)
            if earlier and earlier.path.name not in replaceable:
                self._replaced.append((file.path.name, earlier.path.name))
            chosen[file.iri] = file
        self.files = tuple(chosen.values())
        names = set[str]()
        for file in self.files:
            if file.path.name in names | KEPT_BESIDE:
                where = printable(file.path)
                raise InputError(where, "another file has the same name", "rename one")
            names.add(file.path.name)

    def contents(self) -> dict[str, bytes]:
        """The files by name, as they were read."""
        return {file.path.name: file.content for file in self.files}

    def unmet_imports(self) -> Iterator[str]:
        """What files import that was not loaded, a sentence each: nothing is fetched."""
        for file in self.files:
            for iri in file.imports:
                if not _is_met(iri, self.files):
                    imports = f"{printable(file.path.name)} imports {printable(iri)[:LONGEST_IRI]}"
                    yield (
                        f"{imports}, which is not loaded, and nothing is fetched: what it says is "
                        "not known; if it is needed, give the file that holds it with --kb"
                    )

    def warnings(self, known: set[Identifier]) -> Iterator[str]:
        """Which files add less than one may think, if these are the entities that are used."""
        yield from self.unmet_imports()
        for name, earlier in map(_both_printable, self._replaced):
            right = "give them IRIs of their own, if both are to count"
            yield f"{name} takes the place of {earlier}, which declares the same IRI: {right}"
        for file in self.files:
            declares = any(p == RDF.type and o != OWL.Ontology for _, p, o in file.triples)
            used = not known.isdisjoint(subject for subject, _, _ in file.triples)
            if not used and (declares or not file.triples):
                yield (
                    f"{printable(file.path.name)} adds nothing that the robot uses: put its "
                    "classes below Object, Furniture, Room or Person of household.owl "
                    "(rdfs:subClassOf)"
                )


def _is_met(imported: str, files: Iterable[OwlFile]) -> bool:
    """Whether one of the files is what is imported: by its IRI, a version of it, or its name."""
    wanted = imported.rstrip("#/")
    for file in files:
        iri = file.iri.rstrip("#/")
        rest = wanted.removeprefix(iri)
        if not rest or _VERSION.fullmatch(rest):
            return True
        if wanted in (version.rstrip("#/") for version in file.versions):
            return True
        if ending(wanted) in (file.path.name, file.path.stem, ending(iri)):
            return True
    return False


def _both_printable(names: tuple[str, str]) -> tuple[str, str]:
    return printable(names[0]), printable(names[1])
