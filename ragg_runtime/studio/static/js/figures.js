// The panels of the reports, drawn by the server: a window on one flight, and what all flights show.
import { doing } from "./api.js";
import { calm, fill, h, hertz, keys, number, pictureNode } from "./dom.js";
import { look, on, server, view } from "./store.js";

const PANELS = [
  ["time", "Measured over model, and the residual"],
  ["spectrum", "Spectrum"],
  ["harmonics", "Residual by harmonic of the spin"],
  ["channels", "Demodulated channels"],
];
const FOLDED = [
  ["whiteness", "Is the residual noise?", "whiteness; correlation with the motion"],
  ["against", "Residual against a channel", "mean and rms of the whitened residual"],
  ["columns", "Columns of the flight", "every channel as it is used"],
];

export function figures(box) {
  const head = h("div.figure-head"), panels = h("div.figures");
  const open = new Set();
  let shown = "", picked = "";
  fill(box, head, panels);

  const folded = ([what, title, about], asked, f) => {
    const body = h("div");
    const channel = f.channels.includes(picked) ? picked : f.channels.includes("temperature") ? "temperature" : f.channels[0];
    const draw = () => fill(body,
      what === "against" ? h("label.row", {}, "channel ", choose("Channel", f.channels, f.channels.indexOf(channel), (k) => ((picked = f.channels[k]), (shown = ""), known()))) : null,
      pictureNode(what === "against" ? `against:${channel}` : what, asked));
    if (open.has(what)) draw();
    return h("details.panel", { open: open.has(what), ontoggle: (e) => (e.target.open ? (body.firstChild || draw(), open.add(what)) : open.delete(what)) },
      h("summary", {}, h("h2", {}, title), h("small", {}, ` ${about}`)), body);
  };
  const known = () => {
    windowHead(head);
    const f = flight(), { state } = server;
    if (!f) return void panels.replaceChildren();
    const [from, to] = limits();
    // what the pictures are of, as far as the server does not keep it apart by flight, output and window
    const of = [state.status.revision, state.error ? 1 : 0, state.effects.length].join(" ");
    const asked = { flight: view.flight, output: view.output, from, to, fan: view.fan, of }, key = JSON.stringify(asked);
    if (key === shown) return;
    shown = key;
    const ready = Boolean(state.error);
    fill(panels,
      ready ? PANELS.map(([what, title]) => h("figure.panel", { class: what }, h("figcaption", {}, h("h2", {}, title)), pictureNode(what, asked))) : null,
      FOLDED.filter(([what]) => ready || what === "columns").map((row) => folded(row, asked, f)));
  };
  const offs = [on("flight output from to fan", calm(known, 120)), keys((e) => (KEYS[e.key] ? void KEYS[e.key]() : false))];
  return { known, gone: () => offs.forEach((off) => off()) };
}

// The window on a flight: which segment of time, which of its outputs.

const flight = () => server.state && server.state.flights[view.flight];
const whole = () => [0, flight() ? flight().duration_s : 1]; // since the first sample
const limits = () => (view.from === null || view.to === null ? whole() : [view.from, view.to]);

function moved(from, to) {
  if (!flight()) return;
  const [a, b] = whole(), width = Math.min(Math.max(to - from, 32 / flight().rate_Hz), b - a);
  const first = Math.min(Math.max(a, from), b - width);
  look(width >= (b - a) * 0.9999 ? { from: null, to: null } : { from: first, to: first + width });
}
const goto = (k) => look({ flight: k, output: 0, from: null, to: null });
/** A window `factor` times as wide, whose middle is moved by a share of the present one. */
const zoom = (factor, share = 0) => {
  const [a, b] = limits(), middle = (a + b) / 2 + share * (b - a), half = ((b - a) / 2) * factor;
  moved(middle - half, middle + half);
};

const KEYS = {
  "+": () => zoom(1 / 2), "=": () => zoom(1 / 2), "-": () => zoom(2), "[": () => zoom(1, -0.5), "]": () => zoom(1, 0.5), 0: () => moved(...whole()),
  f: () => flight() && goto((view.flight + 1) % server.state.flights.length),
  o: () => flight() && flight().parts.length > 1 && look({ output: (view.output + 1) % flight().parts.length }),
};

const choose = (label, names, chosen, take) => h("select", { "aria-label": label, onchange: (e) => take(Number(e.target.value)) }, names.map((name, k) => h("option", { value: String(k), selected: k === chosen }, name)));

function cuts(f, busy) {
  if (view.from === null && !f.cuts.length) return null;
  return h("div.cuts", {},
    view.from !== null ? h("button", { type: "button", disabled: busy, title: "Leave what is shown out of everything", onclick: () => doing("leave", { flight: view.flight, from: limits()[0], to: limits()[1] }).then((done) => done && moved(...whole())) }, "leave this out") : null,
    f.cuts.length ? h("span.chip", {}, `left out: ${f.cuts.map(([a, b]) => `${number(a, 4)} – ${number(b, 4)} s`).join(", ")}`, h("button", { type: "button", "aria-label": "Take back what was left out", title: "Take it back", onclick: () => doing("leave", { flight: view.flight }) }, "×")) : null);
}

/** A flight is fitted, or kept to validate the calibration on the others. */
const validated = (f, state) => h("button.keep", { type: "button", disabled: Boolean(state.status.job), "aria-pressed": String(f.kept), title: "Calibrate on the other flights and see how that holds here",
  onclick: () => doing("validate", { flight: view.flight }) }, f.kept ? "kept for validation" : "keep for validation");

/** Flight, output, window, what is left out, notes. */
function windowHead(box) {
  const { state } = server, flights = state ? state.flights : [];
  if (view.flight >= flights.length && flights.length) look({ flight: 0 });
  const f = flight();
  if (!f) return void box.replaceChildren();
  if (view.output >= Math.max(1, f.parts.length)) look({ output: 0 });
  const open = Boolean(box.querySelector(".notes[open]")), [from, to] = limits();
  const field = (label, value, set) => h("label", {}, `${label} `, h("input.instant", { type: "text", inputmode: "decimal", value: String(Number(value.toPrecision(6))), onchange: (e) => Number.isFinite(Number(e.target.value)) && set(Number(e.target.value)) }));
  fill(
    box,
    flights.length > 1 ? choose("Flight", flights.map((x) => x.name), view.flight, goto) : null,
    f.parts.length > 1 ? choose("Output", f.parts, view.output, (output) => look({ output })) : null,
    h("div.row.window", {}, field("from", from, (x) => moved(x, to)), field("to", to, (x) => moved(from, x)), `s of ${number(f.duration_s, 4)} s at ${hertz(f.rate_Hz)} Hz`),
    h("div.toggle", { role: "group", "aria-label": "Window" },
      [["+", "Zoom in (+)", () => zoom(1 / 2)], ["−", "Zoom out (−)", () => zoom(2)], ["‹", "Earlier ([)", () => zoom(1, -0.5)], ["›", "Later (])", () => zoom(1, 0.5)], ["all", "The whole flight (0)", () => moved(...whole())]].map(([text, title, onclick]) =>
        h("button", { type: "button", title, "aria-label": title, onclick }, text))),
    state.error && !f.kept ? h("label.fan", { title: "What models within the uncertainty of the parameters leave" }, h("input", { type: "checkbox", checked: Boolean(view.fan), onchange: (e) => look({ fan: e.target.checked ? 1 : 0 }) }), " spread of models") : null,
    cuts(f, Boolean(state.status.job)),
    flights.length > 1 ? validated(f, state) : null,
    f.notes.length ? h("details.notes", { open }, h("summary", {}, `${f.notes.length} ${f.notes.length > 1 ? "notes" : "note"} on this record`), h("ul", {}, f.notes.map((n) => h("li", {}, n)))) : null,
  );
}
