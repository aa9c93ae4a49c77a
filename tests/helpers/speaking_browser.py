"""Stubs of a browser's speech, in place of its own: no recogniser and no voice is here to be had.

What a person says is what the test says that the recogniser hears; what is said aloud is kept.
"""

import json

from playwright.sync_api import Page as Tab

STUBS = """
window.SpeechRecognition = window.webkitSpeechRecognition = class {
  start() { window.recogniser = this; this.starts = true; }
  stop() { this.onend(); }
  abort() { this.aborted = true; this.onend(); }
};
window.aloud = [];
window.hushed = 0;
Object.defineProperty(window, "speechSynthesis", { value: {
  speak: (utterance) => window.aloud.push(utterance.text),
  cancel: () => { window.hushed += 1; },
  getVoices: () => [],
} });
"""
NO_SPEECH = """
for (const name of ["SpeechRecognition", "webkitSpeechRecognition", "speechSynthesis"]) {
  Object.defineProperty(window, name, { value: undefined });
}
"""


def hear(tab: Tab, *words: str, confidence: float = 0.9, final: bool = True) -> None:
    """The recogniser hears one of these; by itself it ends after what is final."""
    alternatives = [{"transcript": one, "confidence": confidence} for one in words]
    tab.evaluate(
        """([alternatives, isFinal]) => {
          const result = Object.assign(alternatives, { isFinal });
          window.recogniser.onresult({ results: [result] });
          if (isFinal) window.recogniser.onend();
        }""",
        [alternatives, final],
    )


def fail(tab: Tab, error: str) -> None:
    """The recogniser cannot."""
    told = f"recogniser.onerror({{ error: {json.dumps(error)} }}); recogniser.onend();"
    tab.evaluate(f"() => {{ {told} }}")


def aloud(tab: Tab, count: int = 0) -> list[str]:
    """What was said aloud, as soon as it is so much."""
    said: list[str] = tab.evaluate(
        """async (count) => {
          while (aloud.length < count) await new Promise((next) => setTimeout(next, 20));
          return aloud;
        }""",
        count,
    )
    return said
