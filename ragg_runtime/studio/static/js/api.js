// What the server is asked. Errors are objects of facts: what, where, found, expected, remedy.
import { fill, h } from "./dom.js";

export class Refused extends Error {
  constructor(facts, status) {
    super(facts.what || "the server does not answer");
    this.facts = facts;
    this.status = status;
  }
}

async function checked(response) {
  if (response.ok) return response;
  let facts = { what: `the server answers ${response.status}` };
  try {
    facts = (await response.json()).error || facts;
  } catch {
    facts = { what: (await response.text().catch(() => "")) || facts.what };
  }
  throw new Refused(facts, response.status);
}

async function sent(path, options) {
  try {
    return await checked(await fetch(path, { credentials: "same-origin", cache: "no-store", ...options }));
  } catch (error) {
    if (error instanceof Refused || error.name === "AbortError") throw error;
    throw new Refused({ what: "the server does not answer", remedy: "start it again: ragg studio" }, 0);
  }
}

const query = (values) =>
  new URLSearchParams(Object.entries(values).filter(([, v]) => v !== undefined && v !== null && v !== "")).toString();

export const ask = async (what, values = {}) => (await sent(`/api/${what}?${query(values)}`)).json();

export const post = async (what, body = {}) =>
  (await sent(`/api/${what}`, { method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(body) })).json();

export const act = (what, body) => post(`do/${what}`, body);

export const upload = async (file) =>
  (await sent(`/api/upload?${query({ name: file.name })}`, { method: "POST", body: file })).json();

/** Calls back with the status whenever something has changed; says when the server is gone. */
export function events(changed, gone) {
  const source = new EventSource("/api/events");
  source.onmessage = (e) => changed(JSON.parse(e.data));
  source.onerror = () => gone();
  return source;
}

// What the user has done, and where everyone sees what went wrong with it.

/** Facts of an error, where everyone sees them. */
export function trouble(facts) {
  const box = document.getElementById("trouble");
  box.hidden = !facts;
  if (!facts) return;
  const rows = ["where", "found", "expected", "remedy"].filter((k) => facts[k]);
  fill(
    box,
    h("p.first", {}, facts.what),
    rows.length ? h("dl", {}, rows.map((k) => [h("dt", {}, k), h("dd", {}, facts[k])])) : null,
    h("button.quiet", { type: "button", onclick: () => trouble(null), "aria-label": "Close this message" }, "Close"),
  );
}

/** Do something, and show what goes wrong. */
export async function doing(what, body) {
  try {
    trouble(null);
    await act(what, body);
    return true;
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    trouble(error.facts);
    return false;
  }
}
