// What the record determines of the parameters, the test sheet, and the history.
import { doing } from "./api.js";
import { fill, h, pictureNode, sections } from "./dom.js";
import { on, server, view } from "./store.js";

export function parametersView(main) {
  let shown = "";
  const known = () => {
    const { state } = server;
    const p = state && state.parameters;
    const key = JSON.stringify(p);
    if (key === shown) return; // what is unfolded stays so
    shown = key;
    if (!p) return void fill(main, h("p.empty-note", {}, "The parameters are known once a flight is compared."));
    fill(
      main,
      h("section.card", {}, sections(p)),
      h("section.card", {}, h("h2", {}, "Correlations of the parameters"), pictureNode("correlations", { flight: view.flight, of: server.state.status.revision })),
    );
  };
  known();
  return on("server", known);
}

// The test sheet: the text of model.toml.

export function sheetView(main) {
  let shown = null, before = "";
  const text = h("textarea", { "aria-label": "model.toml", spellcheck: "false", oninput: () => foot() });
  const save = h("button.main", { type: "button", onclick: () => doing("edit", { text: text.value }) }, "Save");
  const revert = h("button", { type: "button", onclick: () => ((shown = null), known()) }, "Discard");
  const foot = () => {
    const changed = text.value !== before;
    save.disabled = !changed || Boolean(server.state.status.job);
    revert.hidden = !changed;
  };
  const known = () => {
    const { state } = server;
    if (!state || !state.sheet) return void fill(main, h("p.empty-note", {}, "Open a model directory to see its test sheet."));
    if (state.sheet !== shown) {
      shown = text.value = state.sheet;
      before = text.value; // with the line ends of a page
      text.rows = shown.split("\n").length + 1;
      fill(main, h("section.card", {}, h("h2", {}, "Test sheet"),
        h("p.note", {}, "model.toml as it is: values, sigma (how uncertain they are), fixed = true for what is not fitted, discs, and effects, your own among them."),
        text, h("div.row", {}, save, revert)));
    }
    foot();
  };
  known();
  return on("server", known);
}

// The steps as they were made.

export function historyView(main) {
  const known = () => {
    const { state } = server;
    if (!state || !state.history) return void fill(main, h("p.empty-note", {}, "Open a model directory to see its history."));
    fill(main, h("section.card", {}, sections(state.history.steps),
      h("p.note", {}, "Append-only: an undo is a step, too."),
      h("div.row", {}, h("button", { type: "button", disabled: !state.history.can_undo || Boolean(state.status.job), onclick: () => doing("undo") }, "Undo"))));
  };
  known();
  return on("server", known);
}
