// Drawings of the page itself: the frame of a figure, the bars of the steps, the map of terms.
import { colour } from "./curves.js";
import { fill, h, number, s } from "./dom.js";

/** The frame of a figure: heading, legend, what the pointer reads. */
export function frame({ id, title, body = h("div.plot"), kind = "figure.panel", more = [] }) {
  const note = h("p.plot-note", { hidden: true }), legend = h("div.legend");
  const element = h(kind, { class: id, "aria-label": title }, h("figcaption", {}, h("h2", {}, title), legend, ...more, h("span.readout", { "aria-hidden": "true" })), body, note);
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
