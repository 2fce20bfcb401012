// Values of many flights side by side: a dot each, its standard deviation as a bar, levels as dashed steps.
import uPlot from "../../vendor/uPlot.esm.js";
import { number } from "../dom.js";
import { axis, colour, LOG, mounted, rem } from "./axes.js";

/**
 * @param rows [{name, colour, values, stds, step}] over the flights; null where there is no value
 * @param picked is given the number of the flight that was clicked
 */
export function dotPlot(box, { label, rows, log, picked }) {
  const flights = Array.from({ length: rows[0].values.length }, (_, k) => k);
  const size = Math.max(3, Math.min(7, 900 / flights.length));
  const every = rows.flatMap((r) => r.values).filter((v) => v !== null);
  const wide = log && Math.min(...every) > 0 && Math.max(...every) > 6 * Math.min(...every);
  const made = mounted(
    box,
    {
      scales: { x: { time: false, range: () => [-0.7, flights.length - 0.3] }, y: wide ? { distr: 3 } : { range: (u, a, b) => reach(rows, a, b) } },
      series: [{}, ...rows.map((r) => (r.step
        ? { label: r.name, stroke: () => colour(r.colour), width: 1.2, dash: [6, 4], points: { show: false }, paths: uPlot.paths.stepped({ align: 1 }) }
        : { label: r.name, stroke: () => colour(r.colour), fill: () => colour(r.colour), paths: () => null, points: { show: true, size, width: 0, fill: () => colour(r.colour) } }))],
      axes: [
        axis("flight, by number in the table", { incrs: [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000] }),
        axis(label, { side: 3, size: () => 3.4 * rem(), labelSize: 1.4 * rem(), ...(wide ? LOG : {}) }),
      ],
      cursor: { drag: { x: false, y: false }, points: { show: false }, y: false },
      hooks: { draw: [(u) => rows.forEach((r) => r.stds && bars(u, r))] },
    },
    [flights, ...rows.map((r) => r.values)],
    (u, k) => [`flight ${k}`, ...rows.map((r) => (r.values[k] === null ? "" : `${r.name} ${number(r.values[k], 4)}${r.stds && r.stds[k] !== null ? ` ± ${number(r.stds[k], 2)}` : ""}`))].filter(Boolean).join(" · "),
  );
  made.plot.over.addEventListener("click", () => {
    const k = made.plot.cursor.idx;
    if (k !== null && k !== undefined) picked(k);
  });
  return made;
}

/** From the lowest to the highest end of a bar, with a margin. */
function reach(rows, a, b) {
  const ends = rows.flatMap((r) => r.values.flatMap((v, k) => (v === null ? [] : [v - ((r.stds && r.stds[k]) || 0), v + ((r.stds && r.stds[k]) || 0)])));
  if (!ends.length) return [a ?? 0, b ?? 1];
  const [low, high] = [Math.min(...ends), Math.max(...ends)], margin = 0.08 * (high - low || Math.abs(high) || 1);
  return [low - margin, high + margin];
}

function bars(u, { colour: name, values, stds }) {
  const { ctx, bbox } = u;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.strokeStyle = colour(name);
  ctx.lineWidth = devicePixelRatio;
  ctx.beginPath();
  values.forEach((v, k) => {
    if (v === null || stds[k] === null) return;
    const x = u.valToPos(k, "x", true);
    ctx.moveTo(x, u.valToPos(v - stds[k], "y", true));
    ctx.lineTo(x, u.valToPos(v + stds[k], "y", true));
  });
  ctx.stroke();
  ctx.restore();
}
