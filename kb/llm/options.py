"""Options of a language model, in this process or on a server."""

from dataclasses import dataclass

from kb.llm.sampling import Sampling


@dataclass(frozen=True, slots=True)
class ModelOptions:
    """How a model writes; the sampling defaults are the paper's.

    Attributes:
        context_tokens: size of the context window; for a server, as it was started.
        temperature: with 0, the likeliest token is always taken.
        top_p: share of the probability mass to sample from.
        max_tokens: length limit of a reply.
        seed: the same seed and prompt give the same reply, whatever was asked before; a server may
            ignore it.
        grammar: whether replies must conform to the request's JSON schema; a server is asked to.
    """

    context_tokens: int = 4096
    temperature: float = 0.6
    top_p: float = 0.9
    max_tokens: int = 512
    seed: int = 0
    grammar: bool = False

    @property
    def sampling(self) -> Sampling:
        """How the next token is chosen."""
        return Sampling(self.temperature, self.top_p, self.seed)


USUAL = ModelOptions()
"""The defaults."""
