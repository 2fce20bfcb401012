// The loop: the verdict, where the model fails, and what is missing.
import { doing } from "./api.js";
import { effectsPane } from "./effects.js";
import { figures } from "./figures.js";
import { fill, h, pictureNode, sections } from "./dom.js";
import { look, on, server } from "./store.js";

export function loopView(main) {
  const top = h("section.banner", { "aria-label": "Verdict" }), left = h("div.left"), more = h("section.card.more", { "aria-label": "Result" });
  const side = h("aside.effects", { "aria-label": "Effects" });
  main.replaceChildren(top, h("div.columns", {}, h("div", {}, left, more), side));
  const parts = [banner(top), figures(left), results(more), effectsPane(side)];
  const known = () => parts.forEach((p) => p.known());
  const off = on("server", known);
  known();
  return () => {
    off();
    parts.forEach((p) => p.gone && p.gone());
  };
}

/** What comes first: the verdict, the errors, and the error after every step. */
function banner(box) {
  let shown = "";
  const known = () => {
    const { state } = server;
    if (!state || !state.result.length) return void ((shown = ""), begin(state));
    const [verdict] = state.result, key = JSON.stringify([state.status.revision, verdict]);
    if (key === shown) return;
    shown = key;
    fill(box, sections(verdict), state.history.can_undo ? pictureNode("steps", { of: state.status.revision }) : null);
  };
  const begin = (state) => {
    const busy = Boolean(state && state.status.job), flown = Boolean(state && state.flights.length);
    const text = !state || !state.model ? "Open a model and a flight to begin." : busy ? (flown ? "Calibrating the model on the flight …" : "Reading the flights …") : flown ? "These flights are not compared yet." : "Choose a flight to compare with this model.";
    fill(box, h("div.verdict.wait", {}, h("p.headline", {}, text),
      state && flown && !busy ? h("button", { type: "button", onclick: () => doing("look") }, "Compare them with the model") : null,
      state && !flown && !busy ? h("p.row", {},
        state.unread.map((path) => h("button.main", { type: "button", onclick: () => look({ view: "files" }) }, `Describe the columns of ${path.split("/").at(-1)}`)),
        h("button", { type: "button", onclick: () => look({ view: "files" }) }, "Choose files")) : null));
  };
  return { known };
}

/** The other sections of the result, and how the calibration holds on the flights kept for validation. */
function results(box) {
  let shown = "";
  return {
    known() {
      const { state } = server;
      const [, found] = (state && state.result) || [], validation = state && state.validation, key = JSON.stringify([found, validation]);
      if (key === shown) return; // what is unfolded stays so
      shown = key;
      box.hidden = !(found && found.trim()) && !validation;
      fill(box, validation ? [h("h2", {}, "Validation"), sections(validation)] : null, found ? sections(found) : null);
    },
  };
}
