// Every figure as SVG and as PNG, with its heading and legend: curves from their data, drawings and tables from what is seen.
import { colour } from "./curves.js";
import { fill, h, number, s } from "./dom.js";

function saved(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

const escaped = (t) => String(t).replace(/[<>&"]/g, (c) => ({ "<": "&lt;", ">": "&gt;", "&": "&amp;", '"': "&quot;" })[c]);
const HEAD = 40; // pixels above a figure for its heading and legend

/** Heading and legend of the figure that holds `box`. */
function headed(box) {
  const figure = box.closest("figure");
  const keys = figure ? [...figure.querySelectorAll(".legend > span")] : [];
  return {
    title: figure ? figure.querySelector("h2").textContent : "",
    keys: keys.map((k) => {
      const mark = k.querySelector(".key"), style = mark && getComputedStyle(mark);
      return { text: k.dataset.words || k.textContent, stroke: style && style.borderTopColor, dashed: Boolean(style) && style.borderTopStyle === "dashed" };
    }),
  };
}

function heading(box, x, y) {
  const { title, keys } = headed(box);
  if (!title) return "";
  let at = x;
  const marks = keys.map(({ text, stroke, dashed }) => {
    const line = stroke ? `<line x1="${at}" x2="${at + 18}" y1="${y + 14}" y2="${y + 14}" stroke="${stroke}" stroke-width="2.5"${dashed ? ' stroke-dasharray="5 3"' : ""}/>` : "";
    const made = `${line}<text x="${at + (stroke ? 24 : 0)}" y="${y + 18}" font-size="11">${escaped(text)}</text>`;
    at += (stroke ? 24 : 0) + 6.2 * text.length + 18;
    return made;
  });
  return `<text x="${x}" y="${y}" font-weight="600">${escaped(title)}</text>${marks.join("")}`;
}

const wrapped = (x, y, width, height, inner) => `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="${x} ${y} ${width} ${height}" font-family="system-ui, Arial, sans-serif" font-size="12" fill="${colour("ink")}">
<rect x="${x}" y="${y}" width="${width}" height="${height}" fill="${colour("paper")}"/>
${inner}</svg>\n`;

const inside = (plot, x) => x >= plot.scales.x.min && x <= plot.scales.x.max;
const held = (v) => v !== null && v !== undefined && !Number.isNaN(v);
const stroked = (plot, k) => (typeof plot.series[k].stroke === "function" ? plot.series[k].stroke(plot, k) : plot.series[k].stroke);

function path(plot, k) {
  const x = plot.data[0], s = plot.series[k];
  let d = "", pen = "M";
  for (let i = 0; i < x.length; i++) {
    const v = plot.data[k][i];
    if (!held(v) || !inside(plot, x[i])) { pen = "M"; continue; }
    const at = plot.valToPos(x[i], "x").toFixed(1);
    d += `${pen}${at} ${plot.valToPos(v, s.scale).toFixed(1)}`;
    if (s.paired && plot.data[k + 1][i] !== v) d += `V${plot.valToPos(plot.data[k + 1][i], s.scale).toFixed(1)}`;
    pen = "L";
  }
  return d;
}

function curve(plot, k) {
  const s = plot.series[k], stroke = stroked(plot, k);
  if (!s.show || !plot.data[k] || !stroke || plot.series[k - 1].paired) return ""; // the other half of a pair is drawn with it
  const points = s.points && typeof s.points.show === "boolean" && s.points.show;
  if (points) {
    return plot.data[0].map((x, i) => (held(plot.data[k][i]) && inside(plot, x) ? `<circle cx="${plot.valToPos(x, "x").toFixed(1)}" cy="${plot.valToPos(plot.data[k][i], s.scale).toFixed(1)}" r="3" fill="${stroke}"/>` : "")).join("");
  }
  return `<path d="${path(plot, k)}" fill="none" stroke="${stroke}" stroke-width="${typeof s.width === "number" ? s.width : 1}"${s.dash ? ` stroke-dasharray="${s.dash.join(" ")}"` : ""}/>`;
}

/** What lies between two series, run by run. */
function area(plot, { series: [upper, lower], fill }) {
  const x = plot.data[0], scale = plot.series[upper].scale;
  const at = (i, k) => `${plot.valToPos(x[i], "x").toFixed(1)} ${plot.valToPos(plot.data[k][i], scale).toFixed(1)}`;
  let d = "", run = [];
  const end = () => {
    if (run.length > 1) d += `M${run.map((i) => at(i, upper)).join("L")}L${run.reverse().map((i) => at(i, lower)).join("L")}Z`;
    run = [];
  };
  for (let i = 0; i < x.length; i++) held(plot.data[upper][i]) && held(plot.data[lower][i]) && inside(plot, x[i]) ? run.push(i) : end();
  end();
  return d ? `<path d="${d}" fill="${typeof fill === "function" ? fill(plot) : fill}"/>` : "";
}

function ticks(plot, k, box) {
  const a = plot.axes[k], made = [];
  if (!a.show) return "";
  const splits = a._splits || [], values = a._values || [];
  splits.forEach((v, i) => {
    if (v === null || !values[i]) return;
    const p = plot.valToPos(v, a.scale);
    if (k === 0) {
      if (p < -1 || p > box.w + 1) return;
      made.push(`<line x1="${p}" x2="${p}" y1="0" y2="${box.h}" stroke="${colour("grid")}"/><text x="${p}" y="${box.h + 16}" text-anchor="middle">${escaped(values[i])}</text>`);
    } else {
      if (p < -1 || p > box.h + 1) return;
      made.push(`<line x1="0" x2="${box.w}" y1="${p}" y2="${p}" stroke="${colour("grid")}"/><text x="-6" y="${p + 4}" text-anchor="end">${escaped(values[i])}</text>`);
    }
  });
  const label = escaped(typeof a.label === "function" ? a.label(plot, k) : a.label || "");
  made.push(k === 0
    ? `<text x="${box.w / 2}" y="${box.h + 34}" text-anchor="middle">${label}</text>`
    : `<text transform="translate(-54 ${box.h / 2}) rotate(-90)" text-anchor="middle">${label}</text>`);
  return made.join("");
}

/**
 * Curves as SVG text; `image` {href, x, y, width, height} lies below them (a spectrogram), `level` a line to either side of zero,
 * `under` and `over` are further drawings, as SVG text.
 */
export function curvesText(plot, { image, level, under = "", over = "" } = {}) {
  const box = { w: plot.over.clientWidth, h: plot.over.clientHeight };
  const series = plot.series.slice(1).map((s, k) => curve(plot, k + 1));
  const areas = (plot.bands || []).map((b) => area(plot, b));
  const picture = image ? `<g clip-path="url(#c)"><image href="${image.href}" x="${image.x}" y="${image.y}" width="${image.width}" height="${image.height}" preserveAspectRatio="none" image-rendering="pixelated"/></g>` : "";
  const levels = level ? [level, -level].map((v) => plot.valToPos(v, "y")).map((y) => `<line x1="0" x2="${box.w}" y1="${y}" y2="${y}" stroke="${colour("noise")}" stroke-dasharray="5 4"/>`).join("") : "";
  return wrapped(-74, -16 - HEAD, box.w + 94, box.h + 60 + HEAD, `${heading(plot.over, 0, -34)}
${ticks(plot, 0, box)}${ticks(plot, 1, box)}${picture}
<clipPath id="c"><rect width="${box.w}" height="${box.h}"/></clipPath><g clip-path="url(#c)">${under}${areas.join("\n")}${series.join("\n")}${levels}${over}</g>
<rect width="${box.w}" height="${box.h}" fill="none" stroke="${colour("line")}"/>`);
}

const STYLES = ["fill", "stroke", "stroke-width", "stroke-dasharray", "font-size", "font-weight", "font-family", "text-anchor", "opacity"];

/** A drawing of the page with the style that it has there. */
export function drawingText(svg) {
  const made = svg.cloneNode(true), from = [svg, ...svg.querySelectorAll("*")];
  [made, ...made.querySelectorAll("*")].forEach((x, k) => {
    const style = getComputedStyle(from[k]);
    for (const name of STYLES) x.setAttribute(name, style.getPropertyValue(name));
    x.removeAttribute("class");
  });
  const { width, height } = svg.viewBox.baseVal;
  const head = heading(svg, 0, -34), above = head ? HEAD : 0;
  return wrapped(-16, -16 - above, width + 32, height + 32 + above, head + made.innerHTML);
}

/** A table of cells as they are seen. */
export function tableText(table) {
  const origin = table.getBoundingClientRect(), made = [];
  for (const cell of table.querySelectorAll("th, td")) {
    const button = cell.querySelector("button"), r = (button || cell).getBoundingClientRect();
    const [x, y] = [r.left - origin.left, r.top - origin.top];
    if (button) made.push(`<rect x="${x}" y="${y}" width="${r.width}" height="${r.height}" fill="${getComputedStyle(button).backgroundColor}"/>`);
    const text = escaped(cell.textContent), ink = getComputedStyle(button || cell).color;
    if (!text) continue;
    if (cell.querySelector("span")) made.push(`<text transform="translate(${x + r.width / 2 + 4} ${y + r.height - 4}) rotate(-90)" fill="${ink}" font-size="11">${text}</text>`);
    else if (button) made.push(`<text x="${x + r.width / 2}" y="${y + r.height / 2 + 4}" text-anchor="middle" fill="${ink}" font-size="11">${text}</text>`);
    else made.push(`<text x="${x + r.width - 6}" y="${y + r.height / 2 + 4}" text-anchor="end" fill="${ink}" font-size="11">${text}</text>`);
  }
  return wrapped(-16, -16 - HEAD, origin.width + 32, origin.height + 32 + HEAD, heading(table, 0, -34) + made.join("\n"));
}

/** Hand an SVG text over as a file, or as a PNG of twice its size. */
export async function take(name, text, kind) {
  const blob = new Blob([text], { type: "image/svg+xml" });
  if (kind === "svg") return saved(`${name}.svg`, blob);
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [2 * image.width, 2 * image.height];
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
  canvas.toBlob((png) => saved(`${name}.png`, png), "image/png");
}

// The frame of a figure: heading, legend, what the pointer reads, and the figure as a file.

/** Two buttons that hand a figure over; `text` gives it as SVG text, `name` that of the file. */
export const saves = (title, name, text) =>
  h("span.saves", {}, ["svg", "png"].map((k) => h("button.save", { type: "button", onclick: () => take(name(), text(), k), "aria-label": `${title} as ${k.toUpperCase()}` }, k.toUpperCase())));

/**
 * @param text gives the figure as SVG text, once it is drawn; `name` that of the file
 */
export function frame({ id, title, name, text, body = h("div.plot"), kind = "figure.panel", more = [] }) {
  const note = h("p.plot-note", { hidden: true }), legend = h("div.legend");
  const element = h(kind, { class: id, "aria-label": title }, h("figcaption", {}, h("h2", {}, title), legend, ...more, h("span.readout", { "aria-hidden": "true" }), saves(title, name, text)), body, note);
  return {
    element, body, note, legend,
    /** rows of [name, colour, kind] */
    keys: (rows) => fill(legend, rows.filter(Boolean).map(([what, colour, dashed]) => h("span", {}, h(`i.key.${colour}`, { class: dashed || "" }), what))),
    say(words) {
      note.hidden = !words;
      note.textContent = words || "";
    },
  };
}

/** A file name of what a figure shows. */
export const fileName = (...parts) => parts.filter(Boolean).join("-").replace(/[^\p{L}\p{N}]+/gu, "-").slice(0, 80) || "figure";

// The error after every step as bars against the noise floor; what is ticked is the hatched one.

const MOST = 7;

/** steps: [{label, value, kind: "start" | "step" | "foreseen"}]; one more than was `seen` falls from the height of the one before it. */
export function stepBars(steps, noise, seen = []) {
  const shown = steps.slice(-MOST);
  const width = 96 * Math.max(shown.length + 0.7, 3), height = 150, base = 106;
  const top = Math.max(...shown.map((b) => b.value), noise * 1.1);
  const log = top > 12 * noise;
  const bottom = log ? noise / 2 : 0;
  const at = (v) => {
    const share = log ? Math.log(Math.max(v, bottom) / bottom) / Math.log((top * 1.1) / bottom) : v / (top * 1.05);
    return base - Math.max(0, share) * (base - 18);
  };
  const made = s("svg", { viewBox: `0 0 ${width} ${height}`, class: "steps", role: "img", "aria-label": described(shown, noise) });
  made.append(
    s("defs", {}, s("pattern", { id: "hatch", width: 6, height: 6, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" }, s("rect", { class: "hatch-ground", width: 6, height: 6 }), s("line", { class: "hatch-line", x1: 0, y1: 0, x2: 0, y2: 6 }))),
    s("line", { class: "rule", x1: 0, x2: width, y1: base, y2: base }),
  );
  shown.forEach((b, k) => {
    const x = 96 * k + 18;
    const y = at(b.value);
    const falls = b.kind === "step" && k === shown.length - 1 && k > 0 && seen.length === steps.length - 1;
    const bar = s("rect", { class: `step-bar ${b.kind}`, x, y, width: 60, height: Math.max(0, base - y) });
    if (falls) fall(bar, at(shown[k - 1].value), y, base);
    made.append(
      bar,
      s("text", { class: "value", x: x + 30, y: y - 5, "text-anchor": "middle" }, number(b.value)),
      ...broken(b.label).map((line, i) => s("text", { class: "label", x: x + 30, y: base + 15 + 13 * i, "text-anchor": "middle" }, line)),
    );
  });
  const y = at(noise);
  made.append(s("line", { class: "floor", x1: 0, x2: width, y1: y, y2: y }), s("text", { class: "floor-label", x: width - 2, y: y - 4, "text-anchor": "end" }, `noise ${number(noise)}`));
  return h("div.steps-box", {}, made);
}

function fall(bar, from, to, base) {
  const place = (y) => {
    bar.setAttribute("y", y);
    bar.setAttribute("height", Math.max(0, base - y));
  };
  place(from);
  requestAnimationFrame(() => requestAnimationFrame(() => place(to)));
}

function broken(text) {
  const words = text.replaceAll("-", "-\u200b").split(/(?<=[ \u200b])/);
  const lines = [""];
  for (const w of words) {
    if ((lines.at(-1) + w).replaceAll("\u200b", "").length > 15 && lines.at(-1)) lines.push(w);
    else lines[lines.length - 1] += w;
  }
  return lines.slice(0, 3);
}

const described = (steps, noise) => `Error after every step: ${steps.map((b) => `${b.label} ${number(b.value)} Eo`).join(", ")}; noise ${number(noise)} Eo`;

// Harmonic x motion term as a table: every cell is a button, its number is there for those who do not see colours.

/** Shade of a significance: nothing below the level, then by its logarithm. */
function shade(z, level, top) {
  const size = Math.abs(z);
  if (!(size > level)) return 0;
  return 0.18 + 0.82 * Math.min(1, Math.log(size / level) / Math.log(Math.max(top / level, 4)));
}

const parsed = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));
const light = (rgb) => rgb.map((v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4)).reduce((sum, v, k) => sum + v * [0.2126, 0.7152, 0.0722][k], 0);

/** Ground and ink of a shade: black or white, whichever has more contrast (at least 4.5 to 1). */
function painted(amount) {
  const [low, high] = [parsed(colour("grid")), parsed(colour("residual"))];
  const ground = low.map((v, k) => Math.round(v + amount * (high[k] - v)));
  return { background: `rgb(${ground.join(" ")})`, color: light(ground) > 0.179 ? "#000000" : "#ffffff" };
}

export function heatTable(box, found, { chosen, choose, marked }) {
  const top = Math.max(...found.z.flat().map((z) => Math.abs(z || 0)));
  const head = h("tr", {}, h("td"), found.products.map((p) => h("th", { scope: "col" }, h("span", {}, p.words))));
  const rows = found.harmonics.map((row, i) =>
    h(
      "tr",
      { class: marked(row.id) ? "marked" : "" },
      h("th", { scope: "row" }, row.words),
      found.products.map((p, j) => {
        const z = found.z[i][j], id = `${row.id}|${p.id}`;
        if (z === null) return h("td.none", { title: `${row.words} × ${p.words}: part of the model` });
        const amount = shade(z, found.level, top);
        const text = Math.abs(z) >= found.level ? (Math.abs(z) >= 10 ? Math.round(Math.abs(z)) : Math.abs(z).toFixed(1)) : "";
        const button = h("button", {
          type: "button", tabindex: "-1", "aria-pressed": String(chosen === id), "aria-label": `${row.words} times ${p.words}: ${z.toFixed(1)} sigma`,
          title: `${row.words} × ${p.words}: ${z.toFixed(1)} sigma`, onclick: () => choose(chosen === id ? "" : id), "data-cell": `${i} ${j}`,
        }, text);
        Object.assign(button.style, painted(amount));
        if (amount > 0.55) button.classList.add("deep");
        return h("td", {}, button);
      }),
    ),
  );
  const table = h("table.heat", { "aria-label": "Significance by harmonic of the spin and motion term" }, h("thead", {}, head), h("tbody", {}, rows));
  fill(box, table);
  roving(table);
}

/** One stop for the Tab key; the arrows move between the cells. */
function roving(table) {
  const cells = [...table.querySelectorAll("button")];
  if (!cells.length) return;
  cells[0].tabIndex = 0;
  table.addEventListener("keydown", (e) => {
    const step = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] }[e.key];
    if (!step || !e.target.dataset.cell) return;
    e.preventDefault();
    e.stopPropagation();
    const [i, j] = e.target.dataset.cell.split(" ").map(Number);
    for (let n = 1; n < 40; n++) {
      const next = table.querySelector(`[data-cell="${i + n * step[0]} ${j + n * step[1]}"]`);
      if (!next) continue;
      e.target.tabIndex = -1;
      next.tabIndex = 0;
      next.focus();
      return;
    }
  });
}
