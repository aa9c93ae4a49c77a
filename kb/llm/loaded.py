"""A loaded model file, and its contexts."""

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
"""Options that are scored in parallel."""


class Loaded:
    """The model, with one context for writing and one for scoring, each created on demand.

    Belongs to one thread, except for the model's vocabulary.
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
        """Load the file; blocks. `checkpoint` is called during loading.

        Raises:
            ModelError: as `Gguf` does.
        """
        self.model = Gguf(path, gpu_layers, checkpoint)
        self._context: Callable[[int], Context] = lambda sequences: Context(
            self.model, n_ctx, sequences=sequences, threads=threads, kept=kept
        )

    @cached_property
    def writing(self) -> Context:
        """The context for replies."""
        return self._context(1)

    @cached_property
    def scoring(self) -> Context:
        """The context for scores."""
        return self._context(1 + SCORED_AT_ONCE)

    def sampler(self, sampling: Sampling, schema: Mapping[str, object] | None) -> Sampler:
        """A sampler for one reply; with a schema, the reply must conform to that JSON schema."""
        grammar = json_schema_to_gbnf(json.dumps(schema)) if schema else None
        return Sampler(self.model, sampling, grammar)

    @property
    def evaluated(self) -> int:
        """Tokens evaluated so far."""
        return sum(context.evaluated for context in self._contexts())

    def close(self) -> None:
        """Free the memory."""
        for context in self._contexts():
            context.close()
        self.model.close()

    def _contexts(self) -> list[Context]:
        """The contexts created so far."""
        return [self.__dict__[name] for name in ("writing", "scoring") if name in self.__dict__]
