// The items of a questionnaire: points to choose from, a slider, or words.

import { element } from "./elements.js";
import { text } from "./texts.js";

const MOST_BUTTONS = 11; // more points are a slider

export function asked(item, { points, left, right }) {
  const ends = { left: item.left || left, right: item.right || right };
  const words = item.text || `${ends.left} – ${ends.right}`;
  const optional = item.needed ? null : element("span", { class: "optional" }, ` ${text("study.optional")}`);
  const legend = element("legend", { class: item.text ? null : "unseen", dir: "auto" }, words, optional);
  const choice = item.answer === "words" ? written(item, words)
    : points > MOST_BUTTONS ? slid(item, words, points, ends)
    : chosen(item, points, ends);
  const missing = element("p", { class: "missing", hidden: true }, text("study.missing"));
  return element("fieldset", { class: item.text ? "item" : "item pair" }, legend, ...choice, missing);
}

function written(item, words) {
  return [element("textarea", { name: item.name, rows: 3, maxlength: 4000, dir: "auto", "aria-label": words })];
}

function chosen(item, points, ends) {
  const choices = Array.from({ length: points }, (_, index) => {
    const value = index + 1;
    const end = value === 1 ? ends.left : value === points ? ends.right : "";
    return element("label", {},
      element("input", {
        type: "radio", name: item.name, value, "aria-label": end ? `${value}, ${end}` : `${value}`,
      }),
      element("span", { "aria-hidden": "true" }, `${value}`));
  });
  return [shownEnds(ends), element("div", { class: "points" }, ...choices)];
}

function slid(item, words, points, ends) {
  const slider = element("input", {
    type: "range", name: item.name, min: 1, max: points, step: 1,
    value: Math.ceil(points / 2), class: "unset", "aria-label": words,
    "aria-valuetext": text("study.not_set"),
  });
  const state = element("span", {}, text("study.not_set"));
  const set = () => {
    slider.classList.remove("unset");
    state.textContent = "";
    slider.setAttribute("aria-valuetext", `${slider.value} / ${points}`);
  };
  const meant = () => slider.dispatchEvent(new Event("input", { bubbles: true }));
  slider.addEventListener("input", set);
  slider.addEventListener("change", set);
  slider.addEventListener("click", meant); // the middle is an answer, too
  slider.addEventListener("pointerup", meant); // a finger on a slider makes no click
  slider.addEventListener("keydown", (event) => {
    if (event.key === "Enter" || event.key === " ") {
      event.preventDefault();
      meant();
    }
  });
  return [shownEnds(ends, state), slider];
}

function shownEnds({ left, right }, between = null) {
  return element("div", { class: "ends", "aria-hidden": "true" },
    element("span", { dir: "auto" }, left), between, element("span", { dir: "auto" }, right));
}

/** What was answered, and the items that still have to be. */
export function answersIn(fields, items) {
  const answers = {};
  const missing = [];
  items.forEach((item, index) => {
    const value = valueOf(fields[index]);
    if (value !== null) answers[item.name] = value;
    else if (item.needed) missing.push(fields[index]);
  });
  return { answers, missing };
}

export function mark(fields, missing) {
  for (const field of fields) field.querySelector(".missing").hidden = !missing.includes(field);
}

/** Fills in what was answered before. */
export function restore(fields, items, answers) {
  items.forEach((item, index) => {
    const value = answers[item.name];
    if (value === undefined) return;
    const field = fields[index];
    const point = field.querySelector(`input[type=radio][value="${Number(value)}"]`);
    if (point) point.checked = true;
    for (const other of field.querySelectorAll("textarea, input[type=range]")) {
      other.value = value;
      other.dispatchEvent(new Event("change"));
    }
  });
}

function valueOf(field) {
  const words = field.querySelector("textarea");
  if (words) return words.value.trim() || null;
  const found = field.querySelector("input:checked, input[type=range]:not(.unset)");
  return found ? Number(found.value) : null;
}
