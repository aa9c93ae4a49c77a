// The browser says aloud what the robot says, if the person wants it.

import { text } from "./texts.js";

const synthesis = window.speechSynthesis;
const box = document.getElementById("voice");
const wanted = document.getElementById("aloud");
const trouble = document.getElementById("voice-trouble");
const WANTED = "aloud";
const TOGETHER_MS = 150; // what is said in one breath
const OWN_DOING = ["canceled", "interrupted"];
let waiting = [];
let timer = 0;
let held = false;
let news = false;

/** Whether it may speak; where the browser cannot, nothing is offered. */
export function offer(may) {
  box.hidden = !may || !synthesis;
  if (box.hidden) hush();
}

/** Only what comes from now on is said aloud, and not what was said before the page was opened. */
export function saysNews(is) {
  news = is;
}

/** Say it in place of what is being said. */
export function say(sentence) {
  if (box.hidden || !wanted.checked || !news) return;
  waiting.push(sentence);
  soon();
}

/** Be silent at once. */
export function hush() {
  waiting = [];
  synthesis?.cancel();
}

/** Be silent while somebody listens; what is said meanwhile is said aloud afterwards. */
export function hold(on) {
  held = on;
  if (held) synthesis?.cancel();
  else soon();
}

function soon() {
  if (!held) timer ||= setTimeout(speak, TOGETHER_MS);
}

function speak() {
  timer = 0;
  if (held || !waiting.length) return;
  const utterance = new SpeechSynthesisUtterance(waiting.join(" "));
  waiting = [];
  utterance.lang = text("spoken_language");
  utterance.voice = ownVoice(utterance.lang);
  utterance.onstart = () => tell("");
  utterance.onerror = ({ error }) => {
    if (!OWN_DOING.includes(error)) tell(text(error === "not-allowed" ? "voice_waits" : "voice_fails"));
  };
  synthesis.cancel();
  synthesis.speak(utterance);
}

/** A voice of this device, if it has one: what others say is sent to their maker. */
function ownVoice(language) {
  const voices = synthesis.getVoices().filter((voice) => voice.localService);
  const of = (part) => voices.find((voice) => voice.lang.replace("_", "-").startsWith(part));
  return of(language) ?? of(language.slice(0, 2)) ?? null;
}

function tell(what) {
  trouble.textContent = what;
}

function remembered() {
  try {
    return localStorage.getItem(WANTED) === "true";
  } catch {
    return false; // the browser may keep nothing
  }
}

wanted.checked = remembered();
wanted.addEventListener("change", () => {
  try {
    localStorage.setItem(WANTED, String(wanted.checked));
  } catch {
    // then it is for this time
  }
  tell("");
  hush();
});
