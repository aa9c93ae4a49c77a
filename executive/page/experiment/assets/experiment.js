// The experimenter's page: the mission that runs, past runs, two of them side by side.

import { element } from "/elements.js";
import { follow } from "/robot.js";
import { called, load, spoken, text, textOr } from "/texts.js";
import { past } from "/experiment/past.js";
import { LATEST, Reel } from "/experiment/reel.js";
import { stepIn } from "/experiment/wizard.js";
import { ask, tell } from "/experiment/wire.js";

await load("/experiment/english.json");

const state = document.getElementById("state");
const trouble = document.getElementById("trouble");
const deed = document.getElementById("deed");
const told = document.getElementById("told");
const together = document.getElementById("together");
const tabs = [...document.querySelectorAll("nav button")];
const MARKED_MS = 2000;
const reels = [...document.querySelectorAll(".reel")];
const live = new Reel(reels[0]);
const one = new Reel(reels[1]);
const names = [text("first_run"), text("second_run")];
const pair = names.map((name, at) => new Reel(reels[2 + at], (step) => {
  if (together.checked) pair[1 - at].aim(step);
}, name));
const runTitles = document.querySelectorAll(".pair h3.run");
const wizard = stepIn(document.getElementById("wizard"));
const listPast = past((run) => visit("one", run), (first, second) => visit("two", first, second));
const RUNS_OF = { one: 1, two: 2 };
let shownPair = "";
let mission = 0;
let known = -1;
let marking = 0;
let marked = 0;

function view(name) {
  for (const tab of tabs) {
    tab.setAttribute("aria-pressed", String(tab.dataset.view === name));
    if (tab.dataset.view === name) tab.hidden = false;
    document.getElementById(tab.dataset.view).hidden = tab.dataset.view !== name;
  }
  if (name === "past") listPast();
}

/** What is looked at stands in the address: so the browser's buttons go back, and load it again. */
function visit(name, ...runs) {
  location.hash = [name, ...runs].map(encodeURIComponent).join("/");
}

function showAddress() {
  const [name, ...runs] = location.hash.slice(1).split("/").map(decodeURIComponent);
  const isWhole = tabs.some((tab) => tab.dataset.view === name) && runs.length === (RUNS_OF[name] ?? 0);
  const shown = isWhole ? name : tabs.find((tab) => !tab.hidden).dataset.view;
  view(shown);
  if (shown === "one") openOne(...runs);
  if (shown === "two") openTwo(...runs);
}

function openOne(run) {
  if (run === one.run) return;
  document.getElementById("one-title").textContent = run;
  deed.textContent = "";
  told.hidden = true;
  one.open(run);
}

async function openTwo(first, second) {
  if (shownPair === `${first}/${second}`) return;
  const asked = shownPair = `${first}/${second}`;
  runTitles.forEach((title, at) => { title.textContent = `${names[at]}: ${[first, second][at]}`; });
  const box = document.getElementById("parting");
  box.replaceChildren(element("p", { role: "status" }, text("comparing", { one: first, other: second })));
  try {
    const [{ parting }] = await Promise.all([ask("parting", { one: first, other: second }), pair[0].open(first), pair[1].open(second)]);
    if (asked !== shownPair) return;
    box.replaceChildren(...parted(parting));
    if (parting) aimBoth(parting, behavioursFirst(parting.aspects)[0]);
  } catch (error) {
    if (asked === shownPair) box.replaceChildren(element("p", {}, error.message));
  }
}

/** Show both where they part, and in what, if that is a behaviour. */
function aimBoth({ tick }, { what }) {
  for (const reel of pair) reel.aim(tick ?? LATEST, what);
}

function parted(parting) {
  if (!parting) return [element("p", {}, text("alike"))];
  const where = parting.tick === null ? text("part_at_end") : text("part_at", { tick: parting.tick, time: parting.time_s.toFixed(2) });
  return [element("p", {}, element("strong", {}, where)),
    element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": where }, element("table", {},
      element("thead", {}, element("tr", {}, ...[text("heads.what"), ...names].map((head) => element("th", { scope: "col" }, head)))),
      element("tbody", {}, ...behavioursFirst(parting.aspects).map((aspect) => element("tr", {},
        element("th", { scope: "row" }, aspectName(parting, aspect)), ...[aspect.one, aspect.other].map((one) => element("td", {}, inWords(aspect, one))))))))];
}

function behavioursFirst(aspects) {
  return [...aspects].sort((one, other) => other.behaviour - one.behaviour);
}

/** Of a behaviour it begins with the status. */
function inWords({ behaviour }, said) {
  return behaviour ? said.replace(/^\w+/, (status) => called("statuses", status)) : said;
}

/** A behaviour is called by its name, and shown in both trees where it is pressed. */
function aspectName(parting, aspect) {
  const { what } = aspect;
  if (!aspect.behaviour) return what;
  return element("button", { type: "button", title: what, onclick: () => aimBoth(parting, aspect) }, spoken(what.split("/").at(-1)));
}

async function act(what, doing) {
  deed.textContent = text(doing);
  told.hidden = true;
  try {
    const answer = await tell(what, { run: one.run });
    deed.textContent = text(what === "view" ? "shown_in_rerun" : answer.same ? "same_today" : "other_today");
    told.hidden = !answer.text;
    told.textContent = answer.text ?? "";
  } catch (error) {
    deed.textContent = error.message;
  }
}

function showLive(now) {
  state.textContent = now.over ? text(now.mission ? "mission_over" : "no_mission", now) : text("mission_runs", now);
  if (now.mission !== mission || now.nodes !== known) {
    [mission, known] = [now.mission, now.nodes];
    if (now.nodes) live.open("live", true);
    return;
  }
  if (live.follow.checked && now.last >= 0) live.go(LATEST);
  clearTimeout(marking);
  marking = setTimeout(mark, now.over ? 0 : Math.max(0, marked + MARKED_MS - performance.now()));
}

/** Marks above the slider come seldom, and what came last is not left out. */
function mark() {
  marked = performance.now();
  live.refresh();
}

/** There is no robot: only what was recorded is shown. */
function showPast({ folder }) {
  state.textContent = text("runs_of", { folder });
  tabs[0].hidden = true;
  if (!document.getElementById("live").hidden) view("past");
}

for (const tab of tabs) {
  const runs = { one: () => [one.run], two: () => shownPair.split("/") }[tab.dataset.view] ?? (() => []);
  tab.addEventListener("click", () => visit(tab.dataset.view, ...runs()));
}
addEventListener("hashchange", showAddress);
document.getElementById("replay").addEventListener("click", () => act("replay", "replaying"));
document.getElementById("view").addEventListener("click", () => act("view", "opening"));

const connection = { open: "", lost: "disconnected", refused: "refused" };
const show = { fresh() {}, live: showLive, past: showPast, ...wizard };
follow(Object.keys(show), (name, value) => show[name](value), (how) => {
  trouble.hidden = !connection[how];
  trouble.textContent = connection[how] ? textOr(connection[how], "") : "";
}, "/experiment");
showAddress();
