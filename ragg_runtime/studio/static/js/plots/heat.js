// Harmonic x motion term as a table: every cell is a button, its number is there for those who do not see colours.
import { fill, h } from "../dom.js";
import { colour } from "./axes.js";

/** Shade of a significance: nothing below the level, then by its logarithm. */
function shade(z, level, top) {
  const size = Math.abs(z);
  if (!(size > level)) return 0;
  return 0.18 + 0.82 * Math.min(1, Math.log(size / level) / Math.log(Math.max(top / level, 4)));
}

const parsed = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));
const light = (rgb) => rgb.map((v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4)).reduce((sum, v, k) => sum + v * [0.2126, 0.7152, 0.0722][k], 0);

/** Ground and ink of a shade: black or white, whichever stands out more (at least 4.5 to 1). */
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
