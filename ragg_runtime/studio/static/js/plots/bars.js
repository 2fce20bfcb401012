// The error after every step as bars against the noise floor; what is ticked stands beside them as a hatched one.
import { h, number, s } from "../dom.js";

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
      ...wrapped(b.label).map((line, i) => s("text", { class: "label", x: x + 30, y: base + 15 + 13 * i, "text-anchor": "middle" }, line)),
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

function wrapped(text) {
  const words = text.replaceAll("-", "-\u200b").split(/(?<=[ \u200b])/);
  const lines = [""];
  for (const w of words) {
    if ((lines.at(-1) + w).replaceAll("\u200b", "").length > 15 && lines.at(-1)) lines.push(w);
    else lines[lines.length - 1] += w;
  }
  return lines.slice(0, 3);
}

const described = (steps, noise) => `Error after every step: ${steps.map((b) => `${b.label} ${number(b.value)} Eo`).join(", ")}; noise ${number(noise)} Eo`;
