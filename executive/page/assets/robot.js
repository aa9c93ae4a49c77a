// The wire to the robot: what is new comes as server-sent events, what is said goes as JSON.

const token = new URLSearchParams(location.search).get("token") ?? "";
const AGAIN_MS = 1500;
const STOP_AGAIN_MS = 400;
const STOPS_MS = 5_000; // so long an answer may take
const ANSWERS_MS = 15_000;
const SILENT_MS = 40_000; // the robot's program says more often that it is there
export const OVER = new Error("over");

export function address(path, values = {}) {
  return `${path}?${new URLSearchParams({ ...values, token })}`;
}

/**
 * Follow a board: `show(name, value)` for each change, `connected(state)` as it goes.
 *
 * A connection that broke without a word, as where a phone is carried out of reach, is silent.
 */
export function follow(names, show, connected, root = "") {
  let known = "";
  let silence = 0;
  const open = () => {
    const source = new EventSource(address(`${root}/events`, known ? { known } : {}));
    const again = () => {
      clearTimeout(silence);
      source.close();
      setTimeout(open, AGAIN_MS);
    };
    const hear = () => {
      clearTimeout(silence);
      silence = setTimeout(() => {
        connected("lost");
        again();
      }, SILENT_MS);
    };
    hear();
    source.onopen = () => connected("open");
    source.addEventListener("alive", hear);
    source.onerror = () => {
      if (source.readyState !== EventSource.CLOSED) return connected("lost");
      wasRefused(root || "/").then((refused) => connected(refused ? "refused" : "lost"));
      again();
    };
    for (const name of names) {
      source.addEventListener(name, (event) => {
        hear();
        if (event.lastEventId) known = event.lastEventId;
        show(name, JSON.parse(event.data));
      });
    }
  };
  open();
}

async function wasRefused(path) {
  try {
    return (await fetch(address(path))).status === 403;
  } catch {
    return false;
  }
}

/** With `patience` (ms) it fails if there is no answer by then. */
export function post(path, body, patience) {
  return fetch(address(path), {
    method: "POST",
    signal: patience ? AbortSignal.timeout(patience) : null,
    headers: { "content-type": "application/json" },
    body: JSON.stringify(body),
  });
}

async function send(path, body, patience = ANSWERS_MS) {
  const answer = await post(path, body, patience);
  if (!answer.ok) throw answer.status === 409 ? OVER : new Error(answer.status);
  return answer.json();
}

export function say(words) {
  return send("/say", { words });
}

/** Answers the question with this number, and no other; throws OVER if it is over. */
export function answer(words, question) {
  return send("/say", { words, question });
}

/** What the browser heard, as recognisers have it: what became of it. */
export async function hears(alternatives, utterance, final) {
  return (await send("/heard", { alternatives, utterance, final })).became;
}

/** Says yes or no to what the robot has heard, and to nothing else; throws OVER if it is over. */
export function settle(asked, agrees) {
  return send("/settle", { asked, agrees });
}

/** Stop, until it has reached the robot; `lost` is called each time that it has not. */
export async function stop(lost) {
  const press = Math.random(); // however often it is sent, it is pressed once
  for (;;) {
    try {
      return await send("/stop", { press }, STOPS_MS);
    } catch {
      lost();
      await new Promise((resolve) => setTimeout(resolve, STOP_AGAIN_MS));
    }
  }
}

export async function why(run, timeS) {
  const answer = await fetch(address("/why", { run, time_s: timeS }));
  if (!answer.ok) throw new Error(answer.status);
  return answer.json();
}
