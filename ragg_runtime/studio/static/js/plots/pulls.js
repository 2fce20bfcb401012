// How far values were pulled from the test sheet, as bars to either side of it.
import { number, s } from "../dom.js";

const HIGH = 22, NAMES = 110, WIDE = 560, NUMBERS = 56;
const MIDDLE = (NAMES + WIDE - NUMBERS) / 2, HALF = (WIDE - NUMBERS - NAMES) / 2;
const FEWEST = 3; // the scale reaches to this many plausible errors at least, lest small pulls look large

/** A symbol of pieces [text, lowered] within a text of a drawing. */
const written = (pieces) => {
  let down = 0; // how far the pen is below the line
  return pieces.map(([text, low]) => {
    const dy = (low ? 3 : 0) - down;
    down += dy;
    return s("tspan", { "font-style": "italic", "font-size": low ? 9 : 13, dy: dy || null }, text);
  });
};

const signed = (x) => `${x < 0 ? "−" : "+"}${number(Math.abs(x), 2)}`;

/** rows: [{name, pieces, symbol, sigma}], the farthest first. */
export function pullBars(rows) {
  const most = Math.max(FEWEST, ...rows.map((r) => Math.abs(r.sigma))), height = HIGH * rows.length + 36;
  const at = (sigma) => MIDDLE + (HALF * sigma) / most;
  const said = rows.map((r) => `${r.name} ${r.symbol} ${signed(r.sigma)}`).join(", ");
  const made = s("svg", { viewBox: `0 0 ${WIDE} ${height}`, class: "pulls", role: "img", "aria-label": `Pull of the test sheet in plausible errors: ${said}` });
  for (let k = -Math.floor(most); k <= most; k++) {
    made.append(s("line", { class: k ? "grid" : "middle", x1: at(k), x2: at(k), y1: 0, y2: height - 34 }));
    if (k % Math.max(1, Math.round(most / 5)) === 0) made.append(s("text", { class: "tick", x: at(k), y: height - 21, "text-anchor": "middle" }, String(k).replace("-", "−")));
  }
  made.append(s("text", { class: "tick", x: MIDDLE, y: height - 5, "text-anchor": "middle" }, "calibrated value less the sheet’s, plausible errors"));
  rows.forEach((r, k) => {
    const y = HIGH * k, [a, b] = [0, r.sigma].sort((p, q) => p - q).map(at);
    made.append(
      s("text", { x: NAMES - 12, y: y + 15, "text-anchor": "end" }, s("tspan", { class: "name" }, r.name ? `${r.name} ` : ""), ...written(r.pieces)),
      s("rect", { class: r.sigma < 0 ? "bar left" : "bar", x: a, y: y + 4, width: Math.max(1, b - a), height: HIGH - 8 }),
      s("text", { class: "number", x: WIDE - 4, y: y + 15, "text-anchor": "end" }, signed(r.sigma)),
    );
  });
  return made;
}
