// What the record determines of the parameters, the test sheet, and the history.
import { doing } from "./api.js";
import { fill, h, number, pictureNode, sections } from "./dom.js";
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
  const draw = ({ names, rows, discs }) =>
    fill(
      main,
      h("section.card", {},
        h("h2", {}, "Test sheet"),
        h("p.note", {}, "The nominal values of model.toml; its comments are kept. 1 sigma: how uncertain the test sheet is, one number for all accelerometers, or one for each, separated by semicolons. Where it is empty, the default prior holds. A parameter that is fixed is not fitted."),
        h("div.wide", { tabindex: "0", role: "group", "aria-label": "Values of the test sheet" }, h("table.numbers.sheet", { class: names.length > 4 ? "many" : "" },
          h("thead", {}, h("tr", {}, h("th", {}, "parameter"), h("th", {}, "unit"), names.map((a) => h("th.n", {}, a)), h("th.n", {}, "1 sigma"), h("th", {}, "fixed"), h("th.n", {}, "default prior"))),
          h("tbody", {}, rows.map((row) => h("tr", {},
            h("th", { scope: "row" }, h("b", {}, row.name), h("small", {}, ` ${row.meaning}`)), h("td", {}, row.unit_shown),
            row.values.map((v, k) => h("td.n", {}, h("input", { type: "text", inputmode: "decimal", value: plain(v), "aria-label": `${row.name} of ${names[k]}, ${row.unit}`, autocomplete: "off", oninput: (e) => edit(row, e.target, (now) => (now.value[k] = parsed(e.target.value))) }))),
            h("td.n", {}, h("input", { type: "text", value: sure(row), placeholder: plain(row.plausible[0]), "aria-label": `${row.name}: 1 sigma of the sheet, ${row.unit}`, autocomplete: "off", oninput: (e) => edit(row, e.target, (now) => (now.sigma = sigmas(e.target.value, names.length))) })),
            h("td", {}, h("input", { type: "checkbox", checked: row.fixed, "aria-label": `${row.name} is not fitted`, onchange: (e) => edit(row, e.target, (now) => (now.fixed = e.target.checked)) })),
            h("td.n.quiet", {}, number(row.plausible[0], 3))))))),
        h("div.row", {}, save, revert)),
      h("section.card", {}, sections(discs), h("p.note", {}, "From model.toml; edit them there.")),
    );

  const sigmas = (text, count) => {
    if (!text.trim()) return null;
    const found = text.split(";").map(parsed), all = found.length === 1 ? Array(count).fill(found[0]) : found;
    return all.length === count && all.every((v) => v > 0) ? all : [NaN];
  };

  const edit = (row, input, set) => {
    const now = changed.get(row.name) || { value: [...row.values], sigma: row.sigma, fixed: row.fixed };
    set(now);
    if (input.type === "text") input.setAttribute("aria-invalid", String(invalid(input)));
    if (same(now, { value: row.values, sigma: row.sigma, fixed: row.fixed })) changed.delete(row.name);
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
