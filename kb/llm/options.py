"""What a language model is told about how to write, whether it runs here or at a server."""

from dataclasses import dataclass

from kb.llm.sampling import Sampling


@dataclass(frozen=True, slots=True)
class ModelOptions:
    """How a model writes; how freely, by default, is the paper's.

    Attributes:
        context_tokens: size of its context window; that of a server, as it was started with.
        temperature: 0 always takes the likeliest token.
        top_p: share of the probability that is sampled from.
        max_tokens: longest reply.
        seed: the same seed and prompt give the same reply, whatever was asked before; a server may
            not heed it.
        grammar: whether replies are held to the request's JSON schema; a server is asked to.
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
"""What is told if nothing else is."""
