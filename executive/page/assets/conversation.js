// What was said, and why.

import { inWords } from "./chances.js";
import { element } from "./elements.js";
import { labelOf } from "./home.js";
import { why } from "./robot.js";
import { called, text, textOr } from "./texts.js";

const list = document.getElementById("said");
const scroll = document.getElementById("scroll");
const MOST = 500;
const NEAR_END_PX = 80;
const FIRST = 3; // reasons that are shown at once

let atEnd = true;

/** Whoever has not scrolled up keeps seeing the end, whatever takes room below. */
scroll.addEventListener("scroll", () => { atEnd = isNearEnd(); });
new ResizeObserver(() => atEnd && toEnd()).observe(scroll);

function isNearEnd() {
  return scroll.scrollHeight - scroll.scrollTop - scroll.clientHeight < NEAR_END_PX;
}

export function forget() {
  list.replaceChildren();
}

export function add(entry) {
  const follows = atEnd;
  list.append(item(entry));
  while (list.children.length > MOST) list.firstElementChild.remove();
  if (follows || entry.who === "person") toEnd();
}

/** Before anything was said, what one could begin with is read from its beginning. */
export function toEnd() {
  if (!list.childElementCount) return;
  scroll.scrollTop = scroll.scrollHeight;
}

export function personHasSpoken() {
  return list.querySelector(".person") !== null;
}

function item(entry) {
  const who = text(`who.${entry.who}`);
  const said = entry.stop ? text(`stop_said.${entry.who}`) : entry.text;
  const at = new Date(entry.at * 1000);
  const time = at.toLocaleTimeString([], { hour: "2-digit", minute: "2-digit" });
  const kinds = entry.stop ? `${entry.who} stopped` : entry.who;
  return element("li", { class: kinds, id: `said-${entry.id}` },
    element("p", {}, element("span", { class: "unseen" }, `${who}: `), element("span", { dir: "auto" }, said)),
    element("div", { class: "under" },
      element("span", { "aria-hidden": "true" }, who),
      element("time", { datetime: at.toISOString() }, time),
      entry.run ? whyButton(entry) : null));
}

function whyButton(entry) {
  const button = element("button", {
    type: "button", class: "why", "aria-expanded": "false",
    "aria-label": text("why_of", { text: entry.text }),
    onclick: () => toggle(button, entry),
  }, text("why"));
  return button;
}

async function toggle(button, entry) {
  const item = button.closest("li");
  const shown = item.querySelector(".because");
  if (shown) {
    shown.remove();
    button.setAttribute("aria-expanded", "false");
    button.textContent = text("why");
    return;
  }
  button.setAttribute("aria-expanded", "true");
  button.textContent = text("why_hide");
  const because = element("div", { class: "because" }, element("p", {}, text("why_loading")));
  item.append(because);
  try {
    because.replaceChildren(reasons(await why(entry.run, entry.time_s)));
  } catch {
    because.replaceChildren(element("p", {}, text("why_lost")));
  }
  because.scrollIntoView({ block: "nearest" });
}

function reasons(decisions) {
  if (!decisions.length) return element("p", {}, text("why_none"));
  const [first, before] = [decisions.slice(0, FIRST), decisions.slice(FIRST)];
  const rest = before.length ? element("details", {},
    element("summary", {}, text("why_before", { count: before.length })),
    element("ol", {}, ...before.map(reason))) : "";
  return element("div", {}, element("ol", {}, ...first.map(reason)), rest);
}

function reason(decision) {
  const source = decision.source && called("said_by", decision.source);
  const others = decision.alternatives.map((other) =>
    element("li", {}, text("why_not", { what: told(other.what), why_not: told(other.why_not) })));
  return element("li", {},
    element("strong", {}, `${decision.question}: `), named(decision.answer),
    source ? element("em", {}, ` (${source})`) : null,
    others.length ? element("ul", {}, ...others) : null);
}

/** Things and places as the robot calls them, chances as the page does. */
function named(noted) {
  return inWords(noted).replace(/\w+_\w+/g, (name) => labelOf(name));
}

/** What the program calls its own parts is said as the person calls them. */
function told(noted) {
  return named(noted)
    .replace(/\b(?:the )?(ontology|llm)\b/g, (whole, part) => textOr(`parts.${part}`, whole));
}
