// Choose or drop files: model directories, test sheets, flights, below the folders that were named at the start.
import { ask, doing, post, Refused, trouble, upload } from "./api.js";
import { calm, counted, fill, h, hertz, number, s } from "./dom.js";
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

// What the columns of a foreign file are: only what the file leaves open is asked; the rest can be looked over.

const TWO = ["date clock", "gps"], DATES = ["d/m/y", "m/d/y"]; // ways of writing time in two columns, and in one or two
const FORMATS = [["seconds", "seconds"], ["iso", "date and time"], ["d/m/y", "day/month/year"], ["m/d/y", "month/day/year"], ["clock", "time of the day"], ["date clock", "date, time of the day"], ["gps", "GPS week, second"]];
const AXES = ["x", "y", "z", "-x", "-y", "-z"];
const OPEN = "?";

function sparkline(points) {
  const known = points.filter((v) => v !== null), low = Math.min(...known), high = Math.max(...known);
  let d = "", pen = "M";
  points.forEach((v, k) => {
    if (v === null) return void (pen = "M");
    d += `${pen}${((120 * k) / Math.max(1, points.length - 1)).toFixed(1)} ${(21 - (18 * (v - low)) / (high - low || 1)).toFixed(1)}`;
    pen = "L";
  });
  return s("svg", { viewBox: "0 0 120 24", class: "sparkline", "aria-hidden": "true" }, s("path", { d }));
}

/** Asks for a file's columns in `box`; `trouble` tells what goes wrong. */
export async function mappingPane(box, path, trouble) {
  let known;
  try {
    known = await ask("mapping", { flight: path });
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    return trouble(error.facts);
  }
  const { rows, time } = known, numeric = known.columns.filter((c) => !c.text), message = h("p.note", { role: "status" });
  const seen = new Map(), keep = h("button.main", { type: "button", disabled: true });
  const names = (found, value) => [h("option", { value: "", selected: !value || value === OPEN }, "–"), found.map((c) => h("option", { value: c.name, selected: c.name === value }, c.name))];

  const row = (r) => {
    const place = h("td.preview"), unit = h("input", { type: "text", value: r.unit === OPEN ? "" : r.unit, placeholder: "unit", "aria-label": `unit of ${r.channel}`, spellcheck: "false", oninput: (e) => ((r.unit = e.target.value.trim() || OPEN), again()) });
    seen.set(r.channel, place);
    const column = h("select", { "aria-label": `column of ${r.channel}`, onchange: (e) => {
      r.column = e.target.value || OPEN;
      const own = known.columns.find((c) => c.name === r.column);
      if (own && own.unit) unit.value = r.unit = own.unit;
      again();
    } }, names(numeric, r.column));
    return h("tr", {}, h("th", { scope: "row" }, h("code", {}, r.channel), h("small", {}, ` ${r.sure}`)), h("td", {}, column), h("td", {}, unit),
      h("td", {}, h("select", { "aria-label": `sign of ${r.channel}`, onchange: (e) => ((r.sign = Number(e.target.value)), again()) }, h("option", { value: "1", selected: r.sign !== -1 }, "+"), h("option", { value: "-1", selected: r.sign === -1 }, "−"))),
      h("td", {}, h("input", { type: "text", inputmode: "decimal", value: String(r.scale), "aria-label": `factor of ${r.channel}`, oninput: (e) => ((r.scale = Number(e.target.value)), again()) })), place);
  };
  const table = (found) => h("div.wide", {}, h("table.numbers.mapping", {}, h("thead", {}, h("tr", {}, ["channel", "column of the file", "unit there", "sign", "factor", "preview"].map((t) => h("th", { scope: "col" }, t)))), h("tbody", {}, found.map(row))));

  const clock = () => {
    const two = TWO.includes(time.format), perhaps = DATES.includes(time.format), given = [time.column].flat();
    const pick = (k) => h("select", { "aria-label": k ? "second column of time" : "column of time", onchange: (e) => {
      given[k] = e.target.value || OPEN;
      time.column = two || (perhaps && given[1] && given[1] !== OPEN) ? [given[0] || OPEN, given[1] || OPEN] : given[0];
      again();
    } }, names(known.columns, given[k]));
    return [h("label", {}, "time ", pick(0)), two || perhaps ? pick(1) : null,
      h("label", {}, "written as ", h("select", { "aria-label": "how time is written", onchange: (e) => ((time.format = e.target.value), (time.column = given[1] && [...TWO, ...DATES].includes(time.format) ? given : given[0]), fill(clocks, clock()), again()) }, FORMATS.map(([v, name]) => h("option", { value: v, selected: v === time.format }, name)))),
      time.format === "seconds" ? h("label", {}, "unit ", h("input", { type: "text", value: time.unit === OPEN ? "" : time.unit, "aria-label": "unit of time", oninput: (e) => ((time.unit = e.target.value.trim() || OPEN), again()) })) : null];
  };
  const clocks = h("div.row.choices");
  fill(clocks, clock());
  const axes = h("div.row.choices", {}, "axes of the frame among the recorder’s:", ["x", "y", "z"].map((a) => h("label", {}, `${a} = `, h("select", { "aria-label": `axis ${a}`, onchange: (e) => ((known.axes[a] = e.target.value), again()) }, AXES.map((v) => h("option", { value: v, selected: known.axes[a] === v }, v.replace("-", "−")))))));

  const sent = () => ({ flight: path, mapping: { rows, time, file: known.file, axes: known.axes } });
  const again = calm(async () => {
    try {
      const found = await post("mapping", sent());
      const e = found.error;
      message.textContent = e ? [e.where, e.what, e.expected && `expected: ${e.expected}`].filter(Boolean).join(" – ") : "All columns recognised.";
      keep.disabled = Boolean(e);
      for (const place of seen.values()) place.replaceChildren();
      for (const p of found.preview) if (seen.has(p.channel)) fill(seen.get(p.channel), sparkline(p.points), h("small", {}, `${p.ends.join(" … ")} ${p.unit}, median ${p.median}`));
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      message.textContent = error.message;
      keep.disabled = true;
    }
  }, 150);

  const asked = rows.filter((r) => r.asked), sure = rows.filter((r) => !r.asked);
  keep.textContent = known.kept ? "Replace the model’s mapping and open the flight" : "Save with the model and open the flight";
  keep.onclick = async () => (await doing("map", { ...sent(), replace: known.kept })) && look({ view: "loop", from: null, to: null, ticked: [], flight: 0 });
  box.hidden = false;
  fill(box, h("h2", { tabindex: "-1" }, `Columns of ${path.split("/").pop()}`),
    h("p.note", {}, asked.length ? "Only what the file does not say is asked. Units are never guessed." : "All columns recognised."),
    clocks, asked.length ? table(asked) : null,
    sure.length ? h("details", { open: !asked.length }, h("summary", {}, `${sure.length} more, by their names`), table(sure), axes) : axes,
    h("div.row", {}, keep, h("button", { type: "button", onclick: () => (box.hidden = true) }, "Close"), message));
  box.querySelector("h2").focus();
  again();
}
