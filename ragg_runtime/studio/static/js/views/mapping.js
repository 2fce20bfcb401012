// What the columns of a foreign file are: only what the file leaves open is asked; the rest can be looked over.
import { ask, post, Refused } from "../api.js";
import { calm, fill, h, s } from "../dom.js";
import { look } from "../store.js";
import { doing } from "../doing.js";

const FORMATS = [["seconds", "seconds"], ["iso", "date and time"], ["clock", "time of the day"], ["date clock", "date, time of the day"], ["gps", "GPS week, second"]];
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
  const table = (found) => h("div.wide", {}, h("table.numbers.mapping", {}, h("thead", {}, h("tr", {}, ["channel", "column of the file", "unit there", "sign", "factor", "what comes of it"].map((t) => h("th", { scope: "col" }, t)))), h("tbody", {}, found.map(row))));

  const clock = () => {
    const two = ["date clock", "gps"].includes(time.format), given = [time.column].flat();
    const pick = (k) => h("select", { "aria-label": k ? "second column of time" : "column of time", onchange: (e) => {
      given[k] = e.target.value || OPEN;
      time.column = two ? [given[0] || OPEN, given[1] || OPEN] : given[0];
      again();
    } }, names(known.columns, given[k]));
    return [h("label", {}, "time ", pick(0)), two ? pick(1) : null,
      h("label", {}, "written as ", h("select", { "aria-label": "how time is written", onchange: (e) => ((time.format = e.target.value), (time.column = two ? given[0] : given[0]), fill(clocks, clock()), again()) }, FORMATS.map(([v, name]) => h("option", { value: v, selected: v === time.format }, name)))),
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
      message.textContent = e ? [e.where, e.what, e.expected && `expected: ${e.expected}`].filter(Boolean).join(" – ") : "Every channel has an answer.";
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
  keep.textContent = known.kept ? "Replace the model’s mapping and open the flight" : "Keep with the model and open the flight";
  keep.onclick = async () => (await doing("map", { ...sent(), replace: known.kept })) && look({ view: "loop", from: null, to: null, ticked: [], term: "", flight: 0 });
  box.hidden = false;
  fill(box, h("h2", { tabindex: "-1" }, `What the columns of ${path.split("/").pop()} are`),
    h("p.note", {}, asked.length ? "Only what the file leaves open is asked. A unit is never guessed." : "The file leaves nothing open."),
    clocks, asked.length ? table(asked) : null,
    sure.length ? h("details", { open: !asked.length }, h("summary", {}, `${sure.length} more, by their names`), table(sure), axes) : axes,
    h("div.row", {}, keep, h("button", { type: "button", onclick: () => (box.hidden = true) }, "Close"), message));
  box.querySelector("h2").focus();
  again();
}
