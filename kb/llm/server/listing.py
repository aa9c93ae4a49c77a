"""Selects the models of a server that can chat."""

import re
from collections.abc import Iterator

from executive.servers.refusal import Refused

MOST_MODELS = 1000
LONGEST_NAME = 200
_CALLED = ("id", "name", "model", "model_name")

_NO_CHAT = re.compile(
    r"embed|rerank|snowflake-arctic-(?!instruct)|paraphrase|\bbge\b|\bgte\b|\be5\b|minilm|mpnet|colbert|splade|\bmxbai\b|nomic-bert"
    r"|whisper|transcri|\b(?:tts|asr|stt)\b|speech|voxtral-mini-.*-transcribe|bark\b|musicgen|kokoro|parakeet|canary"
    r"|dall-?e|diffusion|stable-video|\bsdxl?\b|\bflux\b|\bimage\b|imagen|\bsora\b|\bveo\b"
    r"|moderation|llama-?guard|shield|\bclip\b|siglip|davinci-002|babbage-002|realtime",
    re.IGNORECASE,
)
_IS_NO_CHAT = re.compile(
    r"(?:not|n't) (?:an? )?(?:support(?:ed)? |available )?(?:for |in |with |the )*(?:\w+ )?"
    r"(?:chat|generat|text generation)"
    r"|chat.{0,40}(?:not|un)\s?supported|embedding|rerank"
    r"|model\b.{0,80}(?:not found|does(?: not|n't) exist|not (?:available|loaded|installed))"
    r"|no such model|unknown model",
    re.IGNORECASE | re.DOTALL,
)


def chat_models(listing: object) -> tuple[str, ...]:
    """The models in a listing; those whose names suggest another purpose come last.

    Accepts OpenAI's `{"data": [{"id": ...}]}`, a bare list, and Ollama's `{"models": [...]}`.
    """
    names = list(dict.fromkeys(_names(listing)))
    return tuple(sorted(names, key=lambda name: bool(_NO_CHAT.search(name.replace("_", "-")))))


def is_about_the_model(refused: Refused) -> bool:
    """Whether another model might accept what this one refused."""
    return bool(_IS_NO_CHAT.search(refused.says))


def _names(listing: object) -> Iterator[str]:
    if isinstance(listing, dict):
        listing = listing.get("data") or listing.get("models")
    if isinstance(listing, dict):
        listing = list(listing)
    for entry in listing[:MOST_MODELS] if isinstance(listing, list) else ():
        kind = entry.get("type") if isinstance(entry, dict) else None
        if kind in ("embedding", "embeddings", "rerank", "image", "audio", "moderation"):
            continue
        keys = map(entry.get, _CALLED) if isinstance(entry, dict) else (entry,)
        name = next((key for key in keys if isinstance(key, str) and key), None)
        if name and len(name) <= LONGEST_NAME and name.isprintable():
            yield name
