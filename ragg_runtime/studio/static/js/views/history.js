// The steps as they were made, and the branches that were left; any state can be compared beside the present one.
import { ask, Refused } from "../api.js";
import { fill, h, number } from "../dom.js";
import { on, server, view } from "../store.js";
import { curvesText, drawingText } from "../plots/export.js";
import { fileName, frame, saves } from "../plots/figure.js";
import { spectrumLines, spectrumPlot } from "../plots/spectrum.js";
import { branchTree } from "../plots/tree.js";
import { doing } from "../doing.js";

const SAID = { new: "made from a test sheet", add: "added", remove: "removed", edit: "sheet edited:", undo: "undo", redo: "redo", restore: "went back", calibrate: "calibration kept" };
const SHORT = { new: () => "test sheet", add: (s) => `+ ${s.effect}`, remove: (s) => `− ${s.effect}`, edit: (s) => `sheet: ${s.effect}`, restore: (s) => `as after ${Number(s.effect) + 1}` };

export function historyView(main) {
  const steps = h("section.card"), two = h("section.card", { hidden: true });
  fill(main, steps, two);
  let drawn = null, shown = "";
  const drop = () => (drawn && drawn.gone(), (drawn = null));

  const known = () => {
    const { state } = server;
    if (!state || !state.history) return void fill(main, h("p.empty-note", {}, "Open a model directory to see its history."));
    if (!steps.isConnected) fill(main, steps, two);
    listed(state);
    const key = JSON.stringify([state.beside, state.banner && state.banner.errors, view.flight]);
    if (key === shown) return;
    shown = key;
    drop();
    two.hidden = !(state.beside && state.banner);
    if (!two.hidden) drawn = beside(two, state);
  };

  const listed = (state) => {
    const { history } = state, busy = Boolean(state.status.job);
    const of = (n) => history.steps.find((s) => s.n === n);
    const states = history.tree.map((x) => ({ ...x, label: (SHORT[of(x.n).action] || (() => of(x.n).action))(of(x.n)), after: of(x.n).after, present: of(x.n).present }));
    fill(
      steps,
      h("h2", {}, "History"),
      h("p.note", {}, "Nothing is ever taken out of it: undo and redo are steps themselves. Grey states lie on a branch that was left; one can go back to each."),
      h("div.row", {},
        h("button", { type: "button", disabled: !history.can_undo || busy, onclick: () => doing("undo") }, "Undo"),
        h("button", { type: "button", disabled: !history.can_redo || busy, onclick: () => doing("redo") }, "Redo")),
      states.length ? branches(state.model.name, branchTree(states, history.now)) : null,
      h("div.wide", {}, h("table.numbers.history", {},
        h("thead", {}, h("tr", {}, h("th", {}, "no."), h("th", {}, "when"), h("th", {}, "step"), h("th.n", {}, "before, Eo"), h("th.n", {}, "after, Eo"), h("th.n", {}, "held out, Eo"), h("th", {}, "flights"), h("th", { "aria-label": "what can be done" }))),
        h("tbody", {}, [...history.steps].reverse().map((s) => h("tr", { class: s.present ? "" : "left" },
          h("td", {}, String(s.n + 1)), h("td", {}, new Date(s.time).toLocaleString("sv")),
          h("th", { scope: "row" }, `${SAID[s.action] || s.action} `, s.action === "add" || s.action === "remove" ? h("code", {}, s.effect) : /^\d+$/.test(s.effect) ? `to the state after step ${Number(s.effect) + 1}` : s.effect, s.n === history.now ? h("em.badge", {}, "present") : null),
          [s.before, s.after, s.holdout].map((x) => h("td.n", {}, x === null ? "–" : number(x))),
          h("td", {}, s.flights.join(", ")),
          h("td.do", {},
            s.kept && s.n !== history.now ? h("button", { type: "button", disabled: busy, onclick: () => doing("restore", { step: s.n }), "aria-label": `Go back to the state after step ${s.n + 1}` }, "go back") : null,
            s.kept && s.n !== history.now && state.flights.length ? h("button", { type: "button", disabled: busy, onclick: () => doing("beside", { step: s.n }), "aria-label": `Compare the state after step ${s.n + 1} beside the present one` }, "beside") : null)))))));
  };
  known();
  const offs = [on("server", known), on("flight", known)];
  return () => (offs.forEach((f) => f()), drop());
}

const branches = (name, tree) => h("figure.tree-box", { "aria-label": "Branches" }, h("div.wide", { tabindex: "0", role: "group", "aria-label": "The states of the model as a tree" }, tree), saves("Branches", () => fileName(name, "history"), () => drawingText(tree)));

function beside(box, state) {
  const b = state.beside, now = state.banner, old = `after step ${b.step + 1}`;
  const errors = (label, pick) => h("tr", {}, h("th", { scope: "row" }, label), h("td.n", {}, number(pick(0))), h("td.n", {}, number(pick(1))));
  const rows = [["nominal", "nominal", 0], ["calibrated", "calibrated", 1], ["held out", "holdout", 2]];
  const figure = frame({ id: "spectrum", title: "Spectrum of the residual", kind: "figure", name: () => fileName(state.model.name, "two-models"), text: () => curvesText(plot.plot) });
  fill(box,
    h("h2", {}, "Two models side by side"),
    h("p.note", {}, "Both calibrated on the flights that are open."),
    h("div.pair", {},
      h("div.wide", {}, h("table.numbers", {},
        h("thead", {}, h("tr", {}, h("th", {}, "error before demodulation, Eo"), h("th.n", {}, old), h("th.n", {}, "now"))),
        h("tbody", {},
          h("tr", {}, h("th", { scope: "row" }, "effects"), h("td.n", {}, b.effects.join(", ") || "none"), h("td.n", {}, state.model.effects.map((e) => e.id).join(", ") || "none")),
          rows.map(([label, key, k]) => errors(label, (which) => (which ? now.errors[k].rms_Eo : b.errors[key].rms_Eo))),
          rows.slice(1).map(([label, key, k]) => ["inline", "cross"].map((c) => errors(`${label}, ${c}, Eo/√Hz`, (which) => (which ? now.errors[k].json : b.errors[key])[`${c}_Eo_per_rtHz`]))),
          errors("noise floor", (which) => (which ? now.noise.rms_Eo : b.noise_Eo))))),
      figure.element),
    h("div.row", {}, h("button", { type: "button", onclick: () => doing("beside", { step: null }) }, "Close")));
  const plot = spectrumPlot(figure.body, { band: () => [null, null], banded: () => {}, harmonic: () => null });
  ask("spectrum", { flight: view.flight, output: view.output }).then((found) => {
    delete found.lines.before;
    plot.show(found);
    figure.keys(spectrumLines.filter((l) => l.id === "noise" || found.lines[l.id]).map((l) => [l.id === "beside" ? old : l.id === "residual" ? "now" : l.name, l.colour, l.dash ? "dashed" : ""]));
  }).catch((error) => {
    if (!(error instanceof Refused)) throw error;
    figure.say(error.facts.what);
  });
  return plot;
}
