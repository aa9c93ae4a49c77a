from pathlib import Path

OWLREADY = "http://www.lesfleursdunormal.fr/static/_downloads/owlready_ontology.owl#"


HEAD = """<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"
  xmlns:rdfs="http://www.w3.org/2000/01/rdf-schema#" xmlns:owl="http://www.w3.org/2002/07/owl#"
  xmlns:h="http://robot-executive.org/household.owl#" xmlns:py="{ready}"
  xml:base="http://example.org/guest.owl">""".replace("{ready}", OWLREADY)


KETTLE = """<owl:Class rdf:about="#Kettle"><rdfs:label>kettle</rdfs:label>
  <rdfs:subClassOf rdf:resource="http://robot-executive.org/household.owl#Object"/></owl:Class>"""


TURTLE = """@prefix owl: <http://www.w3.org/2002/07/owl#> . @prefix py: <{ready}> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix h: <http://robot-executive.org/household.owl#> .
<http://example.org/guest.ttl> a owl:Ontology .
""".replace("{ready}", OWLREADY)


def rdf(folder: Path, content: str, name: str = "guest.owl") -> Path:
    path = folder / name
    path.write_text(content if content.startswith("<!") else f"{HEAD}{content}</rdf:RDF>")
    return path


OWL = """<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"
  xmlns:rdfs="http://www.w3.org/2000/01/rdf-schema#" xmlns:owl="http://www.w3.org/2002/07/owl#"
  xmlns:household="http://robot-executive.org/household.owl#" xml:base="http://example.org/more.owl">
  <owl:Ontology rdf:about=""/>{}</rdf:RDF>"""


ANNA = """<household:Person rdf:about="#anna"><rdfs:label>Anna</rdfs:label></household:Person>
<owl:Class rdf:about="http://robot-executive.org/household.owl#Pear"><rdfs:subClassOf>
<owl:Restriction>
  <owl:onProperty rdf:resource="http://robot-executive.org/household.owl#preferredBy"/>
  <owl:hasValue rdf:resource="#anna"/>
</owl:Restriction></rdfs:subClassOf></owl:Class>"""
