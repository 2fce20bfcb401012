// Two states: what the server knows (server), and what this page looks at (view), which is stored in the URL.
const DEFAULTS = {
  view: "loop", flight: 0, output: 0, from: null, to: null, ticked: [], open: "", fan: 0, theme: "",
};
const NUMBERS = new Set(["flight", "output", "from", "to", "fan"]);

export const server = { state: null };
export const view = { ...DEFAULTS };

const listeners = new Map();

/** f is called after any of these keys has changed ("server": what the server knows). */
export function on(keys, f) {
  for (const key of keys.split(" ")) {
    if (!listeners.has(key)) listeners.set(key, new Set());
    listeners.get(key).add(f);
  }
  return () => keys.split(" ").forEach((key) => listeners.get(key).delete(f));
}

function tell(keys) {
  const all = new Set();
  for (const key of keys) for (const f of listeners.get(key) || []) all.add(f);
  for (const f of all) f(keys);
}

/** Change what is looked at. */
export function look(changes, quiet = false) {
  const changed = Object.keys(changes).filter((k) => JSON.stringify(view[k]) !== JSON.stringify(changes[k]));
  if (!changed.length) return;
  Object.assign(view, changes);
  if (!quiet) keep();
  tell(changed);
}

export function known(state) {
  server.state = state;
  tell(["server"]);
}

let timer = 0;
function keep() {
  clearTimeout(timer);
  timer = setTimeout(() => {
    const q = new URLSearchParams();
    for (const [k, d] of Object.entries(DEFAULTS)) {
      const v = view[k];
      if (JSON.stringify(v) === JSON.stringify(d)) continue;
      q.set(k, Array.isArray(v) ? v.join(",") : typeof v === "number" && !Number.isInteger(v) ? v.toPrecision(9) : v);
    }
    history.replaceState(null, "", q.size ? `#${q}` : location.pathname);
  }, 120);
}

/** The view that is stored in the URL. */
export function recall() {
  const q = new URLSearchParams(location.hash.slice(1));
  const found = { ...DEFAULTS, ticked: [] };
  for (const k of Object.keys(DEFAULTS)) {
    if (!q.has(k)) continue;
    const text = q.get(k);
    if (NUMBERS.has(k)) found[k] = Number.isFinite(Number(text)) ? Number(text) : DEFAULTS[k];
    else found[k] = k === "ticked" ? text.split(",").filter(Boolean) : text;
  }
  look(found, true);
}
