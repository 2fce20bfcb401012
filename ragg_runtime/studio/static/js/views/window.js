// The window on a flight: which stretch of time, which band of frequencies, which of its outputs and units.
import { fill, h, number } from "../dom.js";
import { look, server, view } from "../store.js";
import { doing } from "../doing.js";

const UNITS = { V: ["V", "v"], Eo: ["Eo", "e"], inline: ["inline", "i"], cross: ["cross", "c"] };
const MOST_LINES = 40; // more flights than these are chosen from a list alone

export const flight = () => server.state && server.state.flights[view.flight];
export const whole = () => {
  const f = flight();
  return f ? [f.start_s, f.start_s + f.duration_s] : [0, 1];
};
export const limits = () => {
  const [a, b] = whole();
  return view.from === null || view.to === null ? [a, b] : [Math.max(a, view.from), Math.min(b, view.to)];
};

/** The window that is wanted, inside the flight and not shorter than what can be drawn. */
export function moved(from, to) {
  const f = flight();
  if (!f) return;
  const [a, b] = whole();
  if (from === null) return look({ from: null, to: null });
  const least = Math.min(b - a, 32 / f.rate_Hz);
  const width = Math.min(Math.max(to - from, least), b - a);
  const first = Math.max(a, Math.min(from + (to - from - width) / 2, b - width));
  if (width >= (b - a) * 0.9999) return look({ from: null, to: null });
  look({ from: first, to: first + width });
}

export const banded = (low, high) => look({ low, high });
export const band = () => [view.low, view.high];
export const harmonicOf = (id) => (id.startsWith("const") ? 0 : Number(id.split("|")[0].split(" ")[1]));
export const harmonic = () => (view.term ? harmonicOf(view.term) : null);
const part = () => ((flight() && flight().parts) || [])[view.output];
/** How fast the disc turns that the output stands on, Hz; 0: it stands still. */
export const spin = () => (part() ? part().spin_Hz : server.state && server.state.model ? Math.abs(server.state.model.spin_Hz) : 0);
/** Whether a unit can be shown: of a disc that stands still nothing is demodulated. */
const shows = (unit) => unit === "V" || unit === "Eo" || spin() > 0;
export const ready = () => Boolean(server.state && server.state.banner && flight());
export const unitName = () => (view.unit === "V" ? "V" : "Eo");
/** One standard deviation of the noise in the unit of the figures; 0 where it is not known. */
export const level = () => {
  const b = server.state && server.state.banner;
  return b ? (view.unit === "Eo" ? b.noise.rms_Eo : view.unit === "V" ? b.noise.rms_Eo * b.k_ggi : 0) : 0;
};

const goto = (k) => look({ flight: k, output: 0, from: null, to: null });
const zoom = (factor) => {
  const [a, b] = limits(), middle = (a + b) / 2, half = ((b - a) / 2) * factor;
  moved(middle - half, middle + half);
};
const pan = (share) => {
  const [a, b] = limits();
  moved(a + share * (b - a), b + share * (b - a));
};

const KEYS = {
  "+": () => zoom(1 / 1.6), "=": () => zoom(1 / 1.6), "-": () => zoom(1.6), "[": () => pan(-0.5), "]": () => pan(0.5), 0: () => moved(null),
  ...Object.fromEntries(Object.entries(UNITS).map(([unit, [, key]]) => [key, () => shows(unit) && look({ unit })])),
  f: () => server.state && server.state.flights.length && goto((view.flight + 1) % server.state.flights.length),
  o: () => flight() && (flight().parts || []).length > 1 && look({ output: (view.output + 1) % flight().parts.length }),
};

/** Listens to the keys of the window; call what it returns to stop. */
export function windowKeys() {
  const keys = (e) => {
    if (e.ctrlKey || e.metaKey || e.altKey || /^(textarea|select)$/i.test(e.target.tagName) || (e.target.tagName === "INPUT" && e.target.type !== "checkbox")) return;
    if (!KEYS[e.key] || document.querySelector("dialog[open]")) return;
    e.preventDefault();
    KEYS[e.key]();
  };
  addEventListener("keydown", keys);
  return () => removeEventListener("keydown", keys);
}

/** Which stretch of the flight is shown, in words. */
export const windowText = () => {
  const f = flight();
  return f ? `${number(limits()[0], 4)} – ${number(limits()[1], 4)} s of ${number(f.duration_s, 4)} s at ${number(f.rate_Hz, 3)} Hz` : "";
};

export const choose = (label, names, chosen, take) => h("select", { "aria-label": label, onchange: (e) => take(Number(e.target.value)) }, names.map((name, k) => h("option", { value: String(k), selected: k === chosen }, name)));

/** The flights or lines one after the other, as long as they last. */
function lines(flights) {
  const longest = Math.max(...flights.map((x) => x.duration_s));
  const last = flights.map((x) => x.name.split(/[/:]/).at(-1)), unique = new Set(last).size === last.length;
  return h("div.lines", { role: "group", "aria-label": "Flights" }, flights.map((x, k) => {
    const made = h("button", { type: "button", "aria-pressed": String(k === view.flight), onclick: () => goto(k), title: `${x.name}: ${number(x.duration_s, 4)} s` }, unique ? last[k] : x.name);
    made.style.flexGrow = String(Math.max(0.05, x.duration_s / longest));
    return made;
  }));
}

function cuts(f, state) {
  if (!f || !f.cuts || (view.from === null && !f.cuts.length)) return null;
  return h("div.cuts", {},
    view.from !== null ? h("button", { type: "button", disabled: Boolean(state.status.job), title: "Leave what is shown out of everything", onclick: () => doing("leave", { flight: view.flight, from: limits()[0], to: limits()[1] }).then((done) => done && moved(null)) }, "leave this out") : null,
    f.cuts.length ? h("span.chip", {}, `left out: ${f.cuts.map(([a, b]) => `${number(a, 4)} – ${number(b, 4)} s`).join(", ")}`, h("button", { type: "button", "aria-label": "Take back what was left out", title: "Take it back", onclick: () => doing("leave", { flight: view.flight }) }, "×")) : null);
}

/** Flight, output, unit, window, what is left out, notes. */
export function windowHead(box) {
  const f = flight(), { state } = server, flights = state ? state.flights : [];
  const open = Boolean(box.querySelector(".notes[open]"));
  fill(
    box,
    flights.length > 1 ? choose("Flight", flights.map((x) => x.name), view.flight, goto) : null,
    f && f.parts && f.parts.length > 1 ? choose("Output", f.parts.map((x) => x.name), view.output, (output) => look({ output })) : null,
    h("div.toggle", { role: "group", "aria-label": "Unit" }, Object.entries(UNITS).map(([id, [name, key]]) => h("button", { type: "button", "aria-pressed": String(view.unit === id), disabled: !shows(id), onclick: () => look({ unit: id }), title: shows(id) ? `${name} (${key})` : "This record does not have it" }, name))),
    h("p.window", {}, windowText()),
    h("div.toggle", { role: "group", "aria-label": "Window" },
      h("button", { type: "button", onclick: () => zoom(1 / 1.6), "aria-label": "Zoom in", title: "Zoom in (+)" }, "+"),
      h("button", { type: "button", onclick: () => zoom(1.6), "aria-label": "Zoom out", title: "Zoom out (−)" }, "−"),
      h("button", { type: "button", onclick: () => pan(-0.5), "aria-label": "Earlier", title: "Earlier ([)" }, "‹"),
      h("button", { type: "button", onclick: () => pan(0.5), "aria-label": "Later", title: "Later (])" }, "›"),
      h("button", { type: "button", onclick: () => moved(null), title: "The whole flight (0)" }, "all")),
    cuts(f, state),
    flights.length > 1 && flights.length <= MOST_LINES ? lines(flights) : null,
    f && f.notes.length ? h("details.notes", { open }, h("summary", {}, `${f.notes.length} ${f.notes.length > 1 ? "notes" : "note"} on this record`), h("ul", {}, f.notes.map((n) => h("li", {}, n)))) : null,
  );
}
