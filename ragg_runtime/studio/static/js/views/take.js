// What one takes along: reports, results, the model, and the commands that do the same in a shell.
import { fill, h } from "../dom.js";
import { on, server } from "../store.js";

const FILES = [
  ["diagnosis.html", "Report of the diagnosis", "the printed page: verdict, evidence, figures, how to make it again"],
  ["compare.html", "Report of the comparison", "errors, where the model fails, parameters"],
  ["steps.html", "Report of the steps", "the error before and after, step by step"],
  ["diagnosis.json", "Diagnosis as JSON", "every number, with what it was made of"],
  ["compare.json", "Comparison as JSON", "errors before and after calibration, terms, outputs"],
  ["compensated.csv", "Compensated channels", "inline and cross with their standard uncertainties, once they are made under Apply"],
  ["model.toml", "The model", "test sheet and effects with their calibrated values"],
  ["model-c.zip", "The model in C", "a C17 program with the calibration that is kept (under Apply), else the sheet’s values"],
  ["model-numpy.zip", "The model for NumPy", "the same as a folder that runs with NumPy alone"],
  ["commands.sh", "The commands", "what does the same in a shell"],
];

export function takeView(main) {
  const known = () => {
    const { state } = server;
    const ready = { "diagnosis.html": state && state.effects.length, "diagnosis.json": state && state.effects.length, "compare.html": state && state.banner, "compare.json": state && state.banner, "steps.html": state && state.before && state.banner, "compensated.csv": state && state.compensated, "model.toml": state && state.model, "model-c.zip": state && state.model, "model-numpy.zip": state && state.model, "commands.sh": state && state.model };
    fill(
      main,
      h("section.card", {}, h("h2", {}, "Files"),
        h("ul.downloads", {}, FILES.map(([name, title, about]) => h("li", {}, ready[name] ? h("a", { href: `/api/take/${name}`, download: name }, title) : h("span.quiet", {}, title), h("small", {}, about))))),
      h("section.card", {}, h("h2", {}, "The same in a shell"),
        state && state.commands.length ? h("pre", { tabindex: "0" }, state.commands.join("\n")) : h("p.note", {}, "Open a model first."),
        state && state.commands.length ? h("div.row", {}, h("button", { type: "button", onclick: (e) => navigator.clipboard.writeText(state.commands.join("\n")).then(() => (e.target.textContent = "Copied")) }, "Copy")) : null,
        h("p.note", {}, "What the page looks at stands in its address; what was done stands in the model directory. Closing either loses nothing.")),
      state && state.banner ? h("section.card", {}, h("h2", {}, "Errors"), h("div.wide", {}, h("table.numbers", {},
        h("thead", {}, h("tr", {}, h("th", {}, ""), ["V rms", "Eo rms", "inline, Eo", "inline, Eo/√Hz", "cross, Eo", "cross, Eo/√Hz"].map((x) => h("th.n", {}, x)))),
        h("tbody", {}, state.banner.table.map((r) => h("tr", {}, h("th", { scope: "row" }, r.label), r.cells.map((c) => h("td.n", {}, c)))))))) : null,
    );
  };
  known();
  return on("server", known);
}
