// The browser listens, when the person presses the button or its key: until they are silent.

import { hears } from "./robot.js";
import { text, textOr } from "./texts.js";
import * as voice from "./voice.js";

const Recognition = window.SpeechRecognition ?? window.webkitSpeechRecognition;
const button = document.getElementById("speak");
const state = document.getElementById("hearing");
const interim = document.getElementById("interim");
const about = document.getElementById("about-speech");
const KEY = "F2";
const MOST = 5;
const LONGEST = 1000;
let listening = null;

/** Whether it may listen; where the browser cannot, nothing is offered. */
export function offer(may) {
  button.hidden = about.hidden = !may || !Recognition;
  if (button.hidden) drop();
}

/** Listen no more, and forget what is being said. */
export function drop() {
  listening?.drop();
}

class Listening {
  constructor() {
    this.utterance = `${Date.now()}-${Math.random()}`;
    this.latest = [];
    this.isOver = false;
    this.problem = "";
    this.recogniser = Object.assign(new Recognition(), {
      lang: text("spoken_language"), continuous: false, interimResults: true, maxAlternatives: MOST,
      onresult: ({ results }) => this.understand(Array.from(results)),
      onerror: ({ error }) => { this.problem = error; },
      onend: () => this.end(),
    });
  }

  start() {
    show(text("listening"), true);
    voice.hold(true);
    try {
      this.recogniser.start();
    } catch (error) {
      this.problem = error.name;
      this.end();
    }
  }

  /** What was said so far goes to the robot at once: it may be a stop. */
  understand(results) {
    if (this.isOver) return;
    const whole = results.every((result) => result.isFinal);
    this.latest = results.length === 1 ? alternatives(results[0]) : [joined(results)];
    interim.textContent = this.latest[0].words;
    this.send(whole);
  }

  async send(final) {
    if (final) this.isOver = true;
    try {
      const became = await hears(this.latest, this.utterance, final);
      if (became === "stopped") this.drop();
      if (became === "not ready") show(text("hears_later"));
    } catch {
      if (final) show(text("not_heard"));
    }
  }

  end() {
    if (listening !== this) return;
    listening = null;
    const told = this.problem || (this.latest.length ? "" : "no-speech");
    show(told && problem(told));
    if (this.latest.length && !this.isOver) this.send(true); // some browsers never say that it is final
    voice.hold(false);
  }

  drop() {
    this.isOver = true;
    this.recogniser.abort();
    if (listening !== this) return;
    listening = null;
    show("");
    voice.hold(false);
  }
}

function problem(error) {
  if (error === "aborted") return "";
  if (error === "not-allowed" && !window.isSecureContext) return text("ears_trouble.insecure");
  return textOr(`ears_trouble.${error}`, "") || text("ears_trouble.other", { error });
}

function alternatives(result) {
  return Array.from(result).slice(0, MOST).map(({ transcript, confidence }) => ({
    words: transcript.trim().slice(0, LONGEST), confidence: Math.min(Math.max(confidence || 0, 0), 1),
  }));
}

function joined(results) {
  const parts = results.map((result) => alternatives(result)[0]);
  return {
    words: parts.map(({ words }) => words).join(" ").slice(0, LONGEST),
    confidence: Math.min(...parts.map(({ confidence }) => confidence)),
  };
}

function show(what, listens = false) {
  state.textContent = what;
  interim.textContent = "";
  button.setAttribute("aria-pressed", String(listens));
}

/** Press once to begin; a second time to end it before one is silent. */
function toggle() {
  if (listening) return listening.recogniser.stop();
  listening = new Listening();
  listening.start();
}

button.addEventListener("click", toggle);
document.addEventListener("keydown", (event) => {
  if (event.key !== KEY || event.repeat || !button.offsetParent) return; // it is not to be seen
  event.preventDefault();
  toggle();
});
