// What the experimenter's page asks the server for.

import { address, post } from "/robot.js";

const ROOT = "/experiment";

/** Ask for something; throws what the server says if there is none. */
export async function ask(what, values = {}) {
  return answered(await fetch(address(`${ROOT}/${what}`, values)));
}

/** Have something done; the same. */
export async function tell(what, body) {
  return answered(await post(`${ROOT}/${what}`, body));
}

async function answered(answer) {
  const told = await answer.json().catch(() => ({}));
  if (!answer.ok) throw new Error(told.error ?? answer.status);
  return told;
}
