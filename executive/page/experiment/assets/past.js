// The past runs: found by words and by how they ended.

import { element } from "/elements.js";
import { called, text } from "/texts.js";
import { ask } from "/experiment/wire.js";

const table = document.getElementById("runs");
const find = document.getElementById("find");
const status = document.getElementById("status");
const found = document.getElementById("found");
const compare = document.getElementById("compare");
const TYPED_MS = 200;
const AGAIN_MS = 1500;
const SIDES = 2;
const picked = new Set();
let waiting = 0;
let asked = 0;

/** `open(run)` shows one, `both(one, other)` two side by side. */
export function past(open, both) {
  for (const box of [find, status]) {
    box.addEventListener("input", () => {
      clearTimeout(waiting);
      waiting = setTimeout(() => list(open), TYPED_MS);
    });
  }
  document.getElementById("search").addEventListener("submit", (event) => event.preventDefault());
  compare.addEventListener("click", () => both(...[...picked].sort()));
  offer();
  return () => list(open);
}

/** What was asked for before, and comes later, is not shown. */
async function list(open) {
  const number = ++asked;
  let told;
  try {
    told = await ask("runs", { words: find.value, status: status.value });
    if (number !== asked) return;
  } catch (error) {
    if (number !== asked) return;
    found.textContent = error.message;
    waiting = setTimeout(() => list(open), AGAIN_MS);
    return;
  }
  found.textContent = text("found", told);
  const chosen = status.value;
  status.replaceChildren(element("option", { value: "" }, text("any_status")),
    ...told.statuses.map((one) => element("option", { value: one }, called("ended", one))));
  status.value = chosen;
  if (!told.runs.length) {
    table.replaceChildren(element("caption", {}, text(told.all ? "none_found" : "no_runs")));
    return;
  }
  const heads = ["pick", "when", "command", "status", "reason", "seconds", "asked"];
  table.replaceChildren(
    element("thead", {}, element("tr", {}, ...heads.map((head) => element("th", { scope: "col" }, text(`heads.${head}`))))),
    element("tbody", {}, ...told.runs.map((run) => row(run, open))));
}

function offer() {
  compare.disabled = picked.size !== SIDES;
  compare.textContent = text("compare", { count: picked.size });
}

/** Of three that are chosen, the first is chosen no more. */
function pick(run, chosen) {
  picked.delete(run);
  if (chosen) picked.add(run);
  const [first] = picked;
  if (picked.size <= SIDES) return;
  picked.delete(first);
  for (const box of table.querySelectorAll("input")) if (box.value === first) box.checked = false;
}

function row(run, open) {
  const box = element("input", { type: "checkbox", value: run.run, "aria-label": text("pick_run", { run: run.run }), checked: picked.has(run.run) });
  box.addEventListener("change", () => {
    pick(run.run, box.checked);
    offer();
  });
  return element("tr", {},
    element("td", {}, box),
    element("th", { scope: "row" }, element("button", { type: "button", onclick: () => open(run.run) }, when(run.run))),
    element("td", {}, run.command || run.run),
    element("td", { class: `ended-${run.status}` }, called("ended", run.status)),
    element("td", {}, run.reason),
    element("td", {}, run.time_s === null ? "" : run.time_s.toFixed(1)),
    element("td", {}, run.asked ?? ""));
}

/** 20260102T030405Z-... as a time of the reader's. */
function when(run) {
  const found = /^(\d{4})(\d\d)(\d\d)T(\d\d)(\d\d)(\d\d)Z/.exec(run);
  if (!found) return run;
  const [year, month, ...rest] = found.slice(1).map(Number);
  return new Date(Date.UTC(year, month - 1, ...rest)).toLocaleString([], { dateStyle: "medium", timeStyle: "medium" });
}
