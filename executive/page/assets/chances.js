// How likely something is, and who says so, in the person's words.

import { called } from "./texts.js";

const LEAST = 0.005; // who says less, of several, says nothing
const NOTED = /(^| )([01]\.\d\d)(?!\d| (?:m|kg|N|s)\b)(?: \((\w+ [01]\.\d\d(?:, \w+ [01]\.\d\d)*)\))?/g;

/** Of each source how much of a chance it gave; null: all of it. */
export function said(sources) {
  const all = Object.entries(sources).filter(([source]) => source);
  const named = all.filter(([, share]) => share === null || share >= LEAST || all.length === 1);
  return named.map(([source, share], at) => {
    const name = called("sources", source);
    const one = share !== null && named.length > 1 ? `${name} ${percent(share)}` : name;
    return at < named.length - 1 ? `${one}, ` : one;
  });
}

export function percent(share) {
  return share > 0 && share < 0.01 ? "<\u00a01\u00a0%" : `${Math.round(share * 100)}\u00a0%`;
}

/** What the robot noted for itself, such as "desk 0.32 (ontology 0.32, llm 0.00)". */
export function inWords(noted) {
  return noted.replace(NOTED, (_, before, chance, shares = "") => {
    const likely = percent(Number(chance) || LEAST / 2); // 0.00 was a little more before rounding
    const who = said(Object.fromEntries(shares.split(", ").filter(Boolean).map(share)));
    return `${before}${likely}${who.length ? ` (${who.join("")})` : ""}`;
  });
}

function share(noted) {
  const [source, much] = noted.split(" ");
  return [source, Number(much)];
}
