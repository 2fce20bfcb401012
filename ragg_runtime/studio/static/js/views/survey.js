// Many flights: each diagnosed by itself, what they say together, how the parameters drift from one to the next.
import { ask, Refused } from "../api.js";
import { fill, h, number } from "../dom.js";
import { look, on, server } from "../store.js";
import { dotPlot } from "../plots/dots.js";
import { curvesText } from "../plots/export.js";
import { fileName, frame } from "../plots/figure.js";
import { doing, trouble } from "../doing.js";

const head = (names, words = 1) => h("thead", {}, h("tr", {}, names.map((n, k) => h(k < words ? "th" : "th.n", { scope: "col" }, n))));
const VERDICT = { adequate: "adequate", "missing-effect": "an effect is missing", unexplained: "unexplained" };

export function surveyView(main) {
  const begin = h("section.card"), said = h("section.card", { hidden: true });
  const errors = h("section.card.channels", { hidden: true }), drift = h("section.card.channels", { hidden: true }), list = h("section.card", { hidden: true });
  fill(main, begin, said, errors, drift, list);
  const nearby = h("p.path", { hidden: true });
  let place = "", plots = [], shown = null, chosen = 0;

  const open = async (file) => {
    if (await doing("open", { model: null, flights: [file] })) look({ view: "loop", from: null, to: null, ticked: [], term: "", flight: 0 });
  };
  const folders = async (folder) => {
    try {
      const found = await ask("folder", { place: folder });
      place = found.folder;
      const field = begin.querySelector(".place"), near = found.entries.filter((e) => e.kind === "folder").map((e) => e.path);
      if (field) field.value = place;
      nearby.hidden = !near.length; // alone: a button that is being pressed stays where it is
      fill(nearby, "or in ", near.map((p) => h("button.quiet", { type: "button", onclick: () => folders(p) }, p.split("/").at(-1))));
    } catch (error) {
      if (error instanceof Refused) trouble(error.facts);
    }
  };
  const asking = (state) => {
    const busy = Boolean(state.status.job);
    fill(begin, h("h2", {}, "Survey of flights"),
      h("p.note", {}, "Every flight of a folder, and of the folders in it, is calibrated and diagnosed by itself; then it is said what they tell together. What is done is kept: begun again it goes on where it was."),
      h("div.row.choices", {}, h("label", { for: "folder" }, "flights in"),
        h("input.place", { id: "folder", type: "text", value: place, spellcheck: "false", onchange: (e) => ((place = e.target.value.trim()), folders(place)) }),
        h("button.main", { type: "button", disabled: busy || !place, onclick: () => doing("survey", { folder: place }) }, "Survey")),
      nearby);
  };

  const results = (x) => {
    const parts = [said, errors, drift, list];
    parts.forEach((p) => (p.hidden = !x));
    if (!x) return;
    fill(said, h(`div.verdict.${x.state}`, {}, h("p.headline", {}, x.headline), x.lead.map((t) => h("p.lead", {}, t))),
      x.of_this_model ? null : h("p.note", {}, "Made with an earlier state of the model: survey again to see this one."),
      h("p.row", {}, h("a", { href: "/api/take/survey.html", download: "survey.html" }, "The report"), h("a", { href: "/api/take/survey.json", download: "survey.json" }, "As JSON")),
      x.effects.length ? h("div.wide", {}, h("table.numbers", {}, head(["effect", "found in", "perhaps in", "testable in"]), h("tbody", {}, x.effects.map((e) => h("tr", {}, h("th", { scope: "row" }, h("code", {}, e.effect)), [e.found, e.perhaps, e.testable].map((n) => h("td.n", {}, String(n)))))))) : null);
    const kinds = [["before", "calibrated, as the model is", 1], ["residual", "with the effects found", 3]];
    errors.hidden = !x.flights.length;
    const figure = frame({ id: "errors-of-flights", title: "Error of every flight, Eo rms", kind: "figure", name: () => fileName("survey", "errors"), text: () => curvesText(plots[0].plot) });
    figure.keys([...kinds.map(([c, name]) => [name, c]), ["noise", "noise", "dashed"]]);
    fill(errors, figure.element);
    if (x.flights.length) plots.push(dotPlot(figure.body, { label: "Eo rms", log: true, picked: marked,
      rows: [...kinds.map(([colour, name, k]) => ({ name, colour, values: x.flights.map((f) => f.errors[k]) })), { name: "noise", colour: "noise", step: true, values: x.flights.map((f) => f.errors[4]) }] }));
    drifting(x);
    fill(list, h("h2", {}, "Flights"), h("p.note", {}, "Error before demodulation, Eo rms. A name opens the flight."),
      h("div.wide", {}, h("table.numbers", {}, head(["no.", "flight", "verdict", "found", "nominal", "calibrated", "held out", "after", "noise"], 4), h("tbody", {}, x.flights.map((f, k) =>
        h("tr", { id: `flight-${k}` }, h("td", {}, String(k)), h("th", { scope: "row" }, h("button.quiet", { type: "button", onclick: () => open(x.files[k]) }, f.name), f.notes.map((n) => h("small.block", {}, n))), h("td", {}, VERDICT[f.verdict] || f.verdict), h("td", {}, f.found), [0, 1, 2, 3, 4].map((i) => h("td.n", {}, number(f.errors[i])))))))),
      x.failed.length ? [h("h3", {}, "In error"), x.failed.map(([name, lines]) => h("p.note", {}, h("b", {}, name), ` ${lines.map((t) => t.trim()).join("; ")}`))] : null);
  };
  const drifting = (x) => {
    drift.hidden = !x.drawn.length;
    if (drift.hidden) return;
    chosen = Math.min(chosen, x.drawn.length - 1);
    const t = x.drawn[chosen], trend = x.trends[chosen];
    const select = h("select", { "aria-label": "Parameter", onchange: (e) => ((chosen = Number(e.target.value)), dropped(1), drifting(x)) }, x.drawn.map((d, k) => h("option", { value: String(k), selected: k === chosen }, `${d.label}, ${d.unit}${x.trends[k].varies ? " · varies" : ""}`)));
    const figure = frame({ id: "drift", title: "A parameter over the flights", kind: "figure", more: [select], name: () => fileName("survey", t.label), text: () => curvesText(plots[1].plot) });
    fill(drift, figure.element);
    const unit = trend.unit ? ` ${trend.unit}` : "";
    figure.say(`Mean ${trend.mean}${unit}, scatter ${trend.scatter}${unit}; χ² per degree of freedom ${trend.chi2} over ${trend.count} flights. Bars: one standard uncertainty. The least constant parameters come first.`);
    plots.push(dotPlot(figure.body, { label: trend.unit || t.label, log: false, picked: marked, rows: [{ name: t.label, colour: "residual", values: t.values, stds: t.stds }] }));
  };
  const marked = (k) => {
    list.querySelectorAll("tr.picked").forEach((r) => r.classList.remove("picked"));
    const row = document.getElementById(`flight-${k}`);
    if (row) row.classList.add("picked"), row.scrollIntoView({ block: "center" });
  };
  const dropped = (keep = 0) => (plots.splice(keep).forEach((p) => p.gone()));

  const known = () => {
    const { state } = server;
    if (!state || !state.model) return void fill(main, h("p.empty-note", {}, "Open a model to survey flights with it."));
    if (!begin.isConnected) fill(main, begin, said, errors, drift, list);
    if (!place) place = (state.survey && state.survey.folder) || state.roots[0];
    asking(state);
    const key = JSON.stringify(state.survey);
    if (key === shown) return;
    shown = key;
    dropped();
    results(state.survey);
  };
  known();
  if (place) folders(place);
  const off = on("server", known);
  return () => (off(), dropped());
}
