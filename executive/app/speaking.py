"""Sets up speech recognition and speech output, as the settings say."""

from contextlib import ExitStack
from pathlib import Path

from executive.app.parts import Parts
from executive.errors import InputError
from executive.language.phrases import spoken
from executive.servers.key import EARS_KEY, Key
from executive.speech.agreeing import Agreeing
from executive.speech.doubt import Doubt
from executive.speech.espeak import EspeakVoice
from executive.speech.interfaces import Ears, Vocabulary, Voice
from executive.speech.listening import Listening
from executive.speech.microphone import is_live, microphone
from executive.user import Console
from kb.ontology.ontology import Ontology


def speak_aloud(parts: Parts, opened: ExitStack) -> Doubt | None:
    """Start speech output and recognition, if the settings ask for them; `opened` closes them.

    Returns:
        What takes in recognised speech, ours or a page's; None if there is no person.

    Raises:
        InputError: if something that it needs is missing, or there is no person.
    """
    settings = parts.settings
    if not isinstance(parts.user, Console):
        if settings.ears is None and settings.voice is None:
            return None
        option = "--ears" if settings.ears else "--voice"
        raise InputError(option, "there is no person to talk with", "use --user console")
    doubt = Doubt(parts.user, parts.interpreter, parts.inbox)
    voice = None
    if settings.voice:
        voice = EspeakVoice()
        opened.callback(voice.close)
        parts.user.aloud = voice.say
    if settings.ears:
        listen(parts, parts.user, doubt, voice, opened)
    return doubt


def listen(
    parts: Parts, person: Console, doubt: Doubt, voice: Voice | None, opened: ExitStack
) -> None:
    """Start to listen to the person.

    Raises:
        InputError: if recogniser or microphone cannot be opened.
    """
    from executive.speech.spotting import StopSpotter  # of the extra `speech`

    ears = ears_of(parts, person)
    opened.callback(ears.close)
    spotter, blocks = StopSpotter(), microphone(parts.settings.microphone)
    live = is_live(parts.settings.microphone)
    listening = Listening(blocks, ears, doubt, person, spotter=spotter, voice=voice, live=live)
    opened.callback(listening.close)
    listening.start()


def ears_of(parts: Parts, person: Console) -> Ears:
    """The recogniser that the settings name; the person is told if sound leaves this machine.

    Raises:
        InputError: if it cannot be opened.
    """
    from executive.speech.sphinx import PocketsphinxEars  # of the extra `speech`

    settings = parts.settings
    local = PocketsphinxEars(vocabulary(parts.knowledge))
    if settings.ears in (None, local.name):
        return local
    if not settings.ears.startswith("http"):
        from executive.speech.sherpa import SherpaEars  # of the extra `speech-onnx`

        folder = Path(settings.ears).expanduser()
        own = SherpaEars(folder, settings.ears_language)
        return Agreeing(own, local, parts.interpreter.agrees)
    from executive.speech.server import ServerEars  # imports an HTTP client

    server = ServerEars(
        settings.ears,
        model=settings.ears_model,
        language=settings.ears_language,
        key=Key.from_environment(EARS_KEY),
        timeout_s=settings.ears_timeout_s,
    )
    if server.note:
        person.mention(server.note)
    return Agreeing(server, local, parts.interpreter.agrees)


def vocabulary(knowledge: Ontology) -> Vocabulary:
    """The names of the things and places of this home that a grammar of speech can have."""
    names = dict.fromkeys(spoken(name) for name in knowledge.names())
    things = [name for name in names if knowledge.objects_named(name)]
    places = [name for name in names if knowledge.places_named(name)]
    return Vocabulary(tuple(filter(_is_plain, things)), tuple(filter(_is_plain, places)))


def _is_plain(name: str) -> bool:
    """Whether a name has only letters and spaces: others have a meaning in a grammar of speech."""
    return name.isascii() and name.replace(" ", "").isalpha()
