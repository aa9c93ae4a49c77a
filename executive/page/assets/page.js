// The person's page: shows the board of the robot, and sends what the person says.

import { mayBe, showAnswers, showAskedBack, showSuggestions } from "./answers.js";
import { showCamera } from "./camera.js";
import * as conversation from "./conversation.js";
import * as ears from "./ears.js";
import { labelOf, offerPlaces, showHome, showPlaces, showRobot, showWay } from "./home.js";
import { OVER, answer, follow, say as send, settle, stop as sendStop } from "./robot.js";
import { called, load, spoken, text, textOr } from "./texts.js";
import * as voice from "./voice.js";

const doing = document.getElementById("doing");
const progress = document.getElementById("progress");
const last = document.getElementById("last");
const trouble = document.getElementById("trouble");
const form = document.getElementById("form");
const words = document.getElementById("words");
const stopButton = document.getElementById("stop");
const views = document.querySelectorAll(".views button");
const HOME = "#home";
const troubles = new Map();
const TROUBLES = ["stop", "wire", "choice", "say"]; // what matters most comes first
const LONGEST = 1000;
const TWO_TAPS_MS = 400;
let board = {};
let chosenAt = -TWO_TAPS_MS;
let showing = 0;
let stopping = false;

const show = {
  fresh() {
    board = {};
    conversation.forget();
    showHome(null);
    showPlaces(null);
    showCamera(null);
    showQuestion(null);
    askBack(null);
    voice.saysNews(false);
  },
  caught_up: () => voice.saysNews(true),
  said(entry) {
    conversation.add(entry);
    suggest();
    if (entry.who === "robot") voice.say(entry.text);
    else voice.hush();
  },
  doing: showDoing,
  outcome: () => showDoing(board.doing),
  question(question) {
    setTrouble("choice", ""); // it was about another one
    showQuestion(question);
  },
  asked_back(asked) {
    setTrouble("choice", "");
    askBack(asked);
  },
  speech(may) {
    voice.offer(may);
    ears.offer(may);
  },
  home(plan) {
    showHome(plan);
    showRobot(board.robot);
    showWay(board.path);
    showPlaces(board.places);
    showQuestion(board.question);
  },
  things: () => {
    suggest();
    showQuestion(board.question);
  },
  robot: showRobot,
  path: showWay,
  places(found) {
    showPlaces(found);
    showProgress();
  },
  camera: showCamera,
  study(step) {
    ears.drop();
    voice.hush();
    document.dispatchEvent(new CustomEvent("study", { detail: step }));
  },
};

function showDoing(state) {
  const sentence = state ? sentenceOf(state) : "…";
  if (doing.textContent !== sentence) doing.textContent = sentence;
  showProgress();
  const ended = ["ready", "rest"].includes(state?.state) && board.outcome;
  last.hidden = !ended;
  if (ended) last.textContent = howItEnded(board.outcome);
  suggest();
}

/** What nobody told the person is told here: what a robot that was stopped still holds, say. */
function howItEnded({ status, untold }) {
  return untold ? text("last_untold", { why: untold }) : called("last", status);
}

/** At which place a search is, of those in the table. */
function showProgress() {
  const places = board.doing?.place ? board.places?.places ?? [] : [];
  const [step, steps] = [places.filter(({ state }) => state !== "open").length, places.length];
  progress.hidden = steps < 2;
  if (progress.hidden) return;
  Object.assign(progress.querySelector("progress"), { max: steps, value: step });
  progress.querySelector("span").textContent = text("progress", { step, steps });
}

function sentenceOf(state) {
  if (state.state !== "busy") return text(`doing.${state.state}`);
  const { activity = "" } = state;
  const values = {
    activity: spoken(activity),
    thing: spoken(state.thing || "thing"),
    held: spoken(state.held ?? ""),
    place: labelOf(state.place ?? ""),
  };
  if (!activity) return text("doing.busy");
  if (activity === "driving" && state.place) return text(state.thing ? "doing.driving_to" : "doing.driving_to_see", values);
  if (activity === "driving" && state.held) return text("doing.driving_with", values);
  if (activity === "looking" && state.place) return text(state.thing ? "doing.looking_at" : "doing.looking_around", values);
  if (activity === "handling" && state.held) return text("doing.handling_held", values);
  return textOr(`doing.${activity}`, "") && text(`doing.${activity}`, values) || text("doing.other", values);
}

/** A question right after an answer waits a moment: the second tap of two is no answer to it. */
function showQuestion(question = null) {
  clearTimeout(showing);
  const wait = question ? chosenAt + TWO_TAPS_MS - performance.now() : 0;
  if (wait > 0) showing = setTimeout(() => offer(board.question), wait);
  else offer(question);
}

function offer(question) {
  const choose = (said) => chosen(said, question);
  const had = showAnswers(question, board.things ?? {}, board.home, choose);
  offerPlaces(choose, (piece) => mayBe(question, piece));
  if (had && !question) focusWords();
  conversation.toEnd();
  if (question) document.getElementById("answers").scrollIntoView({ block: "nearest" });
}

/** What can be chosen is taken away at once; it comes back if the choice did not reach the robot. */
async function chosen(said, question) {
  chosenAt = performance.now();
  setTrouble("choice", "");
  offer(null);
  try {
    await answer(said, question.id);
    setTrouble("say", "");
  } catch (error) {
    notChosen(error, said);
    if (error !== OVER) showQuestion(board.question);
  }
}

function notChosen(error, said) {
  if (error === OVER) setTrouble("say", text("too_late", { text: said }));
  else setTrouble("choice", text("not_chosen"));
}

function askBack(asked) {
  const had = showAskedBack(asked, (agrees) => settled(asked, agrees));
  if (had && !asked) focusWords();
  conversation.toEnd();
}

async function settled(asked, agrees) {
  chosenAt = performance.now();
  setTrouble("choice", "");
  askBack(null);
  try {
    await settle(asked.id, agrees);
    setTrouble("say", "");
  } catch (error) {
    notChosen(error, text(agrees ? "yes" : "no"));
    if (error !== OVER) askBack(board.asked_back);
  }
}

function suggest() {
  const shown = board.doing?.state === "ready" && !conversation.personHasSpoken();
  showSuggestions(shown && Boolean(board.things), board.things ?? {}, say);
}

function focusWords() {
  const touch = matchMedia("(pointer: coarse)").matches; // there it would open a keyboard
  (touch ? document.getElementById("scroll") : words).focus();
}

function setTrouble(name, message) {
  if (message) troubles.set(name, message);
  else troubles.delete(name);
  const shown = TROUBLES.map((one) => troubles.get(one)).filter(Boolean).join(" ");
  trouble.hidden = !shown;
  if (trouble.textContent !== shown) trouble.textContent = shown;
}

async function say(said) {
  try {
    await send(said);
    setTrouble("say", "");
    return true;
  } catch {
    setTrouble("say", text(said.length > LONGEST ? "too_long" : "not_sent", { most: LONGEST }));
    return false;
  }
}

async function stop() {
  ears.drop();
  voice.hush();
  if (stopping) return;
  stopping = true;
  stopButton.classList.add("sent");
  await sendStop(() => setTrouble("stop", text("stop_lost")));
  setTrouble("stop", "");
  stopButton.classList.remove("sent");
  stopping = false;
}

form.addEventListener("submit", async (event) => {
  event.preventDefault();
  const said = words.value.trim();
  if (!said) return;
  words.value = "";
  if (!(await say(said)) && !words.value) words.value = said;
});
stopButton.addEventListener("click", stop);
document.addEventListener("keydown", (event) => {
  if (event.key === "Escape" && !event.isComposing) {
    event.preventDefault();
    stop();
  }
}, true);
/** On a small screen: what the address says is shown, so that one goes back with the browser's button. */
function showView() {
  const view = location.hash === HOME ? "home" : "talk";
  document.body.dataset.view = view;
  for (const button of views) button.setAttribute("aria-pressed", String(button.dataset.view === view));
  conversation.toEnd();
}

for (const button of views) {
  button.addEventListener("click", () => {
    location.hash = button.dataset.view === "home" ? HOME : "";
  });
}
addEventListener("hashchange", showView);
showView();

const connection = {
  open: () => setTrouble("wire", ""),
  lost: () => setTrouble("wire", board.doing?.state === "over" ? "" : text("disconnected")),
  refused: () => setTrouble("wire", text("refused")),
};

await load("english.json");
words.placeholder = text("say_example", { thing: "mug" });
follow(Object.keys(show), (name, value) => {
  if (name !== "said") board[name] = value;
  show[name](value);
}, (state) => connection[state]());
