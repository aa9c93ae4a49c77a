// Stepping in: answers in the person's stead, what the robot says, where it goes.

import { element } from "/elements.js";
import { spoken, text } from "/texts.js";
import { tell } from "/experiment/wire.js";

const LONGEST = 1000;
const NAME = "experimenter";

/** Build the panel in this box; what is to be called for which notice of the board. */
export function stepIn(box) {
  const field = (label, values = {}) => element("input", { type: "text", maxlength: LONGEST, "aria-label": label, autocomplete: "off", ...values });
  const button = (label, act, values = {}) => element("button", { type: "button", onclick: act, ...values }, label);
  const name = field(text("your_name"), { maxlength: 60, placeholder: text("your_name"), value: localStorage.getItem(NAME) ?? "" });
  name.addEventListener("change", () => localStorage.setItem(NAME, name.value));
  /** Shows whether it is held, and not that it was pressed: so it changes when that is so. */
  const switching = (deed) => element("input", { type: "checkbox", onclick: (event) => {
    event.preventDefault();
    act(deed, { on: event.target.checked });
  } });
  const said = element("span", { role: "status" });
  const question = element("div", { class: "question" });
  const hold = switching("hold");
  const held = element("ol", { hidden: true });
  const places = element("select", { id: "send-to" });
  const elsewhere = element("div", {}, element("label", { for: "send-to" }, text("send_to")), places, button(text("send_there"), () => act("place", { place: places.value })));
  const holdPlaces = switching("hold_place");
  const choice = element("div", { class: "choice", role: "group", hidden: true });
  const labels = new Map();

  async function act(deed, values = {}) {
    said.textContent = "";
    try {
      await tell("intervene", { deed, by: name.value, ...values });
      said.textContent = text("done_so");
    } catch (error) {
      said.textContent = error.message;
    }
  }

  box.replaceChildren(
    element("h3", {}, text("step_in")), name,
    element("label", {}, hold, text("hold_words")),
    element("label", {}, holdPlaces, text("hold_places")), said,
    button(text("stop"), () => act("stop"), { class: "stop" }), question, elsewhere, choice, held);

  function ask(asked) {
    if (!asked) return question.replaceChildren(element("span", {}, text("asks_nothing")));
    const answer = (words) => act("answer", { question: asked.id, words });
    const options = asked.kind === "confirm" ? [text("yes"), text("no")] : asked.options;
    const words = field(text("answer_for"), { placeholder: text("answer_for") });
    const form = element("form", {}, words, element("button", {}, text("send")));
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      if (words.value.trim()) answer(words.value);
    });
    question.replaceChildren(element("span", {}, text("asked_now", asked)),
      ...[...options, text("unknown")].map((one) => button(spoken(one), () => answer(one))), form);
  }

  function row({ number, text: sentence }) {
    const words = field(text("held_words", { number }), { value: sentence });
    return element("li", { "data-number": number }, words,
      button(text("say_it"), () => act("words", { number, words: words.value })),
      button(text("drop_it"), () => act("words", { number, words: "" })));
  }

  /** A place that the robot has chosen waits: let it go there, or elsewhere. */
  function choose(waiting) {
    elsewhere.hidden = Boolean(waiting);
    choice.hidden = !waiting;
    if (!waiting) return choice.replaceChildren();
    const { to, place, among } = waiting;
    const others = (among.length ? among : [...labels.keys()]).filter((one) => one !== place);
    const sentence = text(`held_${to}`, { place: labels.get(place) ?? spoken(place) });
    const instead = element("select", { "aria-label": text("instead") },
      ...others.map((one) => element("option", { value: one }, labels.get(one) ?? spoken(one))));
    choice.setAttribute("aria-label", sentence);
    choice.replaceChildren(element("strong", {}, sentence),
      button(text("as_chosen"), () => act("place", { place })),
      instead, button(text("go_there_instead"), () => act("place", { place: instead.value })));
  }

  return {
    question: ask,
    choice({ holds, held: waiting }) {
      holdPlaces.checked = holds;
      choose(waiting);
    },
    words({ holds, held: waiting }) {
      hold.checked = holds;
      held.hidden = !waiting.length;
      const numbers = waiting.map((one) => String(one.number));
      for (const one of [...held.children]) if (!numbers.includes(one.dataset.number)) one.remove();
      const shown = [...held.children].map((one) => one.dataset.number);
      held.append(...waiting.filter((one) => !shown.includes(String(one.number))).map(row));
    },
    places(known) {
      known.forEach((one) => labels.set(one.name, one.label));
      places.replaceChildren(...known.map((one) => element("option", { value: one.name }, one.label)));
    },
  };
}
