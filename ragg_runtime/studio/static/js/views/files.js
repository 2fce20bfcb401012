// Choose or drop files: model directories, test sheets, flights, below the folders that were named at the start.
import { ask, Refused, upload } from "../api.js";
import { counted, fill, h, number } from "../dom.js";
import { look, on, server, view } from "../store.js";
import { doing, trouble } from "../doing.js";
import { mappingPane } from "./mapping.js";

const SIZE = (b) => (b > 1e9 ? `${number(b / 1e9)} GB` : b > 1e6 ? `${number(b / 1e6)} MB` : b > 1e3 ? `${number(b / 1e3)} kB` : `${b} B`);

export function filesView(main) {
  const now = h("section.card");
  const list = h("section.card"), columns = h("section.card", { hidden: true });
  const chosen = new Set();
  let folder = "";
  const show = async (place) => {
    try {
      const found = await ask("folder", { place });
      folder = found.folder;
      draw(found);
    } catch (error) {
      if (error instanceof Refused) trouble(error.facts);
    }
  };
  const open = async (model, flights) => {
    if (await doing("open", { model, flights })) look({ view: "loop", from: null, to: null, ticked: [], term: "", flight: 0 });
  };

  const draw = (found) => {
    const busy = Boolean(server.state && server.state.status.job);
    const model = Boolean(server.state && server.state.model);
    const name = h("input", { type: "text", value: "my-model", "aria-label": "Name of the new model directory", spellcheck: "false" });
    fill(
      list,
      h("h2", {}, "Open"),
      found.roots.length > 1 && h("p.path", {}, found.roots.map((r) => h("button.quiet", { type: "button", onclick: () => show(r) }, r))),
      h("p.path", {}, h("code", {}, found.folder), found.above ? h("button", { type: "button", onclick: () => show(found.above) }, "↑ up") : null),
      h("ul.entries", {}, found.entries.map((e) => h("li", { class: e.kind },
        e.kind === "folder" ? h("button.quiet", { type: "button", onclick: () => show(e.path) }, `${e.name}/`)
        : e.kind === "model" ? [h("span", {}, h("b", {}, e.name), h("small", {}, " model directory")), h("span.do", {}, h("button", { type: "button", onclick: () => show(e.path) }, "look inside"), h("button", { type: "button", disabled: busy, onclick: () => open(e.path, []) }, "open"))]
        : e.kind === "sheet" ? [h("span", {}, e.name, h("small", {}, " test sheet")), h("span.do", {}, h("button", { type: "button", disabled: busy, onclick: () => doing("new", { model: `${folder}/${name.value}`, sheet: e.path }) }, "make a model of it"))]
        : [h("label", {}, h("input", { type: "checkbox", checked: chosen.has(e.path), onchange: (x) => (x.target.checked ? chosen.add(e.path) : chosen.delete(e.path), show(folder)) }), e.name, h("small", {}, ` ${SIZE(e.bytes)}`)),
          e.kind === "flight" && model ? h("span.do", {}, h("button", { type: "button", disabled: busy, onclick: () => mappingPane(columns, e.path, trouble), "aria-label": `Say what the columns of ${e.name} are` }, "columns")) : null]))),
      h("div.row", {},
        h("button.main", { type: "button", disabled: !chosen.size || !model || busy, onclick: () => open(null, [...chosen]) }, chosen.size ? `Open ${chosen.size} ${chosen.size > 1 ? "flights" : "flight"} with ${model ? server.state.model.name : "a model"}` : "Tick flights to open them"),
        h("span.spacer"), name,
        h("button", { type: "button", disabled: busy, onclick: () => doing("new", { model: `${folder}/${name.value}` }) }, "New model from the example sheet")),
      model ? null : h("p.note", {}, "Open a model directory first, or make one: a flight is read in its units."),
    );
  };

  const drop = h("section.card.drop", {},
    h("p", {}, "Drop flights here (CSV, Parquet, NetCDF, HDF5, MATLAB, Excel), or ", h("label.file", {}, "choose them", h("input", { type: "file", multiple: true, onchange: (e) => take([...e.target.files]) })), "."),
    h("p.note", {}, "They are laid into the folder flights of the model directory, never over another file. Columns carry their units: time [s], a_x [m/s^2], omega_x [deg/h], G_out [V] …"));
  const take = async (files) => {
    const paths = [];
    try {
      for (const file of files) paths.push((await upload(file)).path);
    } catch (error) {
      if (error instanceof Refused) return trouble(error.facts);
      throw error;
    }
    if (paths.length) open(null, paths);
  };
  drop.addEventListener("dragover", (e) => (e.preventDefault(), drop.classList.add("over")));
  drop.addEventListener("dragleave", () => drop.classList.remove("over"));
  drop.addEventListener("drop", (e) => (e.preventDefault(), drop.classList.remove("over"), take([...e.dataTransfer.files])));

  const known = () => {
    const { state } = server;
    fill(now, h("h2", {}, "Open now"),
      state && state.model ? h("p", {}, h("b", {}, state.model.name), " ", h("code", {}, state.model.path), state.model.notes.map((n) => h("p.note", {}, n))) : h("p.note", {}, "No model."),
      state && state.flights.length ? h("div.wide", {}, h("table.numbers", {}, h("thead", {}, h("tr", {}, h("th", {}, "flight"), h("th.n", {}, "samples"), h("th.n", {}, "rate, Hz"), h("th.n", {}, "duration, s"), h("th.n", {}, "not usable"), h("th", {}, "outputs"))),
        h("tbody", {}, state.flights.map((f) => h("tr", {}, h("th", { scope: "row" }, f.name, f.notes.map((n) => h("small.block", {}, n))), h("td.n", {}, counted(f.samples)), h("td.n", {}, number(f.rate_Hz, 4)), h("td.n", {}, number(f.duration_s, 4)), h("td.n", {}, String(f.samples - f.valid)), h("td", {}, f.outputs.join(", "))))))) : h("p.note", {}, "No flight."));
    if (folder) show(folder);
  };
  fill(main, now, columns, drop, list);
  known();
  if (view.columns) {
    mappingPane(columns, view.columns, trouble);
    look({ columns: "" }, true);
  }
  show("");
  return on("server", known);
}
