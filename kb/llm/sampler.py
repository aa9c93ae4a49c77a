"""Chooses the next token from the model's logits."""

from typing import Any

import llama_cpp

from executive.errors import ModelError
from kb.llm.context import Context
from kb.llm.gguf import Gguf
from kb.llm.sampling import Sampling


class Sampler:
    """Temperature, then top-p, then a seeded draw; a grammar, if given, is applied first.

    This is the order in the reference code of Llama 2.
    """

    def __init__(self, model: Gguf, sampling: Sampling, grammar: str | None = None) -> None:
        """Start a reply; `grammar` is in llama.cpp's GBNF.

        Raises:
            ModelError: if llama.cpp cannot parse the grammar.
        """
        params = llama_cpp.llama_sampler_chain_default_params()
        self._chain: Any = llama_cpp.llama_sampler_chain_init(params)
        steps: list[Any] = []
        if grammar is not None:
            held = llama_cpp.llama_sampler_init_grammar(model.vocabulary, grammar.encode(), b"root")
            if not held:
                self.close()
                raise ModelError("llama.cpp cannot read the grammar of the JSON schema")
            steps.append(held)
        if sampling.temperature > 0:
            steps += [
                llama_cpp.llama_sampler_init_temp(sampling.temperature),
                llama_cpp.llama_sampler_init_top_p(sampling.top_p, 1),
                llama_cpp.llama_sampler_init_dist(sampling.seed % (2**32 - 1)),
            ]
        else:
            steps.append(llama_cpp.llama_sampler_init_greedy())
        for step in steps:
            llama_cpp.llama_sampler_chain_add(self._chain, step)

    def sample(self, context: Context) -> int:
        """The next token after the last one of the context."""
        return int(llama_cpp.llama_sampler_sample(self._chain, context.pointer, -1))

    def close(self) -> None:
        """Free the memory."""
        llama_cpp.llama_sampler_free(self._chain)
