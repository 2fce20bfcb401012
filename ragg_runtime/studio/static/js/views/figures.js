// The linked figures of one flight: one window of time, one band of frequencies, one term; what is marked in one is marked in all.
import { ask, Refused, series, spectrogram } from "../api.js";
import { calm, counted, fill, h, number } from "../dom.js";
import { look, on, server, view } from "../store.js";
import { curvesText, tableText } from "../plots/export.js";
import { fileName, frame } from "../plots/figure.js";
import { heatTable } from "../plots/heat.js";
import { overview } from "../plots/overview.js";
import { ramp, spectrogramPlot } from "../plots/spectrogram.js";
import { spectrumLines, spectrumPlot } from "../plots/spectrum.js";
import { timePlot } from "../plots/time.js";
import { pointedAt } from "./effects.js";
import { band, banded, flight, harmonic, harmonicOf, level, limits, moved, ready, spin, unitName, whole, windowHead, windowKeys, windowText } from "./window.js";

const MARGIN = 1; // windows to either side that are asked for beforehand, so that moving finds them there

/** What an overlay shows: the effect that is pointed at, else the band or the term that is chosen, else what is ticked. */
function laid() {
  const tested = server.state.effects.length > 0; // until then nothing is known of what they would do
  if (tested && pointedAt()) return { what: "effect", effects: pointedAt(), words: "predicted signature" };
  if (view.low !== null) return { what: `band:${view.low}:${view.high}`, words: `residual of ${number(view.low)} – ${number(view.high)} Hz` };
  if (view.term) return { what: `term:${view.term.replace("|", ":")}`, words: "term, fitted by itself" };
  if (tested && view.ticked.length) return { what: "effect", effects: view.ticked.join(","), words: "predicted signature" };
  return null;
}

const marks = () => {
  const f = flight(), known = (f && f.missing) || { gaps: [], alone: [] };
  return { ...known, cuts: (f && f.cuts) || [] };
};

export function figures(box) {
  const head = h("div.figure-head");
  const panel = (id, title, text) => frame({ id, title, text, name: () => fileName(flight() && flight().name, id), body: h(`div.plot.${id}`) });
  const heat = h("div.heat-box");
  const panels = {
    strip: panel("strip", "The whole flight", () => curvesText(plots.strip.plot, plots.strip.text())),
    measured: panel("measured", "Measured over model", () => curvesText(plots.measured.plot)),
    residual: panel("residual", "Residual", () => curvesText(plots.residual.plot, { level: level() })),
    spectrum: panel("spectrum", "Spectrum", () => curvesText(plots.spectrum.plot)),
    spectrogram: panel("spectrogram", "Spectrogram", () => curvesText(plots.spectrogram.plot, { image: plots.spectrogram.image() })),
    heat: frame({ id: "terms", title: "Where it fails: harmonic of the spin × motion term", body: heat, name: () => fileName(flight() && flight().name, "terms"), text: () => tableText(heat.querySelector("table")) }),
  };
  fill(panels.heat.legend, "σ, of what the model leaves");
  const { strip, measured, residual, spectrum, spectrogram: gram } = panels;
  strip.body.title = "Drag to choose a stretch of time; drag its middle to move it";
  fill(box, head, strip.element, measured.element, residual.element, h("div.pair", {}, spectrum.element, gram.element), panels.heat.element);

  const plots = {
    strip: overview(strip.body, { whole, limits, moved, marks }),
    measured: timePlot(measured.body, { limits, moved, unit: unitName, lines: [{ name: "measured", colour: "before" }, { name: "model", colour: "residual" }] }),
    residual: timePlot(residual.body, {
      label: "time since the first sample, s", limits, moved, level, unit: unitName,
      lines: [{ name: "before", colour: "before" }, { name: "residual", colour: "residual", dimmed: () => Boolean(laid()) }, { name: "laid over it", colour: "effect", alpha: "d0" }],
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
      effect && [over.words, "effect"], level() && ["± noise, 1 σ", "noise", "dashed"],
    ]);
  });
  const drawSpectrum = () => latest("spectrum", async () => {
    if (!ready()) return;
    const [from, to] = limits();
    const found = await ask("spectrum", { flight: view.flight, output: view.output, from, to, effects: view.ticked.join(",") });
    note("spectrum", "");
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
    const stands = found.z.flat().some((z) => Math.abs(z) > found.level);
    note("heat", `${stands ? `Above ${number(found.level, 2)} σ` : `Nothing stands out: only above ${number(found.level, 2)} σ would`} one of the ${counted(found.tried)} terms that are tried${stands ? " stands out" : ""}${view.ticked.length ? ", with what is ticked in the model" : ""}. Choose a cell to lay the term over the residual.`);
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
    const key = JSON.stringify([state && state.model && state.model.path, state && state.flights.map((f) => f.cuts), b && b.errors, state && state.effects.length, state && state.flights.map((f) => f.path), state && state.beside && state.beside.step]);
    heading();
    if (key === shown) return;
    shown = key;
    box.classList.toggle("empty", !flight());
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
    on("ticked", () => (drawResidual(), slow(), calmHeat())),
    on("pointed", pointing),
    on("term", () => (drawResidual(), plots.spectrum.marked(), plots.spectrogram.marked(), drawHeatTable())),
    on("low high", () => (drawResidual(), plots.spectrum.marked(), plots.spectrogram.marked(), drawHeatTable())),
    windowKeys(),
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
