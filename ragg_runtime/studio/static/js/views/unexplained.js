// What no known effect explains: a term, or an expression of one's own, tried and kept.
import { fill, h, number } from "../dom.js";
import { look, server, view } from "../store.js";
import { doing } from "../doing.js";

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
        ? [h("p", {}, `The remainder is significant (p = ${u.p}); these terms hold ${u.share} of it:`),
           h("ul.terms", {}, u.terms.map((t) => h("li", {}, h("button", { type: "button", class: "term", onclick: () => look({ term: `${t.harmonic}|${t.product}`, low: null, high: null }) }, t.label), h("small", {}, ` ${t.z} σ`, t.how ? `, ${t.how}` : "")))),
           u.expression ? h("button", { type: "button", onclick: () => form.put(u.expression) }, "Write the strongest as an expression") : null,
           u.needs.length ? h("p.note", {}, `The flight must have: ${u.needs.join("; ")}`) : null]
        : h("p.note", {}, u ? "Nothing that is left asks for an effect beyond the catalogue’s." : ""),
    );
    const t = state && state.trial;
    fill(
      trial,
      t ? h("div.trial", {},
        h("p", {}, h("code", {}, t.id), `: ${number(t.before_Eo)} → `, h("b", {}, number(t.after_Eo)), ` Eo (held out ${number(t.holdout_before_Eo)} → ${number(t.holdout_Eo)}, noise ${number(t.noise_Eo)})`),
        t.holdout_Eo > t.holdout_before_Eo ? h("p.note", {}, "On held-out time the error does not fall: this record does not confirm it.") : null,
        h("ul.terms", {}, t.values.map((v) => h("li", {}, `${v.name}${v.of ? ` of ${v.of}` : ""} = ${v.text}`))),
        h("button.main", { type: "button", disabled: Boolean(state.status.job), onclick: () => doing("keep") }, `Keep ${t.id} in the model`)) : null,
    );
    form.known();
  };
  return { known };
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
    h("label", { for: "own-add" }, "adds to what the accelerometer feels"), add,
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
      const channels = flight ? flight.channels.map((c) => c.name).filter((n) => !/^(Gamma|spin_angle)/.test(n)) : [];
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

