// What a model is for: compensated channels with their band, and as files.
import { fill, h, pictureNode, sectionNode } from "./dom.js";
import { doing } from "./api.js";
import { on, server } from "./store.js";

const KINDS = [
  ["self", "fitted to these flights"],
  ["crossed", "fitted to the other blocks of time"],
  ["frozen", "as saved with the model"],
];
const DEMODULATORS = [["fir", "FIR, 0.2 Hz, no delay"], ["butterworth", "Butterworth, order 6, both ways"], ["causal", "Butterworth, forward alone"]];

const chosen = { calibration: "self", demodulator: "fir" };
const choice = (id, label, options) => [
  h("label", { for: id }, label),
  h("select", { id, onchange: (e) => (chosen[id] = e.target.value) }, options.map(([value, name]) => h("option", { value, selected: chosen[id] === value }, name))),
];

export function applyView(main) {
  const box = h("section.card"), figures = h("section.card.channels", { hidden: true });
  fill(main, box, figures);
  let shown = "";

  const flown = (state) => state.flights.length > 0;
  const compensation = (state) => {
    const c = state.compensated, busy = Boolean(state.status.job);
    fill(box, h("h2", {}, "Compensated channels"),
      h("p.note", {}, "The gravity gradient as the instrument saw it, without the modelled motion errors, with its standard uncertainty."),
      h("div.row.choices", {}, choice("calibration", "parameters", KINDS), choice("demodulator", "demodulator", DEMODULATORS),
        h("button.main", { type: "button", disabled: busy || !flown(state), onclick: () => doing("compensate", chosen) }, "Compensate")),
      h("div.row", {},
        h("button", { type: "button", disabled: busy || !flown(state), onclick: () => doing("calibrate") }, "Save the parameters of these flights"),
        h("p.note", {}, state.model.calibrated ? `The model has a saved calibration ${state.model.calibrated}.` : "The model has no saved calibration yet.")),
      c ? c.sections.map(sectionNode) : null,
      c ? h("p.row", {}, h("a", { href: "/api/take/compensated.csv", download: "compensated.csv" }, "Save as CSV")) : null);
  };

  const curves = (state) => {
    const c = state.compensated, key = JSON.stringify(c);
    if (key === shown) return;
    shown = key;
    figures.hidden = !c;
    if (c) fill(figures, h("h2", {}, "Channels"), pictureNode("compensated", { of: key }));
  };

  const known = () => {
    const { state } = server;
    if (!state || !state.model) return void fill(main, h("p.empty-note", {}, "Open a model and a flight to compensate it."));
    if (!box.isConnected) fill(main, box, figures);
    compensation(state);
    curves(state);
  };
  known();
  return on("server", known);
}

// What one takes along: reports, results, the model, and the commands that do the same in a shell.

const FILES = [
  ["diagnosis.html", "Report of the diagnosis", "verdict, evidence, figures, how to make it again"],
  ["compare.html", "Report of the comparison", "errors, where the model fails, parameters"],
  ["steps.html", "Report of the steps", "the error before and after, step by step"],
  ["diagnosis.json", "Diagnosis as JSON", "every number, with its provenance"],
  ["compare.json", "Comparison as JSON", "errors before and after calibration, terms, outputs"],
  ["compensated.csv", "Compensated channels", "inline and cross with their standard uncertainties (see Compensation)"],
  ["model.toml", "The model", "test sheet and effects with their calibrated values"],
  ["commands.sh", "Shell commands", "the same steps as ragg commands"],
];

export function takeView(main) {
  const known = () => {
    const { state } = server;
    const ready = { "diagnosis.html": state && state.effects.length, "diagnosis.json": state && state.effects.length, "compare.html": state && state.error, "compare.json": state && state.error, "steps.html": state && state.before && state.error, "compensated.csv": state && state.compensated, "model.toml": state && state.model, "commands.sh": state && state.model };
    fill(
      main,
      h("section.card", {}, h("h2", {}, "Downloads"),
        h("ul.downloads", {}, FILES.map(([name, title, about]) => h("li", {}, ready[name] ? h("a", { href: `/api/take/${name}`, download: name }, title) : h("span.quiet", {}, title), h("small", {}, about))))),
      h("section.card", {}, h("h2", {}, "Shell commands"),
        state && state.commands.length ? h("pre", { tabindex: "0" }, state.commands.join("\n")) : h("p.note", {}, "Open a model first."),
        state && state.commands.length ? h("div.row", {}, h("button", { type: "button", onclick: (e) => navigator.clipboard.writeText(state.commands.join("\n")).then(() => (e.target.textContent = "Copied")) }, "Copy")) : null,
        h("p.note", {}, "The view is stored in the URL, the steps in the model directory: closing the page loses nothing.")),
    );
  };
  known();
  return on("server", known);
}
