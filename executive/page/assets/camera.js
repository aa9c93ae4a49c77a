// The latest picture, with a frame around what is recognised in it.

import { drawn } from "./elements.js";
import { address } from "./robot.js";
import { spoken, text } from "./texts.js";

const figure = document.getElementById("camera");
const box = figure.querySelector(".picture");
const image = figure.querySelector("img");
const frames = figure.querySelector("svg");
const caption = figure.querySelector("figcaption");
const LETTER = 0.62; // how wide a letter is, of its height
let shown = null;

/** The picture comes a moment later than what is told of it: then both are shown. */
export function showCamera(picture) {
  const comes = picture && picture.number !== shown?.number;
  shown = picture;
  box.hidden = !picture;
  if (!picture) caption.textContent = text("no_picture");
  else if (comes) {
    const { number, width, height } = picture;
    Object.assign(image, { src: address(`/camera/${number}.jpg`), width, height });
  } else if (image.complete) tell();
}

image.addEventListener("load", tell);
image.addEventListener("error", tell);

function tell() {
  if (!shown) return;
  frames.setAttribute("viewBox", `0 0 ${shown.width} ${shown.height}`);
  frames.replaceChildren(...framed(shown.seen ?? [], shown));
  const told = captionOf(shown.seen);
  if (caption.textContent !== told) caption.textContent = told;
  image.alt ||= text("camera_picture");
}

function captionOf(seen) {
  if (!seen) return text("not_examined");
  const things = seen.map(({ label, confidence }) =>
    text("seen", { thing: spoken(label), percent: Math.round(confidence * 100) })).join("; ");
  return things ? text("recognised", { things }) : text("nothing_recognised");
}

/** A frame around each, and all names over all frames. */
function framed(seen, whole) {
  const rectangles = seen.flatMap(({ box: [x, y, width, height] }) =>
    ["under-line", null].map((kind) => drawn("rect", { class: kind, x, y, width, height })));
  return [...rectangles, ...named(seen, whole)];
}

/** Each name above its frame or below, where no other name stands if there is such a place. */
function named(seen, whole) {
  const size = whole.height / 18;
  const taken = [];
  return seen.map(({ label, box: [left, top, , height] }) => {
    const long = label.length * size * LETTER;
    const x = Math.max(0, Math.min(left, whole.width - long));
    const spots = [-0.3, -1.5].map((up) => top + up * size)
      .concat([1, 2.2].map((down) => top + height + down * size))
      .filter((y) => y > size && y < whole.height);
    const isFree = (y) => !taken.some((other) =>
      Math.abs(y - other.y) < size * 1.1 && x < other.x + other.long && other.x < x + long);
    const y = spots.find(isFree) ?? spots[0] ?? top + size;
    taken.push({ x, y, long });
    return drawn("text", { x, y, "font-size": size }, spoken(label));
  });
}
