"""A model file that is loaded, and the contexts in which things are evaluated."""

import json
from collections.abc import Callable, Mapping
from functools import cached_property
from pathlib import Path

from llama_cpp.llama_grammar import json_schema_to_gbnf

from kb.llm.context import Context
from kb.llm.gguf import Checkpoint, Gguf
from kb.llm.kept import Kept
from kb.llm.sampler import Sampler
from kb.llm.sampling import Sampling

SCORED_AT_ONCE = 63
"""Options that are scored side by side."""


class Loaded:
    """The model, and a context to write in and one to score in, each made when it is needed.

    Belongs to one thread, but for the model's vocabulary.
    """

    def __init__(
        self,
        path: Path,
        n_ctx: int,
        *,
        threads: int | None = None,
        gpu_layers: int = 0,
        kept: Kept | None = None,
        checkpoint: Checkpoint = lambda: None,
    ) -> None:
        """Load the file; blocks. The checkpoint is called while it loads.

        Raises:
            ModelError: as `Gguf` does.
        """
        self.model = Gguf(path, gpu_layers, checkpoint)
        self._context: Callable[[int], Context] = lambda sequences: Context(
            self.model, n_ctx, sequences=sequences, threads=threads, kept=kept
        )

    @cached_property
    def writing(self) -> Context:
        """Where replies are written."""
        return self._context(1)

    @cached_property
    def scoring(self) -> Context:
        """Where options are scored."""
        return self._context(1 + SCORED_AT_ONCE)

    def sampler(self, sampling: Sampling, schema: Mapping[str, object] | None) -> Sampler:
        """Chooses the tokens of a reply, which is held to a JSON schema if one is given."""
        grammar = json_schema_to_gbnf(json.dumps(schema)) if schema else None
        return Sampler(self.model, sampling, grammar)

    @property
    def evaluated(self) -> int:
        """Tokens that were evaluated so far."""
        return sum(context.evaluated for context in self._contexts())

    def close(self) -> None:
        """Free the memory."""
        for context in self._contexts():
            context.close()
        self.model.close()

    def _contexts(self) -> list[Context]:
        """Those that were made."""
        return [self.__dict__[name] for name in ("writing", "scoring") if name in self.__dict__]
