// The home from above, and the places that the search is about. In `map` y points up; here down.

import { percent, said } from "./chances.js";
import { drawn, element } from "./elements.js";
import { called, spoken, text } from "./texts.js";

const map = document.getElementById("map");
const list = document.getElementById("places");
const MARGIN_M = 0.1;
const LETTER_M = 0.15;
const ABOVE_M = 0.36;
const MARKS = { open: "?", current: "→", empty: "✕", been: "•", unreached: "!", found: "✓" };
const layers = {};
let home = null;
let robotAt = null;
let underWay = false;

export function showHome(plan) {
  home = plan;
  map.replaceChildren();
  if (!plan) return;
  const [left, lower, right, upper] = plan.extent;
  map.setAttribute("viewBox", [left - MARGIN_M, -upper - MARGIN_M,
    right - left + 2 * MARGIN_M, upper - lower + 2 * MARGIN_M].join(" "));
  for (const name of ["floor", "way", "robot", "furniture", "marks", "people"]) {
    layers[name] = drawn("g");
    map.append(layers[name]);
  }
  layers.floor.append(
    ...plan.rooms.map(({ rectangle: [a, b, c, d] }) =>
      drawn("rect", { class: "room", x: a, y: -d, width: c - a, height: d - b })),
    ...plan.walls.map(([x, y, width, height]) =>
      drawn("rect", { class: "wall", x: x - width / 2, y: -y - height / 2, width, height })),
    ...plan.rooms.map((room) => {
      const [x, y] = freeSpot(room);
      return drawn("text", { class: "label of-room", "text-anchor": "middle", x, y: -y }, room.label);
    }));
  layers.people.append(figure(plan.person));
  showRobot(plan.robot);
  offerPlaces(null, () => false);
}

/** Draw the furniture; if a place is asked for, those pieces that it may be can be chosen. */
export function offerPlaces(choose, mayBe) {
  if (!home) return;
  layers.furniture.replaceChildren(...home.furniture.map((piece) => {
    const [x, y, yaw] = piece.at;
    const [depth, width] = piece.size;
    const turned = `translate(${x} ${-y}) rotate(${(-yaw * 180) / Math.PI})`;
    const choice = mayBe(piece) ? { class: "choice", onclick: () => choose(piece.name) } : {};
    return drawn("g", choice,
      drawn("rect", { class: "furniture", transform: turned, rx: 0.04,
        x: -depth / 2, y: -width / 2, width: depth, height: width }),
      piece.searched ? drawn("text", { class: "label", ...within(x, piece.words), y: -y + 0.07 }, piece.words) : null);
  }));
}

/** Where in a room its name is best read: far from furniture and from who is there. */
function freeSpot({ rectangle: [a, b, c, d] }) {
  const taken = [...home.furniture.map((piece) => piece.at), home.person, home.robot];
  const room = ([x, y]) => Math.min(...taken.map(([u, v]) => Math.hypot((x - u) / 2, y - v)));
  const spots = [0.5, 0.35, 0.65].flatMap((along) =>
    [0.5, 0.4, 0.6, 0.3, 0.7].map((up) => [a + (c - a) * along, b + (d - b) * up]));
  return spots.reduce((best, spot) => (room(spot) > room(best) + 0.1 ? spot : best));
}

/** A label at this place along x, or so that nothing of it is outside of the home. */
function within(x, label) {
  const [left, , right] = home.extent;
  const half = label.length * LETTER_M / 2;
  if (x - half < left) return { x: left + 0.08, "text-anchor": "start" };
  if (x + half > right) return { x: right - 0.08, "text-anchor": "end" };
  return { x, "text-anchor": "middle" };
}

function figure([x, y]) {
  return drawn("g", { transform: `translate(${x} ${-y})` },
    drawn("title", {}, text("map_person")),
    drawn("path", { class: "body", d: "M-.22 .26a.22 .22 0 0 1 .44 0z" }),
    drawn("circle", { class: "body", r: 0.13, cy: -0.1 }),
    drawn("text", { class: "label", "text-anchor": "middle", y: 0.5 }, text("map_person")));
}

export function showRobot(pose) {
  if (!home || !pose) return;
  robotAt = pose;
  const [x, y, yaw] = pose;
  if (!layers.robot.firstChild) {
    layers.robot.append(drawn("g", { class: "robot" },
      drawn("title", {}, text("map_robot")),
      drawn("circle", { r: 0.27 }),
      drawn("path", { d: "M.22 0L-.06 .15V-.15z" })));
  }
  layers.robot.firstChild.style.transform =
    `translate(${x}px, ${-y}px) rotate(${(-yaw * 180) / Math.PI}deg)`;
  describe();
}

export function showWay(points) {
  if (!home) return;
  underWay = Boolean(points?.length);
  layers.way.replaceChildren();
  if (underWay) {
    const way = points.map(([x, y]) => `${x},${-y}`).join(" ");
    layers.way.append(drawn("polyline", { class: "way", points: way }));
  }
  describe();
}

function describe() {
  const room = home.rooms.find(({ rectangle: [a, b, c, d] }) =>
    a <= robotAt?.[0] && robotAt?.[0] <= c && b <= robotAt?.[1] && robotAt?.[1] <= d);
  const where = room?.label ?? text("outside");
  const label = text(underWay ? "map_on_way" : "map", { room: where });
  if (map.getAttribute("aria-label") !== label) map.setAttribute("aria-label", label);
}

export function showPlaces(found) {
  const places = found?.places ?? [];
  list.replaceChildren(...(places.length
    ? [table(found), plan(found)].filter(Boolean) : [element("p", {}, text("no_search"))]));
  if (!home) return;
  const [x, y] = found?.sighting ?? [];
  const sighting = x === undefined ? null : drawn("circle", { class: "sighting", cx: x, cy: -y, r: 0.25 });
  layers.marks.replaceChildren(...[sighting, ...places.map(mark)].filter(Boolean));
}

/** A piece of furniture as the robot calls it. */
export function labelOf(name) {
  return home?.furniture.find((piece) => piece.name === name)?.label ?? spoken(name);
}

function mark({ place, state, turn }) {
  const piece = home.furniture.find((one) => one.name === place);
  if (!piece) return null;
  const [x, y] = piece.at;
  const beside = y + ABOVE_M > home.extent[3] - 0.15 ? ABOVE_M : -ABOVE_M; // none is outside
  return drawn("g", { class: `mark ${state}`, transform: `translate(${x} ${-y + beside})` },
    drawn("title", {}, `${piece.label}: ${text(`states.${state}`)}`),
    drawn("circle", { r: 0.21 }),
    drawn("text", { "text-anchor": "middle", y: 0.1 }, sign(state, turn)));
}

/** A place that is still to come has its number in the plan. */
function sign(state, turn) {
  return state === "open" && turn ? String(turn) : MARKS[state] ?? "?";
}

function table({ thing, places }) {
  const about = !thing ? "where_to" : places.some(({ state }) => state === "found") ? "where_found" : "where";
  const chances = places.some((place) => place.chance !== null);
  const heads = ["place", ...(chances ? ["chance"] : []), "source"];
  return element("table", {},
    element("caption", {}, text(about, { thing: spoken(thing) })),
    element("thead", {}, element("tr", {},
      ...heads.map((head) => element("th", { scope: "col" }, text(head))))),
    element("tbody", {}, ...places.map((place) => row(place, chances))));
}

/** What the robot means to do, if it goes by a plan. */
function plan({ places, ask_after: askAfter }) {
  const planned = places.filter(({ turn }) => turn).sort((a, b) => a.turn - b.turn);
  if (!planned.length) return null;
  const order = planned.map(({ place }) => labelOf(place)).join(", ");
  const key = askAfter < 0 ? "plan" : askAfter < planned.length ? "plan_ask" : "plan_then_ask";
  return element("p", {}, text(key, { order, count: askAfter }));
}

function row({ place, state, chance, sources, why, turn }, chances) {
  const likely = chance === null ? "" : percent(chance);
  return element("tr", { class: state },
    element("th", { scope: "row" }, `${sign(state, turn)} ${labelOf(place)}`,
      element("small", {}, [called("states", state), why].filter(Boolean).join(": "))),
    chances ? element("td", {}, chance === null ? "" : element("meter", {
      value: chance, max: 1, "aria-label": likely }), ` ${likely}`) : null,
    element("td", {}, ...said(sources).flatMap((one) => [element("span", { class: "source" }, one), " "])));
}
