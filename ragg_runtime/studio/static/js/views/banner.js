// Verdict, errors and noise, and the error after every step with what is foreseen.
import { fill, h, number } from "../dom.js";
import { look, on, server, view } from "../store.js";
import { stepBars } from "../plots/bars.js";
import { drawingText } from "../plots/export.js";
import { fileName, saves } from "../plots/figure.js";
import { foreseen } from "./foresee.js";
import { doing } from "../doing.js";

let seen = []; // the steps that were shown last: what has been added since is seen to fall

export function banner(box) {
  const known = () => {
    const { state } = server;
    const b = state && state.banner;
    if (!b) {
      const busy = state && state.status.job;
      fill(box, h("div.verdict.wait", {}, h("p.headline", {}, !state || !state.model ? "Open a model and a flight to begin." : !state.flights.length ? (busy ? "Reading the flights …" : "Choose a flight to hold this model against.") : busy ? "Calibrating the model on the flight …" : "Nothing is known of these flights yet."), state && state.flights.length && !busy ? h("button", { type: "button", onclick: () => doing("look") }, "Compare them with the model") : null,
        state && !state.flights.length && !busy ? h("p.row", {},
          (state.unread || []).map((path) => h("button.main", { type: "button", onclick: () => look({ view: "files", columns: path }) }, `Say what the columns of ${path.split("/").at(-1)} are`)),
          h("button", { type: "button", onclick: () => look({ view: "files" }) }, "Choose files")) : null));
      return;
    }
    const times = b.errors[1].rms_Eo / b.noise.rms_Eo;
    fill(
      box,
      h(
        `div.verdict.${b.state}`, {},
        h("p.headline", {}, b.headline),
        b.lead.map((t) => h("p.lead", {}, t)),
        h("p.flags", {},
          b.converged === null ? null : h("span", { class: b.converged ? "flag good" : "flag bad" }, b.converged ? "converged" : "not converged"),
          h("span.flag", {}, b.adequate && b.verdict !== "unexplained" ? "down to the noise" : `${number(times, times < 1.95 ? 3 : 2)} × the noise`),
          h("span.flag", {}, { G_out: "G_out", voltages: "V₁ … V₄", channels: "inline and cross" }[b.kind] || b.kind)),
      ),
      h("dl.errors", {},
        b.errors.map((e) => h("div", { class: e.label.replace(" ", "-"), title: e.about }, h("dt", {}, e.label), h("dd", {}, h("b", {}, e.text), h("small", {}, " Eo")))),
        h("div.noise", { title: "root mean square of the estimated noise, before demodulation" }, h("dt", {}, "noise floor"), h("dd", {}, h("b", {}, b.noise.text), h("small", {}, " Eo")))),
      h("div.bars"),
    );
    bars();
  };
  const bars = () => {
    const { state } = server;
    const place = box.querySelector(".bars");
    if (!place || !state || !state.banner) return;
    const steps = present(state);
    const now = foreseen();
    if (now && view.ticked.length) {
      steps.push({ label: view.ticked.length > 1 ? `${view.ticked.length} effects?` : `${view.ticked[0]}?`, value: now.rms_Eo, kind: "foreseen" });
    }
    const made = stepBars(steps, state.banner.noise.rms_Eo, seen);
    fill(place, made, saves("Error after every step", () => fileName(state.model.name, "steps"), () => drawingText(made.querySelector("svg"))));
    if (!view.ticked.length) seen = steps;
  };
  const off = on("foreseen", bars);
  return { known, gone: off };
}

/** The error after every step of the present branch, ending with what the flights that are open show now. */
function present(state) {
  const steps = [];
  for (const s of state.history ? state.history.steps.filter((x) => x.present) : []) {
    const lastly = steps.at(-1);
    if (s.before !== null && (!lastly || Math.abs(lastly.value - s.before) > 0.02 * s.before)) {
      steps.push({ label: steps.length ? "other flights" : "as it was", value: s.before, kind: "start" });
    }
    if (s.after !== null) steps.push({ label: `${s.action === "remove" ? "−" : "+"} ${s.effect}`, value: s.after, kind: "step" });
  }
  const now = state.banner.errors[1].rms_Eo;
  const lastly = steps.at(-1);
  if (!lastly || Math.abs(lastly.value - now) > 0.02 * now) steps.push({ label: steps.length ? "now" : "as it is", value: now, kind: steps.length ? "step" : "start" });
  return steps;
}
