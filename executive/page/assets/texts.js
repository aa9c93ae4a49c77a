// All that the page says by itself stands in one file of texts: english.json.

let texts = {};

const AGAIN_MS = 1500;

/** Get the file; without it nothing can be said, so it is tried until it is there. */
export async function load(file) {
  texts = await got(file);
  document.documentElement.lang = texts.language;
  document.title = texts.title;
  for (const element of document.querySelectorAll("[data-text]")) {
    element.textContent = text(element.dataset.text);
  }
  for (const element of document.querySelectorAll("[data-label]")) {
    element.setAttribute("aria-label", text(element.dataset.label));
  }
}

async function got(file) {
  for (;;) {
    try {
      return await (await fetch(file)).json();
    } catch {
      await new Promise((resolve) => setTimeout(resolve, AGAIN_MS));
    }
  }
}

/** A text by its key, such as "doing.ready", with what stands in braces filled in. */
export function text(key, values = {}) {
  const found = key.split(".").reduce((node, part) => node?.[part], texts);
  return String(found ?? key).replace(/\{(\w+)\}/g, (whole, name) => values[name] ?? whole);
}

/** The text of a key, if the file has it; otherwise what was given. */
export function textOr(key, otherwise) {
  const found = text(key);
  return found === key ? otherwise : found;
}

/** What a value of a kind is called, such as `not_done` of `last`: if the file does not say, by its name. */
export function called(kind, value) {
  return textOr(`${kind}.${value}`, spoken(value));
}

/** A name as one says it: high_table is "high table". */
export function spoken(name) {
  return String(name).replaceAll("_", " ");
}
