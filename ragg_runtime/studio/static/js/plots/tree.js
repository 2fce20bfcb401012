// The history as a tree: a circle for every state, lines to what was made of it, the present one filled.
import { number, s } from "../dom.js";

const WIDE = 118, HIGH = 62, LEFT = 40, TOP = 22;

/** states: [{n, from, lane, label, after, present}]; `now` is the number of the present one. */
export function branchTree(states, now) {
  const place = new Map(states.map((x, k) => [x.n, [LEFT + WIDE * k, TOP + HIGH * x.lane]]));
  const lanes = Math.max(...states.map((x) => x.lane)) + 1;
  const width = LEFT + WIDE * (states.length - 1) + WIDE, height = TOP + HIGH * lanes;
  const said = states.map((x) => `${x.n + 1}: ${x.label}${x.n === now ? " (present)" : x.present ? "" : " (left)"}`).join(", ");
  const made = s("svg", { viewBox: `0 0 ${width} ${height}`, width, height, class: "tree", role: "img", "aria-label": `States of the model: ${said}` });
  for (const x of states) {
    if (x.from === null || !place.has(x.from)) continue;
    const [[x0, y0], [x1, y1]] = [place.get(x.from), place.get(x.n)];
    made.append(s("path", { class: x.present ? "" : "left", d: y0 === y1 ? `M${x0} ${y0}H${x1}` : `M${x0} ${y0}C${x0 + 40} ${y0} ${x0 + 20} ${y1} ${x0 + 62} ${y1}H${x1}` }));
  }
  for (const x of states) {
    const [cx, cy] = place.get(x.n);
    made.append(
      s("circle", { class: x.n === now ? "now" : x.present ? "" : "left", cx, cy, r: 7 }),
      s("text", { class: "n", x: cx, y: cy - 11, "text-anchor": "middle" }, String(x.n + 1)),
      s("text", { x: cx, y: cy + 21, "text-anchor": "middle" }, x.label.length > 19 ? `${x.label.slice(0, 18)}…` : x.label),
      s("text", { class: "value", x: cx, y: cy + 34, "text-anchor": "middle" }, x.after === null ? "" : `${number(x.after)} Eo`),
    );
  }
  return made;
}
