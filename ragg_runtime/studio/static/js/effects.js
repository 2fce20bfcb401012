// The effects, best first: evidence, and their entry in the catalogue; those that are ticked are added.
import { doing } from "./api.js";
import { fill, h, keys, sections } from "./dom.js";
import { look, on, server, view } from "./store.js";

const tick = (id) => look({ ticked: view.ticked.includes(id) ? view.ticked.filter((e) => e !== id) : [...view.ticked, id] });
const unfold = (id) => look({ open: view.open === id ? "" : id });

export function effectsPane(box) {
  const list = h("ol.ranking"), more = h("ol.ranking"), others = h("details.others", {}, h("summary"), more);
  const foot = h("div.foot");
  const lead = h("div.pane-head");
  fill(box, lead, foot, list, others);

  const known = () => {
    const { state } = server;
    const effects = state ? state.effects : [];
    const inside = state && state.model ? state.model.effects : [];
    fill(
      lead,
      h("h2", {}, "What may be missing"),
      effects.length ? h("p.note", {}, "Bar: probability among the effects of the catalogue. Right: error with the effect alone.") : null,
      inside.length ? h("p.inside", {}, "In the model: ", inside.map((e) => h("span.chip", { title: e.title }, e.id, h("button", { type: "button", "aria-label": `Take ${e.id} out of the model`, title: "Take it out of the model", onclick: () => doing("remove", { effect: e.id }) }, "×")))) : null,
      !effects.length && state && state.error ? state.status.job ? h("p.note", {}, "Testing every effect of the catalogue …") : h("button", { type: "button", onclick: () => doing("look") }, "Test every effect") : null,
    );
    // what is hardly probable is folded, all of it once the model is adequate
    const open = (e) => e.found || view.ticked.includes(e.id) || (e.significant && (e.probability ?? 1) >= 0.01 && state.verdict !== "adequate");
    const hidden = effects.filter((e) => !open(e));
    fill(list, effects.filter(open).map(row));
    fill(more, hidden.map(row));
    others.hidden = !hidden.length;
    others.firstChild.textContent = hidden.length === effects.length ? `No further effect needed; ${hidden.length} tested` : `${hidden.length} others, less probable`;
    marks();
    footer();
  };

  const row = (e) => {
    const meter = h("span.meter", { "aria-hidden": "true" }, h("span"));
    meter.firstChild.style.width = `${Math.round(100 * (e.probability ?? 0))}%`;
    const check = h("input", { type: "checkbox", id: `tick-${e.id}`, checked: view.ticked.includes(e.id), onchange: () => tick(e.id), "aria-label": `add ${e.title || e.id}` });
    return h(
      "li", { class: [e.found ? "found" : "", e.significant ? "" : "weak"].join(" "), "data-effect": e.id },
      check,
      h("button.title", { type: "button", "aria-expanded": "false", onclick: () => unfold(e.id) }, h("b", {}, e.title || e.id), h("code", {}, e.id), e.found ? h("em.badge", {}, "missing") : null),
      h("span.after", { title: "error with this effect alone" }, e.after, h("small", {}, " Eo")),
      h("span.evidence", { title: `p-value ${e.p}` }, meter, h("small", {}, e.chance)),
      h("div.about", { hidden: true }),
    );
  };

  const about = (e) => [
    h("p.note", {}, `Alone: ${e.after} Eo, held out ${e.holdout} Eo; p-value ${e.p}.`),
    e.about ? sections(e.about) : h("p.note", {}, "An effect of model.toml."),
  ];

  const marks = () => {
    for (const li of box.querySelectorAll("li[data-effect]")) {
      const id = li.dataset.effect, open = view.open === id;
      li.querySelector("input").checked = view.ticked.includes(id);
      li.classList.toggle("ticked", view.ticked.includes(id));
      li.querySelector(".title").setAttribute("aria-expanded", String(open));
      const place = li.querySelector(".about");
      place.hidden = !open;
      if (open && !place.firstChild) fill(place, about(server.state.effects.find((e) => e.id === id)));
    }
  };

  const footer = () => {
    const { state } = server, n = view.ticked.length;
    if (!state || !state.effects.length) return foot.replaceChildren();
    fill(foot, h("button.main", { type: "button", disabled: !n || Boolean(state.status.job), onclick: commit, title: "Derive and calibrate (a)" }, n > 1 ? `Derive ${n} effects and calibrate` : n ? "Derive and calibrate" : "Tick an effect to add it"));
  };

  const commit = () => view.ticked.length && doing("add", { effects: view.ticked });

  const pressed = (e) => {
    const items = [...box.querySelectorAll(".ranking .title")].filter((b) => b.checkVisibility());
    const at = items.findIndex((b) => b.closest("li").contains(document.activeElement));
    if (e.key === "j" || e.key === "k") {
      const next = items[Math.min(items.length - 1, Math.max(0, at + (e.key === "j" ? 1 : -1)))];
      if (next) next.focus();
    } else if (e.key === " " && at >= 0 && document.activeElement === items[at]) {
      const id = items[at].closest("li").dataset.effect;
      tick(id);
    } else if (e.key === "a") commit();
    else return false;
    return true;
  };
  const off = [on("ticked open", marks), on("ticked", footer), keys(pressed)];
  return { known, gone: () => off.forEach((f) => f()) };
}

on("server", () => {
  // effects that are in the model now, or unknown, are ticked no longer
  const effects = server.state ? server.state.effects : [];
  if (effects.length) look({ ticked: view.ticked.filter((id) => effects.some((e) => e.id === id)) });
});
