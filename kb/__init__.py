"""Knowledge: the ontology, the language model, and what one makes of the other."""

import os

# llama.cpp's threads wait for one another at every layer. By default they wait spinning, which
# takes ten times as long as soon as something else, such as the simulator, wants a core. libgomp
# reads this once, when llama_cpp is imported.
os.environ.setdefault("OMP_WAIT_POLICY", "passive")
