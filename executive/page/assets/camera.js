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
let shown = -1;

export function showCamera(picture) {
  box.hidden = !picture;
  if (!picture) {
    caption.textContent = text("no_picture");
    return;
  }
  if (picture.number !== shown) {
    shown = picture.number;
    image.src = address(`/camera/${picture.number}.jpg`);
    image.width = picture.width;
    image.height = picture.height;
  }
  frames.setAttribute("viewBox", `0 0 ${picture.width} ${picture.height}`);
  const seen = picture.seen ?? [];
  frames.replaceChildren(...seen.flatMap((one) => framed(one, picture)));
  const things = seen.map(({ label, confidence }) =>
    text("seen", { thing: spoken(label), percent: Math.round(confidence * 100) })).join("; ");
  const nothing = picture.seen ? "nothing_recognised" : "not_examined";
  caption.textContent = things ? text("recognised", { things }) : text(nothing);
  image.alt = text("camera_picture");
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
