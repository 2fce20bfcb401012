// Choose or drop files: model directories, test sheets, flights, below the folders that were named at the start.
import { ask, doing, post, Refused, trouble, upload } from "./api.js";
import { calm, counted, fill, h, hertz, number, sections } from "./dom.js";
import { look, on, server, view } from "./store.js";

export function filesView(main) {
  const now = h("section.card");
  const list = h("section.card"), columns = h("section.card", { hidden: true });
  const chosen = new Set();
  let folder = "", asked = "";
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
    if (await doing("open", { model, flights })) look({ view: "loop", from: null, to: null, ticked: [], flight: 0 });
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
        : [h("label", {}, h("input", { type: "checkbox", checked: chosen.has(e.path), onchange: (x) => (x.target.checked ? chosen.add(e.path) : chosen.delete(e.path), show(folder)) }), e.name),
          e.kind === "flight" && model ? h("span.do", {}, h("button", { type: "button", disabled: busy, onclick: () => mappingPane(columns, e.path, trouble), "aria-label": `Describe the columns of ${e.name}` }, "columns")) : null]))),
      h("div.row", {},
        h("button.main", { type: "button", disabled: !chosen.size || !model || busy, onclick: () => open(null, [...chosen]) }, chosen.size ? `Open ${chosen.size} ${chosen.size > 1 ? "flights" : "flight"} with ${model ? server.state.model.name : "a model"}` : "Tick flights to open them"),
        h("span.spacer"), name,
        h("button", { type: "button", disabled: busy, onclick: () => doing("new", { model: `${folder}/${name.value}` }) }, "New model from the example sheet")),
      model ? null : h("p.note", {}, "Open a model directory first, or make one: a flight is read in its units."),
    );
  };

  const drop = h("section.card.drop", {},
    h("p", {}, "Drop flights here (CSV, Parquet, NetCDF, HDF5, MATLAB, Excel), or ", h("label.file", {}, "choose them", h("input", { type: "file", multiple: true, onchange: (e) => take([...e.target.files]) })), "."),
    h("p.note", {}, "They are saved in the folder flights of the model directory; no file is overwritten. Columns have their units: time [s], a_x [m/s^2], omega_x [deg/h], G_out [V] …"));
  const take = async (files) => {
    const paths = [], said = drop.querySelector(".note"), words = said.textContent;
    try {
      for (const file of files) {
        said.textContent = `Saving and examining ${file.name} …`;
        paths.push((await upload(file)).path);
      }
    } catch (error) {
      if (error instanceof Refused) return trouble(error.facts);
      throw error;
    } finally {
      said.textContent = words;
    }
    if (paths.length) open(null, paths);
  };
  drop.addEventListener("dragover", (e) => (e.preventDefault(), drop.classList.add("over")));
  drop.addEventListener("dragleave", () => drop.classList.remove("over"));
  drop.addEventListener("drop", (e) => (e.preventDefault(), drop.classList.remove("over"), take([...e.dataTransfer.files])));

  const known = () => {
    const { state } = server;
    fill(now, h("h2", {}, "Open now"),
      state && state.model ? h("p", {}, h("b", {}, state.model.name), state.model.path === state.model.name ? null : [" ", h("code", {}, state.model.path)], state.model.notes.map((n) => h("p.note", {}, n))) : h("p.note", {}, "No model."),
      state && state.flights.length ? h("div.wide", {}, h("table.numbers", {}, h("thead", {}, h("tr", {}, h("th", {}, "flight"), h("th.n", {}, "samples"), h("th.n", {}, "rate, Hz"), h("th.n", {}, "duration, s"), h("th.n", {}, "not usable"), h("th", {}, "outputs"))),
        h("tbody", {}, state.flights.map((f) => h("tr", {}, h("th", { scope: "row" }, f.name, f.notes.map((n) => h("small.block", {}, n))), h("td.n", {}, counted(f.samples)), h("td.n", {}, hertz(f.rate_Hz)), h("td.n", {}, number(f.duration_s, 4)), h("td.n", {}, String(f.samples - f.valid)), h("td", {}, f.outputs.join(", "))))))) : h("p.note", {}, "No flight."));
    if (folder) show(folder);
    const [foreign] = state && !state.status.job && !state.status.error ? state.unread : [];
    if (foreign && foreign !== asked) mappingPane(columns, (asked = foreign), trouble);
  };
  fill(main, now, columns, drop, list);
  known();
  show("");
  return on("server", known);
}

// What the columns of a foreign file are: the mapping that `ragg map` drafts, to be completed, tried as it is written.

/** Asks for a file's columns in `box`; `trouble` tells what goes wrong. */
async function mappingPane(box, path, trouble) {
  let known;
  try {
    known = await ask("mapping", { flight: path });
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    return trouble(error.facts);
  }
  const message = h("p.note", { role: "status" }), preview = h("div"), keep = h("button.main", { type: "button", disabled: true });
  const text = h("textarea", { "aria-label": "mapping.toml", rows: String(known.text.split("\n").length + 1), spellcheck: "false", oninput: () => again() });
  text.value = known.text;
  const sent = () => ({ flight: path, mapping: text.value });
  const again = calm(async () => {
    try {
      const found = await post("mapping", sent()), e = found.error;
      message.textContent = e ? [e.where, e.what, e.found && `found: ${e.found}`, e.expected && `expected: ${e.expected}`].filter(Boolean).join(" – ") : "All columns recognised.";
      keep.disabled = Boolean(e);
      fill(preview, found.preview ? sections(found.preview) : null);
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      message.textContent = error.message;
      keep.disabled = true;
    }
  }, 150);
  keep.textContent = known.kept ? "Replace the model’s mapping and open the flight" : "Save with the model and open the flight";
  keep.onclick = async () => (await doing("map", { ...sent(), replace: known.kept })) && look({ view: "loop", from: null, to: null, ticked: [], flight: 0 });
  box.hidden = false;
  fill(box, h("h2", { tabindex: "-1" }, `Columns of ${path.split("/").pop()}`),
    h("p.note", {}, "A mapping says which columns of the file are which channels. Units are never guessed: replace every “?”."),
    known.questions.length ? h("ul", {}, known.questions.map((q) => h("li", {}, q))) : null,
    h("p.note", {}, `Columns of the file: ${known.columns.join(", ")}.`),
    text, message, preview,
    h("div.row", {}, keep, h("button", { type: "button", onclick: () => (box.hidden = true) }, "Close")));
  box.querySelector("h2").focus();
  again();
}
