// A study: what the participant reads, answers and does, around the page by which they talk.

import { element } from "./elements.js";
import { answersIn, asked, mark, restore } from "./questions.js";
import { post } from "./robot.js";
import { text } from "./texts.js";

const sheet = element("main", { id: "sheet", "aria-labelledby": "sheet-title" });
const task = element("section", { id: "task", "aria-labelledby": "task-title" });
let shown = {};

document.body.dataset.study = "sheet";
document.body.append(sheet);
document.querySelector("main").before(task);
document.addEventListener("study", (event) => show(event.detail));

function show(step) {
  if (!step.step || (step.step === shown.step && step.waits === shown.waits)) return;
  const again = step.step === shown.step;
  shown = step;
  document.body.dataset.study = step.kind === "task" ? "task" : "sheet";
  document.body.dataset.kind = step.kind;
  document.body.dataset.step = step.step;
  if (step.kind === "task") showTask(step, again);
  else showSheet(step);
}

async function done(value, step = shown.step) {
  const answer = await post("/study", { step, value }).catch(() => null);
  if (answer?.ok) return sessionStorage.removeItem("draft");
  if (answer?.status === 409) return; // another page was faster
  for (const place of document.querySelectorAll(".study-trouble")) {
    place.textContent = text("study.lost");
  }
}

function paragraphs(words) {
  return words.split(/\n\s*\n/).filter((one) => one.trim()).map((one) => element("p", { dir: "auto" }, one.trim()));
}

function outOfTime(step) {
  return step.out_of_time ? [element("p", {}, text("study.out_of_time"))] : [];
}

function button(label, onclick, kind = "") {
  return element("button", { type: "button", class: `step ${kind}`, onclick }, text(label));
}

function trouble() {
  return element("p", { class: "study-trouble", role: "alert" });
}

// --- sheets ---

function showSheet(step) {
  const now = Math.min(step.done + 1, step.steps);
  const title = element("h1", { id: "sheet-title", tabindex: "-1", dir: "auto" }, text(`study.${step.kind}`, step));
  sheet.replaceChildren(
    step.steps ? element("p", { class: "place" }, text("study.place", { ...step, now })) : "",
    step.steps ? element("progress", { max: step.steps, value: step.kind === "thanks" ? step.steps : step.done, "aria-hidden": "true" }) : "",
    title, ...outOfTime(step), ...paragraphs(wordsOf(step)), ...inputs(step));
  scrollTo(0, 0);
  title.focus({ preventScroll: true });
}

function wordsOf(step) {
  if (step.kind === "declined") return text("study.declined_text");
  return step.text || (step.kind === "part" ? text("study.part_text") : "");
}

function inputs(step) {
  switch (step.kind) {
    case "consent":
      return [buttons(button("study.agree", () => done("agreed"), "main"),
        button("study.disagree", () => done("declined"))), trouble()];
    case "instructions":
    case "part":
      return [buttons(button("study.go_on", () => done("read"), "main")), trouble()];
    case "questionnaire":
      return [form(step)];
    default:
      return [];
  }
}

function buttons(...children) {
  return element("div", { class: "buttons" }, ...children);
}

function form(step) {
  const items = step.items.map((item) => asked(item, step));
  const told = trouble();
  const made = element("form", { novalidate: true }, ...items, told,
    buttons(element("button", { type: "submit", class: "step main" }, text("study.send"))));
  restore(items, step.items, draft(step));
  let sent = false; // only then what is missing is told
  const tell = ({ missing }) => {
    mark(items, missing);
    told.textContent = missing.length ? text("study.missing_count", { count: missing.length }) : "";
  };
  made.addEventListener("input", () => {
    const filled = answersIn(items, step.items);
    keep(step, filled.answers);
    if (sent) tell(filled);
  });
  made.addEventListener("submit", (event) => {
    event.preventDefault();
    sent = true;
    const filled = answersIn(items, step.items);
    tell(filled);
    const { answers, missing } = filled;
    if (missing.length) missing[0].querySelector("input, textarea").focus();
    else done(answers, step.step);
  });
  return made;
}

// What was filled in and not sent outlives a page that is loaded again, and no more.

function draft({ participant, step }) {
  const kept = JSON.parse(sessionStorage.getItem("draft") ?? "{}");
  return kept.participant === participant && kept.step === step ? kept.answers : {};
}

function keep({ participant, step }, answers) {
  sessionStorage.setItem("draft", JSON.stringify({ participant, step, answers }));
}

// --- tasks ---

function showTask(step, again) {
  if (again) return offer(task.querySelector(".buttons"));
  const title = element("h2", { id: "task-title", tabindex: "-1" }, text("study.task", step));
  const ways = element("div", { class: "buttons" });
  task.replaceChildren(title,
    element("div", { class: "words", tabindex: "0", role: "group", "aria-labelledby": "task-title" },
      ...outOfTime(step), ...paragraphs(step.text)),
    ways, trouble());
  if (step.waits) ways.append(element("p", {}, text("study.waits")));
  else offer(ways);
  title.focus({ preventScroll: true });
}

function offer(ways) {
  ways.replaceChildren(
    button("study.finished", () => confirm(ways, "finished"), "main"),
    button("study.gave_up", () => confirm(ways, "gave_up")));
}

/** Asks once more: the robot would be stopped by a slip of a finger. */
function confirm(ways, how) {
  const no = button("study.no", () => {
    offer(ways);
    ways.querySelector("button").focus();
  });
  ways.replaceChildren(
    element("p", { role: "status" }, text(`study.sure_${how}`)),
    button("study.yes", () => done(how), "main"), no);
  no.focus();
}
