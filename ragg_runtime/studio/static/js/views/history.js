// The steps as they were made, and the branches that were left; any state can be compared beside the present one.
import { fill, h, number } from "../dom.js";
import { on, server } from "../store.js";
import { doing } from "../doing.js";

const SAID = { new: "made from a test sheet", add: "added", remove: "removed", edit: "sheet edited:", undo: "undo", redo: "redo", restore: "went back" };

export function historyView(main) {
  const known = () => {
    const { state } = server;
    const history = state && state.history;
    if (!history) return void fill(main, h("p.empty-note", {}, "Open a model directory to see its history."));
    const busy = Boolean(state.status.job);
    const next = Math.max(...history.steps.map((s) => s.n));
    fill(
      main,
      h("section.card", {},
        h("h2", {}, "History"),
        h("p.note", {}, "Nothing is ever taken out of it: undo and redo are steps themselves. Grey steps lie on a branch that was left; one can go back to each."),
        h("div.row", {},
          h("button", { type: "button", disabled: !history.can_undo || busy, onclick: () => doing("undo") }, "Undo"),
          h("button", { type: "button", disabled: !history.can_redo || busy, onclick: () => doing("redo") }, "Redo")),
        h("div.wide", {}, h("table.numbers.history", {},
          h("thead", {}, h("tr", {}, h("th", {}, "when"), h("th", {}, "step"), h("th.n", {}, "before, Eo"), h("th.n", {}, "after, Eo"), h("th.n", {}, "held out, Eo"), h("th", {}, "flights"), h("th", {}, ""))),
          h("tbody", {}, [...history.steps].reverse().map((s) => h("tr", { class: s.present ? "" : "left" },
            h("td", {}, new Date(s.time).toLocaleString("sv")),
            h("th", { scope: "row" }, `${SAID[s.action] || s.action} `, s.action === "add" || s.action === "remove" ? h("code", {}, s.effect) : /^\d+$/.test(s.effect) ? `to the state after step ${Number(s.effect) + 1}` : s.effect),
            h("td.n", {}, s.before === null ? "–" : number(s.before)), h("td.n", {}, s.after === null ? "–" : number(s.after)), h("td.n", {}, s.holdout === null ? "–" : number(s.holdout)),
            h("td", {}, s.flights.join(", ")),
            h("td.do", {},
              s.kept && s.n !== next ? h("button", { type: "button", disabled: busy, onclick: () => doing("restore", { step: s.n }), "aria-label": `Go back to the state after step ${s.n + 1}` }, "go back") : null,
              s.kept && state.flights.length ? h("button", { type: "button", disabled: busy, onclick: () => doing("beside", { step: s.n }), "aria-label": `Compare the state after step ${s.n + 1} beside the present one` }, "beside") : null))))))),
      beside(state),
    );
  };
  known();
  return on("server", known);
}

function beside(state) {
  const b = state.beside, now = state.banner;
  if (!b || !now) return null;
  const errors = (label, pick) => h("tr", {}, h("th", { scope: "row" }, label), h("td.n", {}, number(pick(0))), h("td.n", {}, number(pick(1))));
  const rows = [["nominal", "nominal", 0], ["calibrated", "calibrated", 1], ["held out", "holdout", 2]];
  return h("section.card", {},
    h("h2", {}, "Two models side by side"),
    h("p.note", {}, "Both calibrated on the flights that are open."),
    h("div.wide", {}, h("table.numbers", {},
      h("thead", {}, h("tr", {}, h("th", {}, "error before demodulation, Eo"), h("th.n", {}, `after step ${b.step + 1}`), h("th.n", {}, "now"))),
      h("tbody", {},
        h("tr", {}, h("th", { scope: "row" }, "effects"), h("td.n", {}, b.effects.join(", ") || "none"), h("td.n", {}, state.model.effects.map((e) => e.id).join(", ") || "none")),
        rows.map(([label, key, k]) => errors(label, (which) => (which ? now.errors[k].rms_Eo : b.errors[key].rms_Eo))),
        rows.slice(1).map(([label, key, k]) => ["inline", "cross"].map((c) => errors(`${label}, ${c}, Eo/√Hz`, (which) => (which ? now.errors[k].json : b.errors[key])[`${c}_Eo_per_rtHz`]))),
        errors("noise floor", (which) => (which ? now.noise.rms_Eo : b.noise_Eo))))),
    h("button", { type: "button", onclick: () => doing("beside", { step: null }) }, "Close"));
}
