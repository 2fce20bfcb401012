// What one takes along: reports, results, the model, and the commands that do the same in a shell.
import { fill, h } from "./dom.js";
import { on, server } from "./store.js";

const FILES = [
  ["diagnosis.html", "Report of the diagnosis", "verdict, evidence, figures, how to make it again"],
  ["compare.html", "Report of the comparison", "errors, where the model fails, parameters"],
  ["steps.html", "Report of the steps", "the error before and after, step by step"],
  ["diagnosis.json", "Diagnosis as JSON", "every number, with its provenance"],
  ["compare.json", "Comparison as JSON", "errors before and after calibration, terms, outputs"],
  ["model.toml", "The model", "test sheet and effects with their calibrated values"],
  ["commands.sh", "Shell commands", "the same steps as ragg commands"],
];

export function takeView(main) {
  const known = () => {
    const { state } = server;
    const ready = { "diagnosis.html": state && state.effects.length, "diagnosis.json": state && state.effects.length, "compare.html": state && state.error, "compare.json": state && state.error, "steps.html": state && state.before && state.error, "model.toml": state && state.model, "commands.sh": state && state.model };
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
