// The effects, best first: evidence, equation, physics, what absorbs them; a tick shows what it would do.
import { ask, doing, Refused } from "./api.js";
import { fill, h, maths, number } from "./dom.js";
import { look, on, server, view } from "./store.js";

// a meter is full at this evidence (-log10 p) at least, lest chance look like a finding
const LEAST = 100;

let pointed = "";
/** The effect under the pointer or the focus. */
export const pointedAt = () => pointed;

function point(id) {
  if (pointed === id) return;
  pointed = id;
  look({ pointed: id }, true);
}

const tick = (id) => look({ ticked: view.ticked.includes(id) ? view.ticked.filter((e) => e !== id) : [...view.ticked, id] });
const unfold = (id) => look({ open: view.open === id ? "" : id });

export function effectsPane(box) {
  const list = h("ol.ranking");
  const foot = h("div.foot");
  const rest = h("div.rest");
  const lead = h("div.pane-head");
  fill(box, lead, foot, list, rest);

  const known = () => {
    const { state } = server;
    const effects = state ? state.effects : [];
    const inside = state && state.model ? state.model.effects : [];
    fill(
      lead,
      h("h2", {}, "What may be missing"),
      inside.length ? h("p.inside", {}, "In the model: ", inside.map((e) => h("span.chip", { title: e.title }, e.id, h("button", { type: "button", "aria-label": `Take ${e.id} out of the model`, title: "Take it out of the model", onclick: () => doing("remove", { effect: e.id }) }, "×")))) : null,
      !effects.length && state && state.banner ? state.status.job ? h("p.note", {}, "Every effect of the catalogue is being tested …") : h("button", { type: "button", onclick: () => doing("look") }, "Test every effect") : null,
    );
    const most = Math.max(LEAST, ...effects.map((e) => e.evidence ?? 0));
    fill(list, effects.map((e) => row(e, most)));
    const silent = state ? state.silent : [];
    fill(rest, silent.length ? h("details", {}, h("summary", {}, `${silent.length} effects on which this record is silent`), h("ul.silent", {}, silent.map((e) => h("li", {}, h("b", {}, e.title || e.id), " ", h("code", {}, e.id), h("p", {}, e.why))))) : null,
      state && state.next_motion.length ? h("details", { open: true }, h("summary", {}, "Which flight next"), h("ul.silent", {}, state.next_motion.map((m) => h("li", {}, m.words)))) : null);
    marks();
    footer();
  };

  const row = (e, most) => {
    // evidence spans thousands of decades: its logarithm is drawn
    const share = Math.log10(1 + Math.max(0, e.evidence ?? most)) / Math.log10(1 + most);
    const meter = h("span.meter", { "aria-hidden": "true" }, h("span"));
    meter.firstChild.style.width = `${Math.max(1, Math.round(100 * share))}%`;
    const check = h("input", { type: "checkbox", id: `tick-${e.id}`, checked: view.ticked.includes(e.id), disabled: !e.testable, onchange: () => tick(e.id), "aria-label": `${e.title || e.id}: see what it would do` });
    return h(
      "li", { class: [e.found ? "found" : "", e.significant ? "" : "weak"].join(" "), "data-effect": e.id, onpointerenter: () => point(e.testable ? e.id : ""), onpointerleave: () => point(""), onfocusin: () => point(e.testable ? e.id : ""), onfocusout: () => point("") },
      check,
      h("button.title", { type: "button", "aria-expanded": "false", onclick: () => unfold(e.id) }, h("b", {}, e.title || e.id), h("code", {}, e.id), e.found ? h("em.badge", {}, "missing") : null),
      h("span.after", { title: "error that it alone would leave" }, e.after_Eo === null ? "–" : number(e.after_Eo), h("small", {}, " Eo")),
      h("span.evidence", { title: `p = ${e.p}, ΔBIC ${e.delta_bic}` }, meter, h("small", {}, e.probability === null ? `p ${e.p}` : `${number(100 * e.probability, 2)} %`)),
      h("div.about", { hidden: true }),
    );
  };

  const about = (e) => [
    e.equation ? h("div.equation", { tabindex: "0", role: "group", "aria-label": "Equation" }, maths(e.equation)) : null,
    e.physics ? h("p.physics", {}, e.physics) : null,
    e.values.length ? h("table.values", {}, h("tbody", {}, e.values.map((v) => h("tr", {}, h("th", { scope: "row" }, v.name, v.of ? h("small", {}, ` ${v.of}`) : ""), h("td", {}, v.text))))) : null,
    h("dl.facts", {},
      h("dt", {}, "alone"), h("dd", {}, `${number(e.after_Eo)} Eo, held out ${number(e.holdout_Eo)} Eo; p ${e.p}; ΔBIC ${e.delta_bic}`),
      e.indistinguishable.length ? [h("dt", {}, "not told from"), h("dd", {}, e.indistinguishable.map((t, k) => [k ? ", " : "", h("code", {}, t)]))] : null,
      e.seen_from.length ? [h("dt", {}, "seen from"), h("dd", {}, e.seen_from.join("; "), " on (3 σ)")] : null,
      e.channels && e.channels.length ? [h("dt", {}, "needs"), h("dd", {}, e.channels.join(", "))] : null,
      e.limits ? [h("dt", {}, "limits"), h("dd", {}, e.limits)] : null,
      e.source ? [h("dt", {}, "source"), h("dd", {}, e.source)] : null),
  ];

  const marks = () => {
    for (const li of list.children) {
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
    const { state } = server;
    const now = foreseen();
    const ready = state && state.effects.length;
    if (!ready) return foot.replaceChildren();
    const n = view.ticked.length;
    fill(
      foot,
      n && now
        ? h("p.foreseen", { role: "status" }, h("span", {}, number(now.before_Eo)), " → ", h("b", {}, number(now.rms_Eo)), " Eo", h("small", {}, `held out ${number(now.holdout_Eo)}, noise ${number(now.noise_Eo)}`))
        : h("p.foreseen.quiet", {}, "Tick an effect to see what the error would become."),
      h("button.main", { type: "button", disabled: !n || Boolean(state.status.job), onclick: commit, title: "Derive and calibrate (a)" }, n > 1 ? `Derive ${n} effects and calibrate` : "Derive and calibrate"),
    );
  };

  const commit = () => view.ticked.length && doing("add", { effects: view.ticked });

  const keys = (e) => {
    if (e.ctrlKey || e.metaKey || e.altKey || /^(textarea|select)$/i.test(e.target.tagName) || (e.target.tagName === "INPUT" && e.target.type !== "checkbox")) return;
    const items = [...list.querySelectorAll(".title")];
    const at = items.findIndex((b) => b.closest("li").contains(document.activeElement));
    if (e.key === "j" || e.key === "k") {
      const next = items[Math.min(items.length - 1, Math.max(0, at + (e.key === "j" ? 1 : -1)))];
      if (next) next.focus();
    } else if (e.key === " " && at >= 0 && document.activeElement === items[at]) {
      const id = items[at].closest("li").dataset.effect;
      if (!items[at].closest("li").querySelector("input").disabled) tick(id);
    } else if (e.key === "a") commit();
    else return;
    e.preventDefault();
  };
  addEventListener("keydown", keys);
  const off = [on("ticked open", marks), on("foreseen ticked", footer), () => removeEventListener("keydown", keys)];
  return { known, gone: () => off.forEach((f) => f()) };
}

// What ticked effects would leave: asked at once, shown everywhere.

let found = null;
let asked = 0;

/** The last answer for what is ticked, or null. */
export const foreseen = () => found;

async function again() {
  const mine = ++asked;
  const effects = view.ticked.join(",");
  if (!effects || !server.state || !server.state.effects.length) {
    found = null;
    look({ foreseen: String(mine) }, true);
    return;
  }
  const began = performance.now();
  try {
    const answer = await ask("preview", { effects });
    if (mine !== asked) return;
    found = answer;
    document.documentElement.dataset.preview = (performance.now() - began).toFixed(1);
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    found = null;
  }
  look({ foreseen: String(mine) }, true);
}

on("ticked", again);
on("server", () => {
  // effects that are in the model now, or unknown, are ticked no longer
  const ids = new Set((server.state ? server.state.effects : []).map((e) => e.id));
  if (server.state && server.state.effects.length) {
    const kept = view.ticked.filter((e) => ids.has(e));
    if (kept.length !== view.ticked.length) look({ ticked: kept });
    else if (view.ticked.length && !found) again();
  } else if (server.state && server.state.banner && !server.state.effects.length && found) again();
});
