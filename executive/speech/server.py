"""Ears on a server: `POST /v1/audio/transcriptions`, as OpenAI and many others have it."""

import asyncio
from contextlib import aclosing

import httpx2

from executive.servers.address import bases_of, is_this_machine, refuse_secrets, without_secrets
from executive.servers.key import EARS_KEY, Key
from executive.servers.network import why
from executive.servers.refusal import MOST_BYTES, MOST_CHARACTERS, Refused, refusal
from executive.speech.interfaces import Reading
from executive.speech.sound import Sound, is_silent, to_wav
from executive.speech.transcript import NotATranscript, Transcript, transcript
from executive.text import printable

MODEL = "whisper-1"
"""The name of the first model of such servers; many accept any name."""
NOT_HERE = (404, 405, 501)
NOT_SO = (400, 415, 422)
"""HTTP statuses with which servers refuse an unsupported format of the reply."""
DENIED = (401, 403, 407)
BUSY = (429, 503, 529)
MOST_OF_A_REPLY = 1 << 20
"""The longest reply (bytes)."""


class ServerEars:
    """Implements `Ears`. It never retries: the person is asked to, and may type instead."""

    def __init__(
        self,
        url: str,
        *,
        model: str | None = None,
        language: str = "en",
        key: Key | None = None,
        timeout_s: float = 20.0,
    ) -> None:
        """Prepare to use a server; nothing is sent yet.

        Args:
            url: address of the server, with or without `/v1`.
            model: name of the model on the server.
            language: the spoken language, an ISO 639-1 code.
            key: sent as a bearer token, to this server only.
            timeout_s: how long a reply may take (s).

        Raises:
            InputError: if the address has a user or a password in it.
        """
        refuse_secrets(url, EARS_KEY)
        self._shown = without_secrets(url)
        self.name = model or self._shown
        self._key = key or Key()
        self._timeout_s = timeout_s
        self._fixed_fields = {"model": model or MODEL, "language": language}
        self._bases = bases_of(url)
        self._formats: tuple[str, ...] = ("verbose_json", "json")

    @property
    def note(self) -> str:
        """What to tell the person about privacy; empty if no sound leaves this machine."""
        if is_this_machine(self._bases[0]):
            return ""
        openly = "" if self._shown.startswith("https:") else ", and anyone on the way can listen"
        return f"What you say aloud is sent to {self._shown}{openly}."

    def hear(self, sound: Sound) -> Reading:
        """Send the utterance, unless it is silent."""
        if is_silent(sound):
            return Reading(self.name, "")
        try:
            heard = asyncio.run(self._within_timeout(to_wav(sound)))
        except Exception as error:  # whatever a server does, listening goes on
            return Reading(self.name, "", problem=self._reason(error))
        return Reading(self.name, self._key.hidden_in(heard.text), heard.confidence)

    def close(self) -> None:
        """Do nothing: no connection stays open."""

    async def _within_timeout(self, wav: bytes) -> Transcript:
        async with (
            asyncio.timeout(self._timeout_s),
            httpx2.AsyncClient(
                timeout=self._timeout_s,
                headers={**self._key.headers(), "Accept-Encoding": "identity"},
                trust_env=not is_this_machine(self._bases[0]),
            ) as client,
        ):
            return await self._transcribed(client, wav)

    async def _transcribed(self, client: httpx2.AsyncClient, wav: bytes) -> Transcript:
        """Try each address and format until the server answers; remember which worked."""
        refused: list[Refused] = []
        for base in self._bases:
            for form in self._formats:
                try:
                    heard = transcript(await self._reply(client, base, form, wav))
                except Refused as error:
                    refused.append(error)
                    if error.status not in (*NOT_HERE, *NOT_SO):
                        raise
                    if error.status in NOT_HERE:
                        break
                else:
                    self._bases, self._formats = (base,), (form,)
                    return heard
        raise refused[0]

    async def _reply(self, client: httpx2.AsyncClient, base: str, form: str, wav: bytes) -> bytes:
        fields = {**self._fixed_fields, "response_format": form}
        file = {"file": ("said.wav", wav, "audio/wav")}
        url = f"{base}/audio/transcriptions"
        async with client.stream("POST", url, data=fields, files=file) as response:
            if response.is_redirect:
                there = without_secrets(response.headers["Location"])
                raise Refused(response.status_code, f"it sends to {there}; give that address")
            if response.status_code != 200:
                body = await _read(response, MOST_BYTES)
                raise refusal(response.status_code, response.headers, body)
            body = await _read(response, MOST_OF_A_REPLY + 1)
        if len(body) > MOST_OF_A_REPLY:
            raise NotATranscript("it is too long")
        return body

    def _reason(self, error: Exception) -> str:
        """Why it failed, as a clause; the key is removed if the server's message has it."""
        match error:
            case TimeoutError() | httpx2.TimeoutException():
                return f"{self._shown} did not answer within {self._timeout_s:g} s"
            case Refused():
                told = Refused(error.status, self._key.hidden_in(error.says))
                return self._shortened(f"{self._shown} refused ({told})") + self._advice(error)
            case NotATranscript():
                return f"the reply of {self._shown} cannot be read: {error}"
            case httpx2.TransportError():
                return f"{self._shown} cannot be reached: {self._shortened(why(error))}"
            case _:
                return f"{self._shown} failed: {self._shortened(repr(error))}"

    def _advice(self, refused: Refused) -> str:
        if refused.status in DENIED:
            return f"; check {EARS_KEY}" if self._key else f"; set {EARS_KEY}"
        if refused.status in BUSY and refused.wait_s:
            return f"; it asks to wait {refused.wait_s:.0f} s"
        return ""

    def _shortened(self, text: str) -> str:
        text = self._key.hidden_in(printable(text))
        return text[: 2 * MOST_CHARACTERS] + "..." * (len(text) > 2 * MOST_CHARACTERS)


async def _read(response: httpx2.Response, most: int) -> bytes:
    """Read the beginning of the response.

    Raises:
        NotATranscript: if it is compressed, which was not requested.
    """
    coding = response.headers.get("Content-Encoding", "").strip().lower() or "identity"
    if coding != "identity":
        raise NotATranscript(f"it is packed ({printable(coding)}), which was not asked for")
    read = bytearray()
    async with aclosing(response.aiter_raw()) as parts:
        async for part in parts:
            read += part
            if len(read) >= most:
                break
    return bytes(read[:most])
