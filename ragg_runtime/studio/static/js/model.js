// Which parameters the record sees: combinations with uncertainty, correlations, the pull of the sheet, the next motion.
import { ask, doing, Refused } from "./api.js";
import { branchTree, curvesText, drawingText, fileName, frame, pullBars, saves } from "./drawings.js";
import { fill, h, number, symbol } from "./dom.js";
import { on, server, view } from "./store.js";
import { spectrumLines, spectrumPlot } from "./curves.js";

const CAPTION = "Calibrated ± uncertainty; below it the test sheet. Grey: the record does not see it, the value is the sheet’s. Italic: it sees a part of it.";
const FEW = 2; // sums up to which they are told in the line; more are unfolded

const cell = (c) => h("td", { class: `n ${c.state}`, title: `test sheet: ${c.nominal}` }, c.value, h("small", {}, c.nominal));

const table = (rows, heads, caption) =>
  h("div.wide", { tabindex: "0", role: "group", "aria-label": caption }, h("table.numbers", { class: heads.length > 4 ? "many" : "" }, h("caption", {}, caption),
    h("thead", {}, h("tr", {}, h("th", {}, "parameter"), h("th", {}, "unit"), heads.map((x) => h("th.n", {}, x)))),
    h("tbody", {}, rows.map((row) => h("tr", {}, h("th", { scope: "row", title: row.symbol.meaning }, symbol(row.symbol.pieces), h("small", {}, ` ${row.symbol.name}`)), h("td", {}, row.unit), row.cells.length === 1 ? [cell(row.cells[0]), h("td", { colspan: String(heads.length - 1) })] : row.cells.map(cell))))));

const piece = (p, k) => [p.sign ? ` ${p.sign} ` : k ? " " : "", p.factor ? `${p.factor} ` : "", p.pattern ? [h("span.pattern", {}, p.pattern), " "] : "", symbol(p.symbol.pieces)];
const sum = (row) => row.map(piece);
const listed = (items) => items.map((x, k) => [k ? ", " : "", x]);

/** [{pattern, symbol}] as "K₂, K₅ of A1, A2": those that stand for the same accelerometers together. */
function gathered(members) {
  const own = new Map();
  for (const m of members) {
    const known = own.get(m.symbol.name) || { symbol: m.symbol, of: [] };
    known.of.push(m.pattern);
    own.set(m.symbol.name, known);
  }
  const alike = new Map();
  for (const x of own.values()) {
    const key = x.of.join(", ");
    alike.set(key, [...(alike.get(key) || []), x.symbol]);
  }
  return [...alike].map(([of, symbols], k) => [k ? "; " : "", listed(symbols.map((x) => symbol(x.pieces))), of ? [" of ", h("span.pattern", {}, of)] : ""]);
}

const group = (g) =>
  g.seen.length <= FEW
    ? h("li", {}, gathered(g.members), g.seen.length ? [": the record sees ", g.seen.map((row, k) => [k ? "; " : "", sum(row)])] : ": none of them")
    : h("li", {}, h("details", {}, h("summary", {}, gathered(g.members), `: of ${g.members.length} the record sees ${g.seen.length} sums`), h("ul.sums", {}, g.seen.map((row) => h("li", {}, sum(row))))));

/** What stays as the sheet has it: by combination, or of which accelerometers. */
const unseen = (p) =>
  p.patterned
    ? p.unseen.map((u) => h("li", {}, h("span.pattern", {}, u.pattern), " of ", listed(u.symbols.map((x) => symbol(x.pieces)))))
    : h("li", {}, gathered(p.unseen.flatMap((u) => u.symbols.map((x) => ({ pattern: u.pattern, symbol: x })))));

function pull(rows, model) {
  const drawn = pullBars(rows.map((x) => ({ name: x.of.pattern, pieces: x.of.symbol.pieces, symbol: x.of.symbol.name, sigma: x.sigma })));
  return h("section.card", {}, h("figure.drawn", { "aria-label": "Pull of the test sheet" },
    h("figcaption", {}, h("h2", {}, "Pull of the test sheet"), h("span.spacer"), saves("Pull of the test sheet", () => fileName(model, "pull"), () => drawingText(drawn))),
    h("p.note", {}, "How far the calibration moved a value from the sheet, in plausible errors; the farthest."), drawn));
}

export function parametersView(main) {
  let shown = "";
  const known = () => {
    const { state } = server;
    const p = state && state.parameters;
    const key = JSON.stringify([p, p && state.next_motion]);
    if (key === shown) return; // what is unfolded stays so
    shown = key;
    if (!p) return void fill(main, h("p.empty-note", {}, "The parameters are known once a flight is compared."));
    fill(
      main,
      h("section.card", {}, h("h2", {}, "What the record determines"),
        h("p.lead", {}, `${p.determined} of ${p.total} directions of the parameters are the record’s own; the others stay where the test sheet puts them.`),
        p.groups.length ? [h("h3", {}, "Seen together only"), h("ul.together", {}, p.groups.map(group))] : null,
        p.unseen.length ? [h("h3", {}, "Not seen at all"), h("ul", {}, unseen(p))] : null),
      p.combined.length ? h("section.card", {}, h("h2", {}, "Combinations of the four accelerometers"), table(p.combined, p.patterns, CAPTION)) : null,
      h("div.pair", {},
        pull(p.pull, state.model.name),
        h("section.card", {}, h("h2", {}, "Tied most closely"), h("p.note", {}, "Correlations of calibrated values: what the record tells of both together rather than of each."),
          h("ul.tied", {}, p.correlations.map((x) => h("li", {}, h("span", {}, piece(x.a, 0)), h("span", {}, piece(x.b, 0)), h("b", {}, (x.r < 0 ? "−" : "+") + Math.abs(x.r).toFixed(3))))))),
      h("section.card", {}, h("h2", {}, "Each accelerometer"), table(p.single, p.accelerometers, CAPTION)),
      h("section.card", {}, h("h2", {}, "Which flight next"), state.next_motion.length ? h("ul", {}, state.next_motion.map((m) => h("li", {}, m.words))) : h("p.note", {}, "No rivals are left that another motion would have to tell apart.")),
    );
  };
  known();
  return on("server", known);
}

// The test sheet as a table that can be edited: values of every accelerometer in display units, and how sure the sheet is of them.

const parsed = (text) => (text.trim() === "" ? NaN : Number(text.trim().replace("−", "-").replace(",", ".")));
const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);
const plain = (v) => (Math.abs(v) >= 1e6 ? v.toExponential().replace("e+", "e") : String(v));

export function sheetView(main) {
  const changed = new Map(); // name -> { value, sigma }, NaN where something is no number
  let shown = "";

  const known = () => {
    const { state } = server;
    if (!state || !state.sheet) return void fill(main, h("p.empty-note", {}, "Open a model directory to see its test sheet."));
    const key = JSON.stringify(state.sheet);
    if (key !== shown) {
      shown = key;
      changed.clear();
      draw(state.sheet);
    }
    foot();
  };

  const save = h("button.main", { type: "button", onclick: () => send() });
  const revert = h("button", { type: "button", onclick: () => ((shown = ""), known()) }, "Discard");

  const sure = ({ sigma }) => (sigma === null ? "" : sigma.every((v) => v === sigma[0]) ? plain(sigma[0]) : sigma.map(plain).join("; "));
  const draw = ({ names, rows }) =>
    fill(
      main,
      h("section.card", {},
        h("h2", {}, "Test sheet"),
        h("p.note", {}, "The nominal values, as model.toml holds them; comments there are kept. “Sure to” is how far the sheet says a value may be off, one standard deviation: one number for all accelerometers, or one for each with semicolons between. Where it is empty, the plausible error counts: one that would not surprise. The calibration moves a value by a few of these."),
        h("div.wide", { tabindex: "0", role: "group", "aria-label": "Values of the test sheet" }, h("table.numbers.sheet", { class: names.length > 4 ? "many" : "" },
          h("thead", {}, h("tr", {}, h("th", {}, "parameter"), h("th", {}, "unit"), names.map((a) => h("th.n", {}, a)), h("th.n", {}, "sure to ±"), h("th.n", {}, "plausible ±"))),
          h("tbody", {}, rows.map((row) => h("tr", {},
            h("th", { scope: "row" }, symbol(row.symbol), h("small", {}, ` ${row.meaning}`)), h("td", {}, row.unit_shown),
            row.values.map((v, k) => h("td.n", {}, h("input", { type: "text", inputmode: "decimal", value: plain(v), "aria-label": `${row.name} of ${names[k]}, ${row.unit}`, autocomplete: "off", oninput: (e) => edit(row, e.target, (now) => (now.value[k] = parsed(e.target.value))) }))),
            h("td.n", {}, h("input", { type: "text", value: sure(row), placeholder: plain(row.plausible[0]), "aria-label": `${row.name}: how sure the sheet is, ${row.unit}`, autocomplete: "off", oninput: (e) => edit(row, e.target, (now) => (now.sigma = sigmas(e.target.value, names.length))) })),
            h("td.n.quiet", {}, number(row.plausible[0], 3))))))),
        h("div.row", {}, save, revert)),
    );

  const sigmas = (text, count) => {
    if (!text.trim()) return null;
    const found = text.split(";").map(parsed), all = found.length === 1 ? Array(count).fill(found[0]) : found;
    return all.length === count && all.every((v) => v > 0) ? all : [NaN];
  };

  const edit = (row, input, set) => {
    const now = changed.get(row.name) || { value: [...row.values], sigma: row.sigma };
    set(now);
    input.setAttribute("aria-invalid", String(invalid(input)));
    if (same(now, { value: row.values, sigma: row.sigma })) changed.delete(row.name);
    else changed.set(row.name, now);
    input.classList.toggle("edited", changed.has(row.name) && input.value !== input.defaultValue);
    foot();
  };
  const invalid = (input) => (input.placeholder ? bad({ value: [], sigma: sigmas(input.value, server.state.sheet.names.length) }) : !Number.isFinite(parsed(input.value)));

  const bad = ({ value, sigma }) => [...value, ...(sigma || [])].some((v) => !Number.isFinite(v));
  const foot = () => {
    save.textContent = changed.size ? `Save ${changed.size} changed ${changed.size > 1 ? "parameters" : "parameter"}` : "Nothing changed";
    save.disabled = !changed.size || [...changed.values()].some(bad) || Boolean(server.state.status.job);
    revert.hidden = !changed.size;
  };

  const send = () => {
    const unit = (name) => server.state.sheet.rows.find((r) => r.name === name).unit;
    doing("edit", { values: Object.fromEntries([...changed].map(([name, now]) => [name, { ...now, unit: unit(name) }])) });
  };

  known();
  return on("server", known);
}

// The steps as they were made, and the branches that were left; any state can be compared beside the present one.

const SAID = { new: "made from a test sheet", add: "added", remove: "removed", edit: "sheet edited:", undo: "undo", redo: "redo", restore: "went back", calibrate: "calibration kept" };
const SHORT = { new: () => "test sheet", add: (s) => `+ ${s.effect}`, remove: (s) => `− ${s.effect}`, edit: (s) => `sheet: ${s.effect}`, restore: (s) => `as after ${Number(s.effect) + 1}` };

export function historyView(main) {
  const steps = h("section.card"), two = h("section.card", { hidden: true });
  fill(main, steps, two);
  let drawn = null, shown = "";
  const drop = () => (drawn && drawn.gone(), (drawn = null));

  const known = () => {
    const { state } = server;
    if (!state || !state.history) return void fill(main, h("p.empty-note", {}, "Open a model directory to see its history."));
    if (!steps.isConnected) fill(main, steps, two);
    listed(state);
    const key = JSON.stringify([state.beside, state.banner && state.banner.errors, view.flight]);
    if (key === shown) return;
    shown = key;
    drop();
    two.hidden = !(state.beside && state.banner);
    if (!two.hidden) drawn = beside(two, state);
  };

  const listed = (state) => {
    const { history } = state, busy = Boolean(state.status.job);
    const of = (n) => history.steps.find((s) => s.n === n);
    const states = history.tree.map((x) => ({ ...x, label: (SHORT[of(x.n).action] || (() => of(x.n).action))(of(x.n)), after: of(x.n).after, present: of(x.n).present }));
    fill(
      steps,
      h("h2", {}, "History"),
      h("p.note", {}, "Nothing is ever taken out of it: undo and redo are steps themselves. Grey states lie on a branch that was left; one can go back to each."),
      h("div.row", {},
        h("button", { type: "button", disabled: !history.can_undo || busy, onclick: () => doing("undo") }, "Undo"),
        h("button", { type: "button", disabled: !history.can_redo || busy, onclick: () => doing("redo") }, "Redo")),
      states.length ? branches(state.model.name, branchTree(states, history.now)) : null,
      h("div.wide", {}, h("table.numbers.history", {},
        h("thead", {}, h("tr", {}, h("th", {}, "no."), h("th", {}, "when"), h("th", {}, "step"), h("th.n", {}, "before, Eo"), h("th.n", {}, "after, Eo"), h("th.n", {}, "held out, Eo"), h("th", {}, "flights"), h("th", { "aria-label": "what can be done" }))),
        h("tbody", {}, [...history.steps].reverse().map((s) => h("tr", { class: s.present ? "" : "left" },
          h("td", {}, String(s.n + 1)), h("td", {}, new Date(s.time).toLocaleString("sv")),
          h("th", { scope: "row" }, `${SAID[s.action] || s.action} `, s.action === "add" || s.action === "remove" ? h("code", {}, s.effect) : /^\d+$/.test(s.effect) ? `to the state after step ${Number(s.effect) + 1}` : s.effect, s.n === history.now ? h("em.badge", {}, "present") : null),
          [s.before, s.after, s.holdout].map((x) => h("td.n", {}, x === null ? "–" : number(x))),
          h("td", {}, s.flights.join(", ")),
          h("td.do", {},
            s.kept && s.n !== history.now ? h("button", { type: "button", disabled: busy, onclick: () => doing("restore", { step: s.n }), "aria-label": `Go back to the state after step ${s.n + 1}` }, "go back") : null,
            s.kept && s.n !== history.now && state.flights.length ? h("button", { type: "button", disabled: busy, onclick: () => doing("beside", { step: s.n }), "aria-label": `Compare the state after step ${s.n + 1} beside the present one` }, "beside") : null)))))));
  };
  known();
  const offs = [on("server", known), on("flight", known)];
  return () => (offs.forEach((f) => f()), drop());
}

const branches = (name, tree) => h("figure.tree-box", { "aria-label": "Branches" }, h("div.wide", { tabindex: "0", role: "group", "aria-label": "The states of the model as a tree" }, tree), saves("Branches", () => fileName(name, "history"), () => drawingText(tree)));

function beside(box, state) {
  const b = state.beside, now = state.banner, old = `after step ${b.step + 1}`;
  const errors = (label, pick) => h("tr", {}, h("th", { scope: "row" }, label), h("td.n", {}, number(pick(0))), h("td.n", {}, number(pick(1))));
  const rows = [["nominal", "nominal", 0], ["calibrated", "calibrated", 1], ["held out", "holdout", 2]];
  const figure = frame({ id: "spectrum", title: "Spectrum of the residual", kind: "figure", name: () => fileName(state.model.name, "two-models"), text: () => curvesText(plot.plot) });
  fill(box,
    h("h2", {}, "Two models side by side"),
    h("p.note", {}, "Both calibrated on the flights that are open."),
    h("div.pair", {},
      h("div.wide", {}, h("table.numbers", {},
        h("thead", {}, h("tr", {}, h("th", {}, "error before demodulation, Eo"), h("th.n", {}, old), h("th.n", {}, "now"))),
        h("tbody", {},
          h("tr", {}, h("th", { scope: "row" }, "effects"), h("td.n", {}, b.effects.join(", ") || "none"), h("td.n", {}, state.model.effects.map((e) => e.id).join(", ") || "none")),
          rows.map(([label, key, k]) => errors(label, (which) => (which ? now.errors[k].rms_Eo : b.errors[key].rms_Eo))),
          rows.slice(1).map(([label, key, k]) => ["inline", "cross"].map((c) => errors(`${label}, ${c}, Eo/√Hz`, (which) => (which ? now.errors[k].json : b.errors[key])[`${c}_Eo_per_rtHz`]))),
          errors("noise floor", (which) => (which ? now.noise.rms_Eo : b.noise_Eo))))),
      figure.element),
    h("div.row", {}, h("button", { type: "button", onclick: () => doing("beside", { step: null }) }, "Close")));
  const plot = spectrumPlot(figure.body, { band: () => [null, null], banded: () => {}, harmonic: () => null });
  ask("spectrum", { flight: view.flight, output: view.output }).then((found) => {
    delete found.lines.before;
    plot.show(found);
    figure.keys(spectrumLines.filter((l) => l.id === "noise" || found.lines[l.id]).map((l) => [l.id === "beside" ? old : l.id === "residual" ? "now" : l.name, l.colour, l.dash ? "dashed" : ""]));
  }).catch((error) => {
    if (!(error instanceof Refused)) throw error;
    figure.say(error.facts.what);
  });
  return plot;
}
