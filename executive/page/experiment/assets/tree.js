// A tree of behaviours, of any size: rows are made when they are seen, and changed where they must.

import { element } from "/elements.js";
import { spoken, text } from "/texts.js";

const SIGNS = { RUNNING: "▶", SUCCESS: "✓", FAILURE: "✕", INVALID: "·" };
const ALWAYS_OPEN = 1; // level down to which a tree is shown though nothing works in it
const still = ["INVALID", "", -1];

export class Tree {
  /** `choose(node)` is called with the place of the behaviour that is chosen. */
  constructor(choose) {
    this.choose = choose;
    this.all = false; // whether the reader wants all of it open, of whatever run
    this.box = element("div", { role: "tree", class: "tree", "aria-label": text("tree") });
    this.box.addEventListener("keydown", (event) => this.#key(event));
    this.show([]);
  }

  /** Show these behaviours, parents before their children. */
  show(nodes) {
    this.places = new Map(nodes.map((node, place) => [node.path, place]));
    this.nodes = nodes.map((node) => ({ ...node, name: spoken(node.name), inside: [], up: this.places.get(node.parent) ?? -1 }));
    this.roots = [];
    this.nodes.forEach((node, place) => {
      if (node.up < 0) this.roots.push(place);
      else this.nodes[node.up].inside.push(place);
      node.level = node.up < 0 ? 1 : this.nodes[node.up].level + 1;
    });
    this.states = nodes.map(() => still);
    this.rows = new Map();
    this.pinned = new Map(); // what the reader opened or closed
    this.chosen = -1;
    this.focused = 0;
    this.step = -1;
    this.box.replaceChildren();
  }

  /** Behaviours that are not as before, by place: [status, what it says, since which step]. */
  change(changed, step) {
    this.step = step;
    for (const [place, state] of Object.entries(changed)) {
      this.states[place] = state;
      const row = this.rows.get(Number(place));
      if (row) this.#fill(row, Number(place));
    }
    this.#arrange();
  }

  openAll(all) {
    this.all = all;
    this.pinned.clear();
    this.#arrange();
  }

  pick(place) {
    const before = this.rows.get(this.chosen);
    this.chosen = this.focused = place;
    for (let up = this.nodes[place].up; up >= 0; up = this.nodes[up].up) this.pinned.set(up, true);
    this.#arrange();
    for (const row of [before, this.rows.get(place)]) row?.setAttribute("aria-selected", String(row === this.rows.get(place)));
    this.reveal(place);
    this.choose(place);
  }

  /** None is chosen any more. */
  drop() {
    this.rows.get(this.chosen)?.setAttribute("aria-selected", "false");
    this.chosen = -1;
  }

  /** Scroll the tree, and nothing around it, to a behaviour that is out of sight. */
  reveal(place) {
    const row = this.rows.get(place);
    if (!row?.isConnected) return;
    const [at, seen] = [row, this.box.parentElement].map((one) => one.getBoundingClientRect());
    if (at.top < seen.top || at.bottom > seen.bottom) {
      this.box.parentElement.scrollTop += (at.top + at.bottom - seen.top - seen.bottom) / 2;
    }
  }

  /** Open are those in which something works or has just changed, unless the reader says else. */
  #isOpen(place) {
    const node = this.nodes[place];
    if (!node.inside.length) return false;
    return this.pinned.get(place) ?? (this.all || node.level <= ALWAYS_OPEN || this.works.has(place));
  }

  #arrange() {
    this.works = new Set();
    this.states.forEach(([status, , since], place) => {
      const now = status === "RUNNING" || (status !== "INVALID" && since === this.step);
      for (let up = this.nodes[place].up; now && up >= 0 && !this.works.has(up); up = this.nodes[up].up) this.works.add(up);
    });
    const seen = [];
    const walk = (place) => {
      seen.push(place);
      const open = this.#isOpen(place);
      const row = this.#row(place);
      if (this.nodes[place].inside.length && row.ariaExpanded !== String(open)) row.ariaExpanded = String(open);
      if (open) this.nodes[place].inside.forEach(walk);
    };
    this.roots.forEach(walk);
    this.seen = seen;
    if (!seen.includes(this.focused)) this.focused = seen[0] ?? 0;
    const rows = seen.map((place) => this.rows.get(place));
    if (rows.length !== this.box.children.length || rows.some((row, at) => row !== this.box.children[at])) {
      const had = this.box.contains(document.activeElement);
      this.box.replaceChildren(...rows);
      if (had) this.rows.get(this.focused)?.focus({ preventScroll: true });
    }
    rows.forEach((row, at) => {
      const index = seen[at] === this.focused ? 0 : -1;
      if (row.tabIndex !== index || !row.hasAttribute("tabindex")) row.tabIndex = index;
    });
  }

  #row(place) {
    if (!this.rows.has(place)) {
      const node = this.nodes[place];
      const row = element("div", {
        role: "treeitem", "aria-level": node.level, "aria-selected": "false",
        style: null, onclick: (event) => this.#clicked(event, place),
      },
      element("span", { class: "turn", "aria-hidden": "true" }),
      element("span", { class: "sign", "aria-hidden": "true" }),
      element("span", { class: "unseen" }),
      element("span", { class: "name" }, node.name),
      element("span", { class: "message" }));
      row.style.setProperty("--level", node.level);
      row.classList.add(node.kind, ...(node.inside.length ? ["parent"] : []));
      this.rows.set(place, row);
      this.#fill(row, place);
    }
    return this.rows.get(place);
  }

  #fill(row, place) {
    const [status, message] = this.states[place];
    const [, sign, said, , told] = row.children;
    if (row.dataset.status !== status) {
      row.dataset.status = status;
      sign.textContent = SIGNS[status] ?? "?";
      said.textContent = `${text(`statuses.${status}`)}: `;
    }
    if (told.textContent !== message) told.textContent = message;
  }

  #clicked(event, place) {
    if (event.target.classList.contains("turn")) this.#turn(place, !this.#isOpen(place));
    else this.pick(place);
    this.rows.get(place)?.focus({ preventScroll: true });
  }

  #turn(place, open) {
    if (!this.nodes[place].inside.length) return;
    this.pinned.set(place, open);
    this.#arrange();
  }

  #key(event) {
    const at = this.seen.indexOf(this.focused);
    const node = this.nodes[this.focused];
    const to = {
      ArrowDown: () => this.seen[at + 1],
      ArrowUp: () => this.seen[at - 1],
      Home: () => this.seen[0],
      End: () => this.seen.at(-1),
      ArrowRight: () => (this.#isOpen(this.focused) ? node.inside[0] : void this.#turn(this.focused, true)),
      ArrowLeft: () => (this.#isOpen(this.focused) ? void this.#turn(this.focused, false) : node.up),
      Enter: () => void this.pick(this.focused),
      " ": () => void this.pick(this.focused),
    }[event.key];
    if (!to || event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    const place = to();
    if (place === undefined || place < 0) return;
    this.rows.get(this.focused).tabIndex = -1;
    this.focused = place;
    this.rows.get(place).tabIndex = 0;
    this.rows.get(place).focus();
  }
}
