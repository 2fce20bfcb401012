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

export const ask = async (what, values = {}, signal) => (await sent(`/api/${what}?${query(values)}`, { signal })).json();

export const post = async (what, body = {}) =>
  (await sent(`/api/${what}`, { method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(body) })).json();

export const act = (what, body) => post(`do/${what}`, body);

export const upload = async (file) =>
  (await sent(`/api/upload?${query({ name: file.name })}`, { method: "POST", body: file })).json();

/** A series: {x, low, high, step, start, paired}; low is high where samples themselves are sent. */
export async function series(values, signal) {
  const data = await (await sent(`/api/series?${query(values)}`, { signal })).arrayBuffer();
  const view = new DataView(data);
  const n = view.getUint32(4, true);
  const [start, step, kind] = [view.getFloat64(8, true), view.getFloat64(16, true), view.getUint32(24, true)];
  const body = data.slice(28);
  const low = new Float32Array(body, 0, n);
  const high = kind ? new Float32Array(body, 4 * n, n) : low;
  const x = new Float64Array(n);
  for (let i = 0; i < n; i++) x[i] = start + i * step;
  return { x, low, high, start, step, paired: kind === 1 };
}

/** A spectrogram: {width, height, time: [first, last], frequency: [first, last], density}. */
export async function spectrogram(values, signal) {
  const data = await (await sent(`/api/spectrogram?${query(values)}`, { signal })).arrayBuffer();
  const view = new DataView(data);
  const [width, height] = [view.getUint32(4, true), view.getUint32(8, true)];
  const at = (k) => view.getFloat64(12 + 8 * k, true);
  return { width, height, time: [at(0), at(1)], frequency: [at(2), at(3)], density: new Float32Array(data.slice(44)) };
}

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
