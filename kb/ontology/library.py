"""The files of an ontology: which of them are used, and what they import."""

import re
from collections.abc import Iterable, Iterator, Sequence

from rdflib import OWL, RDF
from rdflib.term import Identifier

from executive.errors import InputError
from executive.text import printable
from kb.ontology.owl import OwlFile, ending

KEPT_BESIDE = frozenset(("home.owl", "config.toml", "home.toml", "facts.json"))
"""Names of other files that are stored with a recording."""
_VERSION = re.compile(r"[/#][vV]?\d[\w.-]*")
"""A version at the end of an IRI."""
LONGEST_IRI = 200
"""Characters of an IRI in a message."""


class Library:
    """The loaded files; a later file replaces an earlier one with the same IRI."""

    def __init__(self, files: Iterable[OwlFile], replaceable: Sequence[str]) -> None:
        """Choose the files; those with `replaceable` names are replaced without a warning.

        Raises:
            InputError: if two files, or a file and another one of a recording, have the same name.
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
        """The contents of the files, by name."""
        return {file.path.name: file.content for file in self.files}

    def unmet_imports(self) -> Iterator[str]:
        """A sentence for each import that is not loaded; nothing is fetched."""
        for file in self.files:
            for iri in file.imports:
                if not _is_met(iri, self.files):
                    imports = f"{printable(file.path.name)} imports {printable(iri)[:LONGEST_IRI]}"
                    yield (
                        f"{imports}, which is not loaded, and nothing is fetched: what it says is "
                        "not known; if it is needed, give the file that holds it with --kb"
                    )

    def warnings(self, known: set[Identifier]) -> Iterator[str]:
        """Sentences about imports that are not loaded, and files that add less than expected.

        `known` are the entities that are used.
        """
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
    """Whether one of the files is the imported one, by its IRI, a version of it, or its name."""
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
