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
  frames.replaceChildren(...(shown.seen ?? []).flatMap((one) => framed(one, shown)));
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

function framed({ label, box: [left, top, width, height] }, whole) {
  const size = whole.height / 18;
  const cut = left + label.length * size * LETTER > whole.width; // then it ends where the box does
  const rectangle = { x: left, y: top, width, height };
  const above = top > size * 1.3 ? top - size * 0.3 : top + height + size;
  return [
    drawn("rect", { class: "under-line", ...rectangle }),
    drawn("rect", rectangle),
    drawn("text", { x: cut ? left + width : left, y: above, "font-size": size,
      "text-anchor": cut ? "end" : "start" }, spoken(label)),
  ];
}
