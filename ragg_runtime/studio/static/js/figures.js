// The linked figures of one flight: one window of time, one band of frequencies, one term; what is marked in one is marked in all.
import { ask, doing, Refused, series, spectrogram } from "./api.js";
import { calm, counted, fill, h, hertz, keys, number, pictureNode } from "./dom.js";
import { frame, heatTable } from "./drawings.js";
import { look, on, server, view } from "./store.js";
import { overview, ramp, spectrogramPlot, spectrumLines, spectrumPlot, timePlot } from "./curves.js";
import { pointedAt } from "./effects.js";

const MARGIN = 1; // windows to either side that are asked for beforehand, so that moving finds them there

/** What an overlay shows: the effect that is pointed at, else the band or the term that is chosen, else what is ticked. */
function laid() {
  const tested = server.state.effects.length > 0; // until then nothing is known of what they would do
  if (tested && pointedAt()) return { what: "effect", effects: pointedAt(), words: "predicted signature" };
  if (view.low !== null) return { what: `band:${view.low}:${view.high}`, words: `residual of ${number(view.low)} – ${number(view.high)} Hz` };
  if (view.term) return { what: `term:${view.term.replace("|", ":")}`, words: "term, fitted alone" };
  if (tested && view.ticked.length) return { what: "effect", effects: view.ticked.join(","), words: "predicted signature" };
  return null;
}

const marks = () => {
  const f = flight(), { gaps, alone } = (f && f.missing) || { gaps: [], alone: [] }, cuts = (f && f.cuts) || [];
  const near = f ? 2 / f.rate_Hz : 0; // what is left out counts as missing, too: it is shown once
  return { gaps: gaps.filter(([a, b]) => !cuts.some(([from, to]) => a > from - near && b < to + near)), alone, cuts };
};

/** How far the models are from the residual, rms over the window. */
const spread = (fan, now) => {
  const apart = Array.from(fan.high, (x, k) => x - now.high[k]).filter(Number.isFinite);
  return Math.sqrt(apart.reduce((sum, x) => sum + x * x, 0) / Math.max(1, apart.length));
};

export function figures(box) {
  const head = h("div.figure-head");
  const panel = (id, title) => frame({ id, title, body: h(`div.plot.${id}`) });
  const heat = h("div.heat-box");
  const panels = {
    strip: panel("strip", "The whole flight"),
    measured: panel("measured", "Measured over model"),
    residual: panel("residual", "Residual"),
    spectrum: panel("spectrum", "Spectrum"),
    spectrogram: panel("spectrogram", "Spectrogram"),
    heat: frame({ id: "terms", title: "Where it fails: harmonic of the spin × motion term", body: heat }),
  };
  fill(panels.heat.legend, "significance in the residual, σ");
  const { strip, measured, residual, spectrum, spectrogram: gram } = panels;
  strip.body.title = "Drag to choose a segment of time; drag its middle to move it";
  fill(box, head, strip.element, measured.element, residual.element, h("div.pair", {}, spectrum.element, gram.element), panels.heat.element);

  const plots = {
    strip: overview(strip.body, { whole, limits, moved, marks }),
    measured: timePlot(measured.body, { limits, moved, unit: unitName, lines: [{ name: "measured", colour: "before" }, { name: "model", colour: "residual" }] }),
    residual: timePlot(residual.body, {
      label: "time since the first sample, s", limits, moved, level, unit: unitName,
      lines: [{ name: "models", colour: "beside", band: true, alpha: "60" }, { name: "before", colour: "before" }, { name: "residual", colour: "residual", dimmed: () => Boolean(laid()) }, { name: "laid over it", colour: "effect", alpha: "d0" }],
    }),
    spectrum: spectrumPlot(spectrum.body, { band, banded, harmonic }),
    spectrogram: spectrogramPlot(gram.body, { limits, moved, band, banded, harmonic, spin }),
  };
  const note = (id, text) => panels[id].say(text);
  const legend = (id, rows) => panels[id].keys(rows);
  const headed = calm(() => heading(), 200);
  const heading = () => windowHead(head);

  // ---- what is asked of the server: the last wish counts, one request a figure is under way ----
  const pending = {};
  const latest = async (id, work) => {
    if (pending[id]) {
      pending[id].again = work;
      return;
    }
    pending[id] = {};
    try {
      await work();
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      if (panels[id] && id !== "strip") note(id, [error.facts.what, error.facts.remedy].filter(Boolean).join(": "));
      else if (id === "strip" && error.status) setTimeout(drawStrip, 1000);
    } finally {
      const { again } = pending[id];
      delete pending[id];
      if (again) latest(id, again);
    }
  };
  const asked = (points) => {
    const [a, b] = limits(), width = b - a;
    return { flight: view.flight, output: view.output, unit: view.unit, from: a - MARGIN * width, to: b + MARGIN * width, points: points * (2 * MARGIN + 1) };
  };
  const points = () => Math.max(300, Math.round(measured.body.clientWidth));

  const drawStrip = () => latest("strip", async () => {
    if (!flight()) return;
    const [a, b] = whole(), { gaps, alone, cuts } = marks();
    legend("strip", [[ready() ? `residual, ${unitName()}` : "output", "before"], gaps.length && ["missing", "gap", "block"], alone.length && ["lone sample missing", "lone"], cuts.length && ["left out", "cut", "block"]]);
    plots.strip.show(await series({ flight: view.flight, output: view.output, unit: view.unit, what: ready() ? "residual" : "measured", from: a, to: b, points: points() }));
    if (!document.documentElement.dataset.drawn) document.documentElement.dataset.drawn = performance.now().toFixed(0);
  });
  const drawMeasured = () => latest("measured", async () => {
    if (!flight()) return;
    const common = asked(points()), modelled = ready(), [a, b] = limits();
    const began = performance.now();
    const [m, p] = await Promise.all([series({ ...common, what: "measured" }), modelled ? series({ ...common, what: "modelled" }) : null]);
    document.documentElement.dataset.series = (performance.now() - began).toFixed(1);
    note("measured", modelled ? "" : "As the file has it, not yet examined.");
    plots.measured.show([m, p]);
    loaded = { from: common.from, to: common.to, width: b - a };
    legend("measured", [[`measured, ${modelled ? unitName() : "V"}`, "before"], modelled && ["model, calibrated", "residual"]]);
  });
  const drawResidual = () => latest("residual", async () => {
    if (!ready()) return;
    const common = asked(points()), over = laid();
    const began = performance.now();
    const [fan, before, now, effect] = await Promise.all([
      view.fan && !flight().kept ? series({ ...common, what: "fan" }).catch(() => null) : null,
      server.state.before ? series({ ...common, what: "before" }).catch(() => null) : null,
      series({ ...common, what: "residual" }),
      over ? series({ ...common, ...over }).catch((e) => (note("residual", [e.facts.what, e.facts.remedy].filter(Boolean).join(": ")), null)) : null,
    ]);
    if (!over || effect) note("residual", "");
    plots.residual.show([fan, before, now, effect]);
    document.documentElement.dataset.series = (performance.now() - began).toFixed(1);
    legend("residual", [
      fan && [`models within the uncertainty: ± ${number(spread(fan, now), 2)} ${unitName()} rms`, "band"], before && ["before the last step", "before"], [`residual, ${unitName()}`, "residual"],
      effect && [over.words, "effect"], level() && ["± noise, 1 σ", "noise", "dashed"],
    ]);
  });
  const drawSpectrum = () => latest("spectrum", async () => {
    if (!ready()) return;
    const [from, to] = limits();
    const found = await ask("spectrum", { flight: view.flight, output: view.output, from, to, effects: view.ticked.join(",") });
    const known = !flight() || flight().channels.some((c) => c.startsWith("Gamma_"));
    note("spectrum", known || !found.spin_Hz ? "" : "The notch at 2Ω: the gravity gradient is not recorded, so slow variation there is fitted as gradient.");
    plots.spectrum.show(found);
    legend("spectrum", spectrumLines.filter((l) => l.id === "noise" || found.lines[l.id]).map((l) => [l.name, l.colour, l.dash ? "dashed" : ""]));
  });
  const drawSpectrogram = () => latest("spectrogram", async () => {
    if (!ready()) return;
    const [from, to] = limits();
    const found = await spectrogram({ flight: view.flight, output: view.output, from, to, what: view.ticked.length && server.state.effects.length ? "left" : "residual", effects: view.ticked.join(",") });
    note("spectrogram", "");
    const scale = plots.spectrogram.show(found);
    const key = h("i.ramp", { "aria-hidden": "true" });
    key.style.background = `linear-gradient(90deg, ${ramp()})`;
    fill(gram.legend, h("span", { "data-words": `${number(scale.low, 2)} (dark) … ${number(scale.high, 2)} Eo/√Hz (bright)` }, number(scale.low, 2), key, `${number(scale.high, 2)} Eo/√Hz`));
  });
  const drawHeat = () => latest("heat", async () => {
    if (!ready() || !server.state.effects.length) return;
    if (!heatShown) note("heat", "Every term is being tried …");
    const found = await ask("heat", { flight: view.flight, output: view.output, effects: view.ticked.join(",") });
    heatShown = found;
    const significant = found.z.flat().some((z) => Math.abs(z) > found.level);
    note("heat", `${significant ? "Some" : "None"} of the ${counted(found.tried)} terms tried are above ${number(found.level, 2)} σ${view.ticked.length ? ", with what is ticked in the model" : ""}. Choose a cell to lay its term over the residual.`);
    drawHeatTable();
  });
  let heatShown = null;
  const inBand = (id) => {
    const k = harmonicOf(id);
    return view.low !== null && k * spin() >= view.low && k * spin() <= view.high;
  };
  const drawHeatTable = () => heatShown && heatTable(heat, heatShown, { chosen: view.term, choose: (term) => look({ term }), marked: inBand });

  const slow = calm(() => (drawSpectrum(), drawSpectrogram()), 140);
  // What is loaded reaches beyond the window: as long as it covers it and is neither too coarse nor too fine, moving
  // draws what is there, one drawing a frame, and asks only once things are quiet.
  let loaded = null;
  const covered = () => {
    const [a, b] = limits();
    return loaded && a >= loaded.from && b <= loaded.to && b - a > 0.4 * loaded.width && b - a < 1.6 * loaded.width;
  };
  const fresh = () => (drawMeasured(), ready() && drawResidual());
  const refine = calm(fresh, 120);
  const zoomed = () => {
    plots.strip.shade();
    plots.measured.zoomed();
    head.querySelector(".window").textContent = windowText();
    headed();
    if (covered()) refine();
    else fresh();
    if (!ready()) return;
    plots.residual.zoomed();
    plots.spectrogram.zoomed();
    slow();
  };
  const all = () => {
    heading();
    if (!flight()) return;
    drawStrip();
    drawMeasured();
    if (!ready()) return;
    drawResidual();
    drawSpectrum();
    drawSpectrogram();
    drawHeat();
  };
  let shown = "";
  const known = () => {
    const { state } = server;
    if (state && view.flight >= state.flights.length && state.flights.length) look({ flight: 0 });
    if (flight() && view.output >= Math.max(1, (flight().parts || []).length) && ready()) look({ output: 0 });
    if (ready() && !spin() && !["V", "Eo"].includes(view.unit)) look({ unit: "Eo" });
    const b = state && state.banner;
    const key = JSON.stringify([state && state.model && state.model.path, state && state.flights.map((f) => f.cuts), b && b.errors, state && state.effects.length, state && state.flights.map((f) => f.path)]);
    heading();
    if (key === shown) return;
    shown = key;
    box.classList.toggle("waiting", !ready());
    all();
  };

  const inFrames = () => {
    let waiting = false;
    return () => {
      if (waiting) return;
      waiting = true;
      requestAnimationFrame(() => ((waiting = false), zoomed()));
    };
  };
  const pointing = calm(drawResidual, 40);
  const offs = [
    on("from to", inFrames()),
    on("flight output unit", all),
    on("fan", () => (heading(), drawResidual())),
    on("ticked", () => (drawResidual(), slow(), calmHeat())),
    on("pointed", pointing),
    on("term", () => (drawResidual(), plots.spectrum.marked(), plots.spectrogram.marked(), drawHeatTable())),
    on("low high", () => (drawResidual(), plots.spectrum.marked(), plots.spectrogram.marked(), drawHeatTable())),
    keys((e) => (KEYS[e.key] ? void KEYS[e.key]() : false)),
    () => document.removeEventListener("themed", drawHeatTable),
  ];
  document.addEventListener("themed", drawHeatTable);
  const calmHeat = calm(drawHeat, 250);
  return {
    known,
    gone() {
      offs.forEach((f) => f());
      Object.values(plots).forEach((p) => p.gone());
    },
  };
}

// Whether the residual is noise: against a channel, its whiteness, its correlation with the motion; drawn by the server once it is asked for.

export function noisePane(box) {
  let shown = "", picked = "";
  const body = h("div");
  const pane = h("details.panel", { ontoggle: () => known() }, h("summary", {}, h("h2", {}, "Is the residual noise?"), h("small", {}, " against a channel; whiteness; correlation with the motion")), body);
  box.append(pane);
  function known() {
    pane.hidden = !ready();
    if (pane.hidden || !pane.open) return;
    const names = flight().channels, channel = names.includes(picked) ? picked : names.find((n) => n === "temperature") || names[0];
    const of = `${server.state.banner.errors.calibrated.rms_Eo} ${Boolean(server.state.validation)}`, asked = { flight: view.flight, output: view.output, of };
    const key = JSON.stringify([asked, channel, flight().path]);
    if (key === shown) return;
    shown = key;
    fill(body, h("div.row.choices", {}, h("label", {}, "channel "), choose("Channel", names, names.indexOf(channel), (k) => ((picked = names[k]), known()))), h("div.pair", {}, pictureNode(`against:${channel}`, asked), pictureNode("whiteness", asked)));
  }
  const offs = [on("flight output", known)];
  return { known, gone: () => offs.forEach((f) => f()) };
}

// The window on a flight: which segment of time, which band of frequencies, which of its outputs and units.

const UNITS = { V: ["V", "v"], Eo: ["Eo", "e"], inline: ["inline", "i"], cross: ["cross", "c"] };
const MOST_LINES = 40; // more flights than these are chosen from a list alone

export const flight = () => server.state && server.state.flights[view.flight];
export const whole = () => {
  const f = flight();
  return f ? [0, f.duration_s] : [0, 1]; // since the first sample
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
/** Spin rate of the disc of the output, Hz; 0: it does not spin. */
export const spin = () => (part() ? part().spin_Hz : server.state && server.state.model ? Math.abs(server.state.model.spin_Hz) : 0);
/** Whether a unit can be shown: without spin there is no demodulation. */
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

/** Which segment of the flight is shown, in words. */
export const windowText = () => {
  const f = flight();
  return f ? `${number(limits()[0], 4)} – ${number(limits()[1], 4)} s of ${number(f.duration_s, 4)} s at ${hertz(f.rate_Hz)} Hz` : "";
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

/** A flight is fitted, or kept to validate the calibration on the others. */
const validated = (f, state) => h("button.keep", { type: "button", disabled: Boolean(state.status.job), "aria-pressed": String(f.kept), title: "Calibrate on the other flights and see how that holds here",
  onclick: async () => {
    const fitted = state.flights.filter((x) => !x.kept).length;
    if (await doing("validate", { flight: view.flight })) look({ flight: f.kept ? fitted : state.flights.length - 1 });
  } }, f.kept ? "kept for validation" : "keep for validation");

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
    state && state.banner && !(f && f.kept) ? h("label.fan", { title: "What models within the uncertainty of the parameters leave" }, h("input", { type: "checkbox", checked: Boolean(view.fan), onchange: (e) => look({ fan: e.target.checked ? 1 : 0 }) }), " spread of models") : null,
    cuts(f, state),
    flights.length > 1 && f ? validated(f, state) : null,
    flights.length > 1 && flights.length <= MOST_LINES ? lines(flights) : null,
    f && f.notes.length ? h("details.notes", { open }, h("summary", {}, `${f.notes.length} ${f.notes.length > 1 ? "notes" : "note"} on this record`), h("ul", {}, f.notes.map((n) => h("li", {}, n)))) : null,
  );
}
