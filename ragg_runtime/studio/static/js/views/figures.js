// The linked figures of one flight: one window of time, one band of frequencies, one term; what is marked in one is marked in all.
import { ask, Refused, series, spectrogram } from "../api.js";
import { calm, fill, h, number } from "../dom.js";
import { look, on, server, view } from "../store.js";
import { heatTable } from "../plots/heat.js";
import { overview } from "../plots/overview.js";
import { png, svg } from "../plots/export.js";
import { ramp, spectrogramPlot } from "../plots/spectrogram.js";
import { spectrumLines, spectrumPlot } from "../plots/spectrum.js";
import { timePlot } from "../plots/time.js";
import { pointedAt } from "./effects.js";
import { doing } from "../doing.js";

const UNITS = { V: ["V", "v"], Eo: ["Eo", "e"], inline: ["inline", "i"], cross: ["cross", "c"] };
const MARGIN = 1; // windows to either side that are asked for beforehand, so that moving finds them there

const flight = () => server.state && server.state.flights[view.flight];
const whole = () => {
  const f = flight();
  return f ? [f.start_s, f.start_s + f.duration_s] : [0, 1];
};
const limits = () => {
  const [a, b] = whole();
  return view.from === null || view.to === null ? [a, b] : [Math.max(a, view.from), Math.min(b, view.to)];
};

/** The window that is wanted, inside the flight and not shorter than what can be drawn. */
function moved(from, to) {
  const f = flight();
  if (!f) return;
  const [a, b] = whole();
  if (from === null) return look({ from: null, to: null });
  const least = Math.min(b - a, 32 / f.rate_Hz);
  let width = Math.min(Math.max(to - from, least), b - a);
  let first = Math.max(a, Math.min(from + (to - from - width) / 2, b - width));
  if (width >= (b - a) * 0.9999) return look({ from: null, to: null });
  look({ from: first, to: first + width });
}

const banded = (low, high) => look({ low, high });
const band = () => [view.low, view.high];
const harmonicOf = (id) => (id.startsWith("const") ? 0 : Number(id.split("|")[0].split(" ")[1]));
const harmonic = () => (view.term ? harmonicOf(view.term) : null);
const spin = () => (server.state && server.state.model ? server.state.model.spin_Hz : 0);
const level = () => {
  const b = server.state && server.state.banner;
  return b && (view.unit === "Eo" ? b.noise.rms_Eo : view.unit === "V" ? b.noise.rms_Eo * b.k_ggi : 0);
};
const ready = () => Boolean(server.state && server.state.banner && flight());
/** What an overlay shows: the term that is chosen, else the effect that is pointed at, else what is ticked. */
function laid() {
  if (pointedAt()) return { what: "effect", effects: pointedAt() };
  if (view.term) return { what: `term:${view.term.replace("|", ":")}` };
  if (view.ticked.length) return { what: "effect", effects: view.ticked.join(",") };
  return null;
}

export function figures(box) {
  const head = h("div.figure-head");
  const panels = {};
  const panel = (id, title, ...more) => {
    const body = h(`div.plot.${id}`);
    const note = h("p.plot-note", { hidden: true });
    const legend = h("div.legend");
    const buttons = h("span.saves");
    panels[id] = { body, note, legend, buttons };
    return h("figure.panel", { class: id, "aria-label": title }, h("figcaption", {}, h("h2", {}, title), legend, ...more, buttons), body, note);
  };
  const strip = h("div.plot.strip", { "aria-label": "The whole flight: drag to choose a stretch of time", role: "group" });
  const heat = h("div.heat-box");
  const heatNote = h("p.plot-note");
  fill(
    box, head, strip,
    panel("measured", "Measured over model"),
    panel("residual", "Residual"),
    h("div.pair", {}, panel("spectrum", "Spectrum"), panel("spectrogram", "Spectrogram")),
    h("figure.panel.terms", { "aria-label": "Where it fails" }, h("figcaption", {}, h("h2", {}, "Where it fails: harmonic of the spin × motion term"), h("div.legend", {}, "σ, of what the model leaves")), heat, heatNote),
  );

  const plots = {
    strip: overview(strip, { whole, limits, moved }),
    measured: timePlot(panels.measured.body, { limits, moved, lines: [{ name: "measured", colour: "before", width: 1.5 }, { name: "model", colour: "residual", width: 1 }] }),
    residual: timePlot(panels.residual.body, {
      label: "time since the first sample, s", limits, moved, level,
      lines: [{ name: "before the last step", colour: "before", width: 1, alpha: "30" }, { name: "residual", colour: "residual", width: 1, dimmed: () => Boolean(laid()) }, { name: "predicted", colour: "effect", width: 1.8, alpha: "66" }],
    }),
    spectrum: spectrumPlot(panels.spectrum.body, { band, banded, harmonic }),
    spectrogram: spectrogramPlot(panels.spectrogram.body, { limits, moved, band, banded, harmonic, spin }),
  };
  for (const [id, p] of Object.entries(panels)) {
    const image = () => (id === "spectrogram" ? plots.spectrogram.image() : null);
    const name = () => `${flight() ? flight().name.replace(/\W+/g, "-") : "ragg"}-${id}`;
    fill(p.buttons,
      h("button.save", { type: "button", onclick: () => svg(plots[id].plot, name(), image()), "aria-label": `${id} as SVG` }, "SVG"),
      h("button.save", { type: "button", onclick: () => png(plots[id].plot, name()), "aria-label": `${id} as PNG` }, "PNG"));
  }

  const note = (id, text) => {
    panels[id].note.hidden = !text;
    panels[id].note.textContent = text || "";
  };
  const legend = (id, rows) =>
    fill(panels[id].legend, rows.filter(Boolean).map(([name, colour, kind]) => h("span", {}, h(`i.key.${colour}`, { class: kind || "" }), name)));

  const windowText = () => {
    const f = flight();
    return f ? `${number(limits()[0], 4)} – ${number(limits()[1], 4)} s of ${number(f.duration_s, 4)} s at ${number(f.rate_Hz, 3)} Hz` : "";
  };
  const headed = calm(() => heading(), 200);
  const heading = () => {
    const f = flight(), state = server.state;
    fill(
      head,
      state && state.flights.length > 1
        ? h("select", { "aria-label": "Flight", onchange: (e) => look({ flight: Number(e.target.value), from: null, to: null }) }, state.flights.map((x, k) => h("option", { value: String(k), selected: k === view.flight }, x.name)))
        : null,
      h("div.toggle", { role: "group", "aria-label": "Unit" }, Object.entries(UNITS).map(([id, [name, key]]) => h("button", { type: "button", "aria-pressed": String(view.unit === id), onclick: () => look({ unit: id }), title: `${name} (${key})` }, name))),
      h("p.window", {}, windowText()),
      h("div.toggle", { role: "group", "aria-label": "Window" },
        h("button", { type: "button", onclick: () => zoom(1 / 1.6), "aria-label": "Zoom in", title: "Zoom in (+)" }, "+"),
        h("button", { type: "button", onclick: () => zoom(1.6), "aria-label": "Zoom out", title: "Zoom out (−)" }, "−"),
        h("button", { type: "button", onclick: () => pan(-0.5), "aria-label": "Earlier", title: "Earlier ([)" }, "‹"),
        h("button", { type: "button", onclick: () => pan(0.5), "aria-label": "Later", title: "Later (])" }, "›"),
        h("button", { type: "button", onclick: () => moved(null), title: "The whole flight (0)" }, "all")),
      f && f.cuts && (view.from !== null || f.cuts.length) ? h("div.cuts", {},
        view.from !== null ? h("button", { type: "button", disabled: Boolean(state.status.job), title: "Leave what is shown out of everything", onclick: () => doing("leave", { flight: view.flight, from: limits()[0], to: limits()[1] }).then((done) => done && moved(null)) }, "leave this out") : null,
        f.cuts.length ? h("span.chip", {}, `left out: ${f.cuts.map(([a, b]) => `${number(a, 4)} – ${number(b, 4)} s`).join(", ")}`, h("button", { type: "button", "aria-label": "Take back what was left out", title: "Take it back", onclick: () => doing("leave", { flight: view.flight }) }, "×")) : null) : null,
      f && f.notes.length ? h("details.notes", {}, h("summary", {}, `${f.notes.length} notes on this record`), h("ul", {}, f.notes.map((n) => h("li", {}, n)))) : null,
    );
  };

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
      if (panels[id]) note(id, [error.facts.what, error.facts.remedy].filter(Boolean).join(": "));
      else if (id === "strip" && error.status) setTimeout(drawStrip, 1000);
    } finally {
      const { again } = pending[id];
      delete pending[id];
      if (again) latest(id, again);
    }
  };
  const asked = (points) => {
    const [a, b] = limits(), width = b - a;
    return { flight: view.flight, unit: view.unit, from: a - MARGIN * width, to: b + MARGIN * width, points: points * (2 * MARGIN + 1) };
  };
  const points = () => Math.max(300, Math.round(panels.residual.body.clientWidth));
  const unitName = () => (view.unit === "V" ? "V" : "Eo");

  const drawStrip = () => latest("strip", async () => {
    if (!flight()) return;
    const [a, b] = whole();
    plots.strip.show(await series({ flight: view.flight, unit: view.unit, what: ready() ? "residual" : "measured", from: a, to: b, points: points() }));
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
    const [before, now, effect] = await Promise.all([
      server.state.before ? series({ ...common, what: "before" }).catch(() => null) : null,
      series({ ...common, what: "residual" }),
      over ? series({ ...common, ...over }).catch((e) => (note("residual", [e.facts.what, e.facts.remedy].filter(Boolean).join(": ")), null)) : null,
    ]);
    if (!over || effect) note("residual", "");
    plots.residual.show([before, now, effect]);
    document.documentElement.dataset.series = (performance.now() - began).toFixed(1);
    legend("residual", [
      before && ["before the last step", "before"], [`residual, ${unitName()}`, "residual"],
      effect && [over.what === "effect" ? "predicted signature" : "term, fitted by itself", "effect"], level() && ["± noise, 1 σ", "noise", "dashed"],
    ]);
  });
  const drawSpectrum = () => latest("spectrum", async () => {
    if (!ready()) return;
    const [from, to] = limits();
    const found = await ask("spectrum", { flight: view.flight, from, to, effects: view.ticked.join(",") });
    note("spectrum", "");
    plots.spectrum.show(found);
    legend("spectrum", spectrumLines.filter((l) => l.id === "noise" || found.lines[l.id]).map((l) => [l.name, l.colour, l.dash ? "dashed" : ""]));
  });
  const drawSpectrogram = () => latest("spectrogram", async () => {
    if (!ready()) return;
    const [from, to] = limits();
    const found = await spectrogram({ flight: view.flight, from, to, what: view.ticked.length ? "left" : "residual", effects: view.ticked.join(",") });
    note("spectrogram", "");
    const scale = plots.spectrogram.show(found);
    const key = h("i.ramp", { "aria-hidden": "true" });
    key.style.background = `linear-gradient(90deg, ${ramp()})`;
    fill(panels.spectrogram.legend, h("span", {}, number(scale.low, 2), key, `${number(scale.high, 2)} Eo/√Hz`));
  });
  const drawHeat = () => latest("heat", async () => {
    if (!ready() || !server.state.effects.length) return;
    const found = await ask("heat", { flight: view.flight, effects: view.ticked.join(",") });
    heatShown = found;
    heatNote.textContent = `Above ${number(found.level, 2)} σ one of the ${found.tried} terms that are tried stands out${view.ticked.length ? "; with what is ticked in the model" : ""}. Choose a cell to lay the term over the residual.`;
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
    const b = state && state.banner;
    const key = JSON.stringify([state && state.model && state.model.path, state && state.flights.map((f) => f.cuts), b && b.errors, state && state.effects.length, state && state.flights.map((f) => f.path)]);
    heading();
    if (key === shown) return;
    shown = key;
    box.classList.toggle("empty", !flight());
    box.classList.toggle("waiting", !ready());
    all();
  };

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
    v: () => look({ unit: "V" }), e: () => look({ unit: "Eo" }), i: () => look({ unit: "inline" }), c: () => look({ unit: "cross" }),
    f: () => server.state && server.state.flights.length && look({ flight: (view.flight + 1) % server.state.flights.length, from: null, to: null }),
  };
  const keys = (e) => {
    if (e.ctrlKey || e.metaKey || e.altKey || /^(textarea|select)$/i.test(e.target.tagName) || (e.target.tagName === "INPUT" && e.target.type !== "checkbox")) return;
    if (!KEYS[e.key] || document.querySelector("dialog[open]")) return;
    e.preventDefault();
    KEYS[e.key]();
  };
  addEventListener("keydown", keys);
  const frame = () => {
    let waiting = false;
    return () => {
      if (waiting) return;
      waiting = true;
      requestAnimationFrame(() => ((waiting = false), zoomed()));
    };
  };
  const pointing = calm(drawResidual, 40);
  const offs = [
    on("from to", frame()),
    on("flight unit", all),
    on("ticked", () => (drawResidual(), slow(), calmHeat())),
    on("pointed", pointing),
    on("term", () => (drawResidual(), plots.spectrum.marked(), plots.spectrogram.marked(), drawHeatTable())),
    on("low high", () => (plots.spectrum.marked(), plots.spectrogram.marked(), drawHeatTable())),
    () => removeEventListener("keydown", keys),
  ];
  const calmHeat = calm(drawHeat, 250);
  return {
    known,
    gone() {
      offs.forEach((f) => f());
      Object.values(plots).forEach((p) => p.gone());
    },
  };
}
