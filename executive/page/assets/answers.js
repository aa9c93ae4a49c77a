// Buttons instead of typing: the answers of a question, and what one could begin with.

import { element } from "./elements.js";
import { address } from "./robot.js";
import { spoken, text } from "./texts.js";

const box = document.getElementById("answers");
const back = document.getElementById("asked-back");
const suggestions = document.getElementById("suggestions");
const SUGGESTED = 4;
const PLACES = ["where_is", "where_to_put", "where_to_go"];

/** Whether a place is the answer, and this one may be. */
export function mayBe(question, piece) {
  if (!PLACES.includes(question?.kind)) return false;
  if (question.options.length) return question.options.includes(piece.name);
  return piece.searched || question.kind !== "where_is";
}

export function showAnswers(question, things, home, say) {
  const had = box.contains(document.activeElement);
  box.replaceChildren();
  box.hidden = question === null;
  if (question) {
    box.setAttribute("aria-label", text("answers", { text: question.text }));
    box.append(...buttons(question, things, home, say));
  }
  return had;
}

/** Yes and no to what the robot has heard, beside whatever else it asks. */
export function showAskedBack(asked, settle) {
  const had = back.contains(document.activeElement);
  back.replaceChildren();
  back.hidden = !asked;
  if (asked) {
    back.append(
      element("p", { id: "asked-back-text" }, asked.text),
      element("div", {},
        button(text("yes"), () => settle(true)),
        button(text("no"), () => settle(false))));
  }
  return had;
}

function buttons(question, things, home, say) {
  if (question.kind === "confirm") {
    const names = question.options.length ? question.options : [question.about];
    return [
      button(text("yes"), () => say("yes"), pictureOf(names.find((name) => things[name]?.picture), things)),
      button(text("no"), () => say("no")),
    ];
  }
  if (home?.furniture.some((piece) => mayBe(question, piece))) {
    return [rooms(home, question, say), element("p", {}, text("choose_on_map")), dontKnow(say)];
  }
  const chosen = question.options.map((name) =>
    button(labelOf(name, things), () => say(name), pictureOf(name, things)));
  return chosen.length ? [...chosen, dontKnow(say)] : [dontKnow(say)];
}

function dontKnow(say) {
  return button(text("unknown"), () => say("I don't know"), null, "answer plain");
}

function rooms(home, question, say) {
  const offered = home.furniture.filter((piece) => mayBe(question, piece));
  const groups = home.rooms.map((room) => {
    const here = offered.filter((piece) => piece.room === room.name);
    return here.length && element("fieldset", {},
      element("legend", {}, room.label),
      element("div", {}, ...here.map((piece) =>
        button(piece.searched ? piece.words : text("delivery"), () => say(piece.name)))));
  });
  return element("div", { class: "rooms" }, ...groups.filter(Boolean));
}

export function showSuggestions(shown, things, say) {
  suggestions.hidden = !shown;
  suggestions.replaceChildren();
  if (!shown) return;
  suggestions.setAttribute("aria-label", text("suggestions"));
  const pictured = Object.keys(things).filter((name) => things[name].picture);
  const step = Math.max(1, Math.floor(pictured.length / SUGGESTED));
  const some = pictured.filter((_, index) => index % step === 0).slice(0, SUGGESTED);
  suggestions.append(
    element("p", {}, text("suggestions")),
    ...some.map((name) => {
      const words = text("suggestion", { thing: labelOf(name, things) });
      return button(words, () => say(words), pictureOf(name, things));
    }),
    button(text("ask_what"), () => say(text("ask_what")), null, "answer plain"));
}

function button(label, choose, picture = null, kind = "answer") {
  return element("button", { type: "button", class: kind, onclick: choose }, picture, label);
}

function labelOf(name, things) {
  return things[name]?.label ?? spoken(name);
}

function pictureOf(name, things) {
  if (!things[name]?.picture) return null;
  const source = address(`/thing/${encodeURIComponent(name)}.png`);
  return element("img", { src: source, alt: "", width: 160, height: 160 });
}
