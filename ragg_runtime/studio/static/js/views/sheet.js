// The test sheet as a table that can be edited: values of A1 ... A4 in display units, and how far they may be off.
import { fill, h, number, symbol } from "../dom.js";
import { on, server } from "../store.js";
import { doing } from "../doing.js";

export function sheetView(main) {
  const changed = new Map();
  let shown = "";

  const known = () => {
    const { state } = server;
    if (!state || !state.sheet) return void fill(main, h("p.empty-note", {}, "Open a model directory to see its test sheet."));
    const key = JSON.stringify(state.sheet);
    if (key !== shown) {
      shown = key;
      changed.clear();
      draw(state);
    }
    foot();
  };

  const save = h("button.main", { type: "button", onclick: () => send() });
  const revert = h("button", { type: "button", onclick: () => ((shown = ""), known()) }, "Discard");

  const draw = (state) =>
    fill(
      main,
      h("section.card", {},
        h("h2", {}, "Test sheet"),
        h("p.note", {}, "The nominal values, as model.toml holds them; comments there are kept. “Plausible” is the size of error that would not surprise: the calibration moves a value by a few of these."),
        h("div.wide", {}, h("table.numbers.sheet", {},
          h("thead", {}, h("tr", {}, h("th", {}, "parameter"), h("th", {}, "unit"), ["A1", "A2", "A3", "A4"].map((a) => h("th.n", {}, a)), h("th.n", {}, "plausible ±"))),
          h("tbody", {}, state.sheet.map((row) => h("tr", {},
            h("th", { scope: "row" }, symbol(row.symbol), h("small", {}, ` ${row.meaning}`)), h("td", {}, row.unit),
            row.values.map((v, k) => h("td.n", {}, h("input", { type: "text", inputmode: "decimal", value: String(v), "aria-label": `${row.name} of A${k + 1}, ${row.unit}`, autocomplete: "off", oninput: (e) => edit(row, k, e.target) }))),
            h("td.n.quiet", {}, number(row.plausible[0], 3))))))),
        h("div.row", {}, save, revert)),
    );

  const edit = (row, k, input) => {
    const value = Number(input.value.replace("−", "-").replace(",", "."));
    const good = input.value.trim() !== "" && Number.isFinite(value);
    input.setAttribute("aria-invalid", String(!good));
    const values = changed.get(row.name) || [...row.values];
    values[k] = good ? value : NaN;
    if (values.every((v, i) => v === row.values[i])) changed.delete(row.name);
    else changed.set(row.name, values);
    input.classList.toggle("edited", values[k] !== row.values[k]);
    foot();
  };

  const foot = () => {
    const bad = [...changed.values()].some((v) => v.some(Number.isNaN));
    save.textContent = changed.size ? `Save ${changed.size} changed ${changed.size > 1 ? "parameters" : "parameter"}` : "Nothing changed";
    save.disabled = !changed.size || bad || Boolean(server.state.status.job);
    revert.hidden = !changed.size;
  };

  const send = () => {
    const values = Object.fromEntries([...changed].map(([name, value]) => [name, { value, unit: server.state.sheet.find((r) => r.name === name).unit }]));
    doing("edit", { values });
  };

  known();
  return on("server", known);
}
