// What a model is for: compensated channels with their band, and as files.
import { Refused, series } from "../api.js";
import { counted, fill, h } from "../dom.js";
import { look, on, server, view } from "../store.js";
import { curvesText } from "../plots/export.js";
import { fileName, frame } from "../plots/figure.js";
import { timePlot } from "../plots/time.js";
import { doing } from "../doing.js";
import { choose } from "./window.js";

const KINDS = [
  ["self", "fitted to these flights", "parameters fitted to all of it: the band is a little narrow"],
  ["crossed", "fitted to the other blocks of time", "every block has the parameters of all others: what it leaves is held out"],
  ["frozen", "as kept with the model", "ragg calibrate --save keeps them; nothing of these flights gets into them"],
];
const DEMODULATORS = [["fir", "FIR, 0.2 Hz, no delay"], ["butterworth", "Butterworth, order 6, both ways"], ["causal", "Butterworth, forward alone"]];

const chosen = { calibration: "self", demodulator: "fir" };
const choice = (id, label, options) => [
  h("label", { for: id }, label),
  h("select", { id, onchange: (e) => (chosen[id] = e.target.value) }, options.map(([value, name]) => h("option", { value, selected: chosen[id] === value }, name))),
];
const head = (names) => h("thead", {}, h("tr", {}, names.map((n, k) => h(k ? "th.n" : "th", { scope: "col" }, n))));

export function applyView(main) {
  const box = h("section.card"), figures = h("section.card.channels", { hidden: true });
  fill(main, box, figures);
  let plots = [], shown = "", window_ = null;

  const flown = (state) => state.flights.length > 0;
  const compensation = (state) => {
    const c = state.compensated, busy = Boolean(state.status.job);
    fill(box, h("h2", {}, "Compensated channels"),
      h("p.note", {}, "The gravity gradient as the instrument saw it: all removed that the model explains, demodulated, with one standard uncertainty of parameters and noise together."),
      h("div.row.choices", {}, choice("calibration", "parameters", KINDS), choice("demodulator", "demodulator", DEMODULATORS),
        h("button.main", { type: "button", disabled: busy || !flown(state), onclick: () => doing("compensate", chosen) }, "Compensate")),
      h("div.row", {},
        h("button", { type: "button", disabled: busy || !flown(state), onclick: () => doing("calibrate") }, "Keep the parameters of these flights"),
        h("p.note", {}, state.model.calibrated ? `The model keeps a calibration ${state.model.calibrated}.` : "The model keeps no calibration yet: it is what “as kept with the model” and the exported C use.")),
      c ? c.outputs.map((x) => [
        h("h3", {}, c.outputs.length > 1 ? `${x.flight}, ${x.output}` : x.flight),
        h("p.note", {}, `${counted(x.good)} of ${counted(x.samples)} samples have a value; ${c.demodulator.what}.`, x.quality.map(([n, what]) => ` ${counted(n)}: ${what}.`)),
        h("div.wide", {}, h("table.numbers", {}, head(["channel", "before, Eo/√Hz", "after", "noise alone"]), h("tbody", {}, x.rows.map(([name, ...cells]) => h("tr", {}, h("th", { scope: "row" }, name), cells.map((t) => h("td.n", {}, t))))))),
        h("details", {}, h("summary", {}, "What was removed, Eo"), h("div.wide", {}, h("table.numbers", {}, head(["of", "inline", "cross"]), h("tbody", {}, x.contributions.map(([name, ...cells]) => h("tr", {}, h("th", { scope: "row" }, h("code", {}, name)), cells.map((t) => h("td.n", {}, t)))))))),
      ]) : null,
      c ? h("p.row", {}, ["csv", "parquet"].map((e) => h("a", { href: `/api/take/compensated.${e}`, download: `compensated.${e}` }, `Take it as ${e === "csv" ? "CSV" : "Parquet"}`))) : null);
  };

  const drop = () => (plots.forEach((p) => p.made.gone()), (plots = []));
  const draw = () => plots.forEach(async ({ name, made, box: place }) => {
    const [a, b] = limits(), width = b - a;
    const common = { flight: view.flight, unit: "Eo", from: a - width, to: b + width, points: 3 * Math.max(300, place.clientWidth) };
    try {
      const [value, low, high] = await Promise.all(["", ":low", ":high"].map((edge) => series({ ...common, what: `compensated:${name}${edge}` })));
      made.show([{ ...value, low: low.low, high: high.high }, value]);
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
    }
  });
  const whole = () => [0, server.state.flights[view.flight] ? server.state.flights[view.flight].duration_s : 1];
  const limits = () => window_ || whole();
  const moved = (from, to) => {
    const [a, b] = whole();
    window_ = from === null || to - from >= b - a ? null : [Math.max(a, from), Math.min(b, Math.max(to, from + 1))];
    plots.forEach((p) => p.made.zoomed());
    draw();
  };
  const curves = (state) => {
    const c = state.compensated;
    const key = JSON.stringify([c && [c.calibration, c.demodulator.name, c.channels, c.outputs.map((x) => x.rows)], view.flight]);
    if (key === shown) return;
    shown = key;
    window_ = null;
    drop();
    figures.hidden = !c;
    if (!c) return;
    const panels = c.channels.map((name, k) => frame({ id: name, title: `${name}, Eo`, kind: "figure", name: () => fileName(server.state.flights[view.flight] && server.state.flights[view.flight].name, name), text: () => curvesText(plots[k].made.plot) }));
    panels.forEach((p) => p.keys([["value", "residual"], ["± one standard uncertainty", "band"]]));
    const names = server.state.flights.map((f) => f.name);
    fill(figures, names.length > 1 ? h("div.row.choices", {}, choose("Flight", names, view.flight, (flight) => look({ flight }))) : null, panels.map((p) => p.element));
    plots = panels.map(({ body }, k) => ({ name: c.channels[k], box: body, made: timePlot(body, {
      limits, moved, unit: () => "Eo", label: k === panels.length - 1 ? "time since the first sample, s" : undefined,
      lines: [{ name: "±", colour: "before", band: true, alpha: "80" }, { name: "value", colour: "residual" }],
    }) }));
    draw();
  };

  const known = () => {
    const { state } = server;
    if (!state || !state.model) return void fill(main, h("p.empty-note", {}, "Open a model and a flight to apply it."));
    if (!box.isConnected) fill(main, box, figures);
    compensation(state);
    curves(state);
  };
  known();
  const offs = [on("server", known), on("flight", known)];
  return () => (offs.forEach((f) => f()), drop());
}
