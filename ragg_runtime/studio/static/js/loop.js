// The loop: the verdict, where the model fails, what is missing, and what adding it would do.
import { doing } from "./api.js";
import { stepBars } from "./drawings.js";
import { effectsPane, foreseen } from "./effects.js";
import { figures, noisePane } from "./figures.js";
import { fill, h, number, sectionNode } from "./dom.js";
import { look, on, server, view } from "./store.js";

export function loopView(main) {
  const top = h("section.banner", { "aria-label": "Verdict" });
  const left = h("div.figures"), noise = h("div.noise-pane");
  const right = h("aside.effects", { "aria-label": "Effects" });
  const below = h("section.unexplained", { "aria-label": "What is unexplained" });
  const columns = h("div.columns", {}, h("div.left", {}, left, noise), h("div.side", {}, right, below));
  main.replaceChildren(top, columns);
  const empty = { known() {
    columns.hidden = !(server.state && server.state.flights.length);
    below.hidden = !(server.state && server.state.banner); // nothing can be tried before it is compared
  } };
  const parts = [empty, banner(top), figures(left), noisePane(noise), validationPane(noise), effectsPane(right), unexplainedPane(below)];
  const off = on("server", () => parts.forEach((p) => p.known && p.known()));
  parts.forEach((p) => p.known && p.known());
  return () => {
    off();
    parts.forEach((p) => p.gone && p.gone());
  };
}

// Verdict, errors and noise, and the error after every step with what is foreseen.

let seen = []; // the steps that were shown last: what has been added since is seen to fall

export function banner(box) {
  const known = () => {
    const { state } = server;
    const b = state && state.banner;
    if (!b) {
      const busy = state && state.status.job;
      fill(box, h("div.verdict.wait", {}, h("p.headline", {}, !state || !state.model ? "Open a model and a flight to begin." : !state.flights.length ? (busy ? "Reading the flights …" : "Choose a flight to compare with this model.") : busy ? "Calibrating the model on the flight …" : "These flights are not compared yet."), state && state.flights.length && !busy ? h("button", { type: "button", onclick: () => doing("look") }, "Compare them with the model") : null,
        state && !state.flights.length && !busy ? h("p.row", {},
          (state.unread || []).map((path) => h("button.main", { type: "button", onclick: () => look({ view: "files" }) }, `Describe the columns of ${path.split("/").at(-1)}`)),
          h("button", { type: "button", onclick: () => look({ view: "files" }) }, "Choose files")) : null));
      return;
    }
    const times = b.errors.calibrated.rms_Eo / b.noise.rms_Eo, [headline, ...lead] = b.sentences;
    fill(
      box,
      h(
        `div.verdict.${b.state}`, {},
        h("p.headline", {}, headline),
        lead.map((t) => h("p.lead", {}, t)),
        h("p.flags", {},
          b.converged === null ? null : h("span", { class: b.converged ? "flag good" : "flag bad" }, b.converged ? "converged" : "not converged"),
          h("span.flag", {}, b.adequate && b.verdict !== "unexplained" ? "down to the noise" : `${number(times, times < 1.95 ? 3 : 2)} × the noise`),
          h("span.flag", {}, { G_out: "G_out", voltages: "V₁ … V₄", channels: "inline and cross" }[b.kind] || b.kind)),
      ),
      h("dl.errors", {},
        Object.entries(b.errors).map(([name, e]) => h("div", { class: name, title: e.about }, h("dt", {}, name === "holdout" ? "held out" : name), h("dd", {}, h("b", {}, e.text), h("small", {}, " Eo")))),
        h("div.noise", { title: "root mean square of the estimated noise, before demodulation" }, h("dt", {}, "noise floor"), h("dd", {}, h("b", {}, b.noise.text), h("small", {}, " Eo")))),
      h("div.bars"),
    );
    bars();
  };
  const bars = () => {
    const { state } = server;
    const place = box.querySelector(".bars");
    if (!place || !state || !state.banner) return;
    const steps = [...state.error_steps];
    const now = foreseen();
    if (now && view.ticked.length) {
      steps.push({ label: view.ticked.length > 1 ? `${view.ticked.length} effects?` : `${view.ticked[0]}?`, value: now.rms_Eo, kind: "foreseen" });
    }
    const made = stepBars(steps, state.banner.noise.rms_Eo, seen);
    fill(place, made);
    if (!view.ticked.length) seen = steps;
  };
  const off = on("foreseen", bars);
  return { known, gone: off };
}

// What no known effect explains: a term, or an expression of one's own, tried and kept.

export function unexplainedPane(box) {
  const status = h("div");
  const trial = h("div");
  const form = own();
  fill(box, h("h2", {}, "An effect of your own"), status, form.element, trial);

  const known = () => {
    const { state } = server;
    const u = state && state.unexplained;
    fill(
      status,
      u && u.significant
        ? [h("p", {}, `The residual is significant (p-value ${u.p}); these terms explain ${u.share} of it:`),
           h("ul.terms", {}, u.terms.map((t) => h("li", {}, h("button", { type: "button", class: "term", onclick: () => look({ term: t.id, low: null, high: null }) }, t.label), h("small", {}, ` ${t.z} σ`)))),
           u.expression ? h("button", { type: "button", onclick: () => form.put(u.expression) }, "Write the strongest as an expression") : null,
           u.needs.length ? h("p.note", {}, `The flight must have: ${u.needs.join("; ")}`) : null]
        : h("p.note", {}, u ? "No term beyond the effects of the catalogue is significant." : ""),
    );
    const t = state && state.trial;
    fill(
      trial,
      t ? h("div.trial", {},
        t.sections.map(sectionNode),
        h("button.main", { type: "button", disabled: Boolean(state.status.job), onclick: () => doing("keep") }, `Keep ${t.id} in the model`)) : null,
    );
    form.known();
  };
  return { known };
}

// How the model that is calibrated on the other flights holds on those kept for validation.

function validationPane(box) {
  const pane = h("section.card", { hidden: true });
  box.append(pane);
  return {
    known() {
      const found = server.state && server.state.validation;
      pane.hidden = !found;
      if (found) fill(pane, h("h2", {}, "Validation"), found.map(sectionNode));
    },
  };
}

const UNIT = "m/s^2";

function own() {
  const id = h("input", { type: "text", value: "my-effect", spellcheck: "false", autocomplete: "off", id: "own-id", pattern: "[a-z][a-z0-9]*(-[a-z0-9]+)*" });
  const add = h("textarea", { rows: "2", spellcheck: "false", autocomplete: "off", id: "own-add", placeholder: "K_x * f_i**2 * temperature" });
  const unit = h("input", { type: "text", value: UNIT, spellcheck: "false", autocomplete: "off", id: "own-unit" });
  const names = h("p.note.names");
  const button = h("button", { type: "submit" }, "Try it");
  const element = h(
    "form.own", { onsubmit: (e) => (e.preventDefault(), send()) },
    h("label", { for: "own-id" }, "name"), id,
    h("label", { for: "own-add" }, "added to the specific force of an accelerometer"), add,
    h("label", { for: "own-unit" }, "unit of each parameter (K_…)"), unit,
    names, h("div.row", {}, button),
  );
  const parameters = () => [...new Set(add.value.match(/\b[A-Z][A-Za-z0-9]*_[A-Za-z0-9_]+\b/g) || [])];
  const send = () => {
    const units = Object.fromEntries(parameters().map((p) => [p, unit.value.trim()]));
    doing("try", { id: id.value.trim(), add: add.value.trim(), units });
  };
  return {
    element,
    known() {
      const { state } = server;
      const flight = state && state.flights[view.flight];
      const channels = flight ? flight.channels.filter((n) => !/^(Gamma|spin_angle)/.test(n)) : [];
      names.textContent = `Names: f_i, f_o, f_p, time, cos_phi, sin_phi${channels.length ? `, ${channels.join(", ")}` : ""}; abs, sign, sqrt, sin, cos, exp, tanh. Parameters are K_… names.`;
      button.disabled = !state || !state.flights.length || Boolean(state.status.job);
    },
    /** A line of model.toml: { id = "…", stage = …, add = "…", K_x = { unit = "…" } } */
    put(line) {
      const found = (key) => (line.match(new RegExp(`${key} = "([^"]*)"`)) || [])[1];
      id.value = found("id") || id.value;
      add.value = found("add") || "";
      unit.value = found("unit") || UNIT;
      add.focus();
    },
  };
}
