// The wire to the robot: what is new comes as server-sent events, what is said goes as JSON.

const token = new URLSearchParams(location.search).get("token") ?? "";
const AGAIN_MS = 1500;
const STOP_AGAIN_MS = 400;
export const OVER = new Error("over");

export function address(path, values = {}) {
  return `${path}?${new URLSearchParams({ ...values, token })}`;
}

/** Follow a board: `show(name, value)` for each change, `connected(state)` as it goes. */
export function follow(names, show, connected, root = "") {
  let known = "";
  const open = () => {
    const source = new EventSource(address(`${root}/events`, known ? { known } : {}));
    source.onopen = () => connected("open");
    source.onerror = () => {
      if (source.readyState !== EventSource.CLOSED) return connected("lost");
      source.close();
      wasRefused(root || "/").then((refused) => connected(refused ? "refused" : "lost"));
      setTimeout(open, AGAIN_MS);
    };
    for (const name of names) {
      source.addEventListener(name, (event) => {
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

export function post(path, body) {
  return fetch(address(path), {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(body),
  });
}

async function send(path, body) {
  const answer = await post(path, body);
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
  for (;;) {
    try {
      return await send("/stop", {});
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
