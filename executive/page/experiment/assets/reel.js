// A mission, live or past: its tree at any tick, what happened up to then, and why.

import { drawn, element } from "/elements.js";
import { called, text } from "/texts.js";
import { Tree } from "/experiment/tree.js";
import { ask } from "/experiment/wire.js";

const KINDS = ["said", "event", "intervened", "model", "plan", "note", "mishap", "end"];
const SHOWN_AT_FIRST = ["said", "intervened", "model", "plan", "mishap", "end"];
const MARKS = ["said", "model", "intervened", "mishap", "end"];
export const LATEST = 1e9; // a step after all others
const REST_MS = 80; // the slider rests: now the lists beside the tree may follow
const READING_MS = 400;
let made = 0;

export class Reel {
  /** `moved(step)` is called when the reader has chosen another tick; `which` tells two apart. */
  constructor(box, moved = () => {}, which = "") {
    this.moved = moved;
    this.which = which;
    this.run = null;
    this.id = `reel${made++}`;
    this.tree = new Tree((node) => { this.node = node; this.#why(); });
    this.#build(box);
  }

  #build(box) {
    const button = (key, sign, act) => element("button", { type: "button", "aria-label": text(key), onclick: act }, sign);
    this.slider = element("input", { type: "range", min: 0, max: 0, value: 0, "aria-label": text("tick") });
    this.slider.addEventListener("input", () => this.#chosen(Number(this.slider.value)));
    this.follow = element("input", { type: "checkbox", id: `${this.id}-follow` });
    this.follow.addEventListener("change", () => this.follow.checked && this.go(LATEST));
    this.live = element("label", { hidden: true }, this.follow, ` ${text("follow")}`);
    this.moment = element("p", { class: "moment" });
    this.strip = drawn("svg", { class: "strip", preserveAspectRatio: "none", "aria-hidden": "true" });
    const all = element("input", { type: "checkbox" });
    all.addEventListener("change", () => this.tree.openAll(all.checked));
    this.why = element("div", { class: "why" });
    this.facts = element("dl", { class: "facts" });
    this.lines = element("ol", { class: "lines" });
    this.words = element("input", { type: "search", maxlength: 200, "aria-label": text("find_lines"), placeholder: text("find_lines") });
    this.words.addEventListener("input", () => this.#beside());
    this.kinds = KINDS.map((kind) => {
      const one = element("input", { type: "checkbox", value: kind, checked: SHOWN_AT_FIRST.includes(kind) });
      one.addEventListener("change", () => this.#beside());
      return one;
    });
    this.trouble = element("p", { class: "trouble", hidden: true });
    const part = (key, kind, ...inside) => element("section", { class: kind }, element("h3", {}, text(key)), ...inside);
    const scroll = (key, inside) => element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": this.#label(key) }, inside);
    box.replaceChildren(
      this.trouble,
      element("div", { class: "time" },
        element("div", { class: "buttons" },
          button("first", "|◀", () => this.#chosen(0)),
          button("before", "◀", () => this.#chosen(this.shown - 1)),
          button("next", "▶", () => this.#chosen(this.shown + 1)),
          button("last", "▶|", () => this.#chosen(LATEST)), this.live),
        element("div", { class: "track" }, this.strip, this.slider),
        this.moment),
      element("div", { class: "parts" },
        part("tree", "of-tree", element("label", {}, all, ` ${text("open_all")}`), element("div", { class: "scroll" }, this.tree.box)),
        element("div", { class: "beside" },
          part("why", "of-why", scroll("why", this.why)),
          part("happened", "of-lines",
            element("fieldset", {}, element("legend", { class: "unseen" }, text("kinds_shown")),
              ...this.kinds.map((one) => element("label", { class: `mark-${one.value}` }, one, ` ${text(`kinds.${one.value}`)}`)), this.words),
            scroll("happened", this.lines)),
          part("known", "of-facts", scroll("known", this.facts)))));
    this.#tellNothing();
  }

  /** What a part of it is called, so that it is not taken for that of the run beside it. */
  #label(key) {
    return [this.which, text(key)].filter(Boolean).join(": ");
  }

  /** Beside the tree stands why a behaviour has its status, or a call of the model. */
  #tell(key, ...children) {
    this.why.closest("section").querySelector("h3").textContent = text(key);
    this.why.parentElement.setAttribute("aria-label", this.#label(key));
    this.why.replaceChildren(...children);
  }

  /** No behaviour is chosen. */
  #tellNothing() {
    this.node = null;
    this.#tell("why", element("p", {}, text("choose_behaviour")));
  }

  /** Show a run, from its beginning, or as it goes on. */
  async open(run, live = false) {
    this.run = run;
    this.aimed = null;
    this.shown = -1;
    this.known = 0;
    this.tree.show([]);
    this.#tellNothing();
    this.live.hidden = !live;
    this.follow.checked = live;
    this.values = new Map();
    await this.refresh(run, { anew: 1 });
    if (this.run === run) await this.go(live ? LATEST : 0);
  }

  /** Show a step, as soon as it is read, and choose there the behaviour of this path, if one is given. */
  aim(step, path) {
    this.aimed = { step, path };
    this.go(step);
  }

  /** Learn how far it is; what is still being read is asked for again. */
  async refresh(run = this.run, values = {}) {
    if (run !== this.run || run === null) return;
    let told;
    try {
      told = await ask("run", { run, known: this.known, ...values });
    } catch (error) {
      return this.#say(error.message);
    }
    if (run !== this.run) return;
    this.#say(told.trouble);
    if (told.size !== this.known) {
      this.known = told.size;
      this.tree.show(told.nodes);
      this.shown = -1;
    }
    this.#reach(told.last);
    this.#mark(told);
    if (!told.whole && this.live.hidden) setTimeout(() => this.refresh(run).then(() => this.#again()), READING_MS);
  }

  #again() {
    if (this.aimed) this.go(this.aimed.step);
    else if (this.shown < 0) this.go(Number(this.slider.value));
  }

  #say(trouble = "") {
    this.trouble.hidden = !trouble;
    this.trouble.textContent = trouble;
  }

  #reach(last) {
    this.last = last;
    this.slider.max = Math.max(0, last);
  }

  #mark({ marks, last }) {
    const length = Math.max(1, last);
    this.strip.setAttribute("viewBox", `0 0 ${length} ${MARKS.length}`);
    this.strip.replaceChildren(...MARKS.map((kind, row) => drawn("path", {
      class: `mark-${kind}`, "vector-effect": "non-scaling-stroke",
      d: marks.filter((mark) => mark[1] === kind).map(([step]) => `M${Math.min(step, length)} ${row}v.9`).join(""),
    })));
  }

  #chosen(step) {
    this.aimed = null;
    this.follow.checked = step >= LATEST && !this.live.hidden;
    const within = Math.max(0, Math.min(step, this.last));
    this.moved(within);
    this.go(this.follow.checked ? LATEST : within);
  }

  /** Show the tick with this number; of several that are wanted meanwhile, only the last is. */
  async go(step) {
    this.wanted = step;
    if (this.going) return;
    this.going = true;
    try {
      while (this.wanted !== null && this.run !== null) {
        const [run, wanted] = [this.run, this.wanted];
        this.wanted = null;
        const told = await ask("step", { run, step: wanted, ...(this.shown < 0 ? {} : { shown: this.shown }) });
        if (run === this.run && told.step >= 0) this.#apply(told);
      }
      this.#say();
    } catch (error) {
      this.#say(error.message);
    } finally {
      this.going = false;
    }
  }

  #apply(told) {
    this.shown = told.step;
    this.#reach(told.last);
    this.slider.value = told.step;
    this.tree.change(told.nodes, told.step);
    if (this.known && this.aimed?.step === told.step) this.#arrive(this.aimed.path);
    if (this.node === null) this.tree.reveal(this.tree.places.get(told.tip));
    for (const [key, value] of Object.entries(told.facts)) this.values.set(key, value);
    const moment = text("moment", { tick: told.number, of: told.last, time: told.time_s.toFixed(2),
      cause: told.cause, ms: (told.duration_s * 1000).toFixed(1) });
    this.moment.textContent = moment;
    this.slider.setAttribute("aria-valuetext", moment);
    this.moment.dataset.step = told.step;
    this.#beside();
  }

  #arrive(path) {
    this.aimed = null;
    const place = this.tree.places.get(path);
    if (place !== undefined) this.tree.pick(place);
  }

  /** What stands beside the tree follows when the slider rests. */
  #beside() {
    clearTimeout(this.resting);
    this.resting = setTimeout(() => { this.#facts(); this.#happened(); this.#why(); }, REST_MS);
  }

  #facts() {
    const told = [...this.values].filter(([, value]) => !["null", "[]", "{}", '""', "false", "0"].includes(value));
    this.facts.replaceChildren(...told.flatMap(([key, value]) =>
      [element("dt", {}, key), element("dd", {}, value)]));
  }

  async #happened() {
    const kinds = this.kinds.filter((one) => one.checked).map((one) => one.value).join(",");
    const [run, step] = [this.run, this.shown];
    if (run === null || step < 0) return;
    const lines = await ask("lines", { run, step, kinds, words: this.words.value }).catch(() => []);
    if (run !== this.run || step !== this.shown) return;
    const scroll = this.lines.parentElement;
    this.lines.replaceChildren(...lines.map((line) => this.#line(line)));
    if (!lines.length) this.lines.append(element("li", {}, text("nothing_yet")));
    scroll.scrollTop = scroll.scrollHeight;
  }

  #line({ step, time_s: time, kind, text: said, call }) {
    return element("li", { class: `of-${kind}` },
      element("button", { type: "button", class: "at", onclick: () => this.#chosen(step) }, time.toFixed(2)),
      element("span", { class: "kind" }, text(`kinds.${kind}`)),
      element("span", { class: "what" }, said),
      call === null ? null : element("button", { type: "button", class: "more", onclick: () => this.#call(call) }, text("show_call")));
  }

  async #why() {
    const [run, step, node] = [this.run, this.shown, this.node];
    if (node === null || step < 0) return;
    const told = await ask("node", { run, step, node }).catch(() => null);
    if (!told || run !== this.run || step !== this.shown || node !== this.node) return;
    const shape = this.tree.nodes[node];
    const [first, ...deeper] = told.because;
    this.#tell("why",
      element("p", {}, element("strong", {}, shape.name), ` ${called("statuses", first.status)}`),
      element("p", {}, this.#reason(first, deeper)),
      deeper.length ? element("ol", { class: "because" }, ...deeper.map((one) => element("li", {},
        element("button", { type: "button", onclick: () => this.tree.pick(one.node) }, this.tree.nodes[one.node].name),
        ` ${called("statuses", one.status)}${one.message ? `: ${one.message}` : ""}`))) : "",
      element("p", { class: "shape" }, [shape.kind, shape.class_name, shape.source && text("source_is", { source: shape.source }),
        shape.activity && text("activity_is", { activity: shape.activity })].filter(Boolean).join(" · ")),
      element("h4", {}, text("changes", { count: told.changes.length })),
      element("ol", { class: "changes" }, ...told.changes.map(([at, status, message]) => element("li", {},
        element("button", { type: "button", onclick: () => this.#chosen(at) }, text("at_step", { step: at })),
        ` ${called("statuses", status)}${message ? `: ${message}` : ""}`))));
  }

  #reason(first, deeper) {
    if (first.message) return first.message;
    if (first.since < 0) return text("never_ticked");
    const at = { step: first.since };
    if (first.status === "INVALID") return text("given_up", at);
    if (!deeper.length) return text("says_nothing", at);
    return text(`for_${first.status}`, { ...at, name: this.tree.nodes[deeper[0].node].name });
  }

  async #call(call) {
    const run = this.run;
    const told = await ask("call", { run, call }).catch(() => null);
    if (!told || run !== this.run) return;
    this.tree.drop();
    this.node = null;
    const turn = ([role, content]) => [element("h4", {}, role), element("pre", {}, content)];
    this.#tell("model_call",
      element("p", {}, element("strong", {}, told.label), ` ${text("call", {
        model: told.model, seconds: told.seconds.toFixed(2), in: told.tokens_in, out: told.tokens_out })}`),
      ...told.messages.flatMap(turn),
      ...(told.answer ? turn(["assistant", told.answer]) : []),
      told.scores.length ? element("ol", {}, ...told.scores.map(([score, place]) =>
        element("li", {}, `${score.toFixed(2)} ${place}`))) : "");
    this.why.parentElement.scrollTop = 0;
    this.why.parentElement.scrollIntoView({ block: "nearest" }); // on a phone it is above the list
  }
}
