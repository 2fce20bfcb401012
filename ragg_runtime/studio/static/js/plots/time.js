// Series over time: envelopes where samples are many, the noise's one sigma, and what is laid over them.
import { axis, colour, LEFT, mounted, plain, RIGHT, span, wheel } from "./axes.js";

const SYNC = "time";

/** Values of `other` on the grid of `base`; null outside and where nothing is valid. */
function aligned(base, other, which) {
  const n = base.x.length, found = new Array(n), values = other[which];
  for (let i = 0; i < n; i++) {
    const k = Math.round((base.x[i] - other.start) / other.step);
    const v = k >= 0 && k < values.length ? values[k] : NaN;
    found[i] = Number.isNaN(v) ? null : v;
  }
  return found;
}

/**
 * From least to greatest value and on to the next stretch, in one stroke: a tenth of the time that two outlines and what lies between
 * them take to paint. Series k holds the least values, series k + 1 the greatest.
 */
function zigzag(u, k, first, last) {
  const [x, low, high] = [u.data[0], u.data[k], u.data[k + 1]], { left, top, width, height } = u.bbox;
  const { min: x0, max: x1 } = u.scales.x, { min: y0, max: y1 } = u.scales.y;
  const across = width / (x1 - x0), up = height / (y1 - y0), stroke = new Path2D();
  u.ctx.lineJoin = "bevel"; // round ones cost more than the lines
  let pen = false;
  for (let i = first; i <= last; i++) {
    if (low[i] === null || low[i] === undefined) {
      pen = false;
      continue;
    }
    const at = left + (x[i] - x0) * across;
    if (pen) stroke.lineTo(at, top + (y1 - low[i]) * up);
    else stroke.moveTo(at, top + (y1 - low[i]) * up);
    if (high[i] !== low[i]) stroke.lineTo(at, top + (y1 - high[i]) * up);
    pen = true;
  }
  return { stroke, fill: null, clip: null, band: null, gaps: null, flags: 0 };
}

/**
 * @param lines [{name, colour, dash, alpha, band}] in the order in which they are drawn; a band is filled between its edges
 * @param moved is given the limits that the user wants
 */
export function timePlot(box, { label, lines, moved, level, limits, unit }) {
  const series = [{}];
  const bands = [];
  for (const line of lines) {
    const stroke = () => colour(line.colour) + (line.dimmed && line.dimmed() ? "70" : line.alpha || "");
    // one pixel: wider strokes take ten times as long where no graphics card paints
    const common = { stroke, width: line.band ? 0 : 1, dash: line.dash, points: { show: false }, spanGaps: false };
    const drawn = line.band ? [{}, {}] : [{ paths: zigzag, paired: true }, { paths: () => null }];
    series.push({ ...common, label: line.name, ...drawn[0] }, { ...common, label: `${line.name} `, ...drawn[1] });
    if (line.band) bands.push({ series: [series.length - 1, series.length - 2], fill: stroke });
  }
  const made = mounted(
    box,
    {
      scales: {
        x: { time: false, range: () => limits() },
        y: { range: (u, low, high) => reach(low, high, level ? level() : 0) },
      },
      series, bands,
      axes: [axis(label), axis("", { side: 3, label: undefined, labelSize: 0, size: LEFT })],
      padding: [null, RIGHT, null, null],
      cursor: { sync: { key: SYNC }, drag: { x: true, y: false, setScale: false }, points: { show: false }, y: false },
      hooks: {
        draw: [(u) => noise(u, level)],
        setSelect: [
          (u) => {
            if (u.select.width < 4) return;
            const [a, b] = [u.posToVal(u.select.left, "x"), u.posToVal(u.select.left + u.select.width, "x")];
            u.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
            moved(a, b);
          },
        ],
      },
    },
    [[0, 1], ...series.slice(1).map(() => [null, null])],
    (u, k) => [
      `${plain(u.data[0][k])} s`,
      ...lines.map((line, i) => {
        const [low, high] = [u.data[1 + 2 * i][k], u.data[2 + 2 * i][k]];
        return low === null || low === undefined ? "" : `${lines.length > 1 ? `${line.name} ` : ""}${span(low, high)} ${unit ? unit() : ""}`;
      }),
    ].filter(Boolean).join(" · "),
  );
  wheel(made.plot, moved);
  made.plot.over.addEventListener("dblclick", () => moved(null, null));
  return {
    ...made,
    /** found: series of the server in the order of `lines`, or null. */
    show(found) {
      const usable = found.filter(Boolean);
      if (!usable.length) return made.plot.setData([[0, 1], ...series.slice(1).map(() => [null, null])]);
      const rows = lines.map((line, k) => ({ ...line, found: found[k] }));
      const ordered = [{ found: usable[0] }];
      const base = ordered[0].found;
      const values = [base.x];
      for (const { found: f } of rows) {
        values.push(f ? aligned(base, f, "low") : new Array(base.x.length).fill(null));
        values.push(f ? aligned(base, f, "high") : new Array(base.x.length).fill(null));
      }
      made.plot.setData(values);
    },
    zoomed() {
      made.plot.setScale("x", { min: limits()[0], max: limits()[1] });
    },
  };
}

function reach(low, high, level) {
  if (low === null || low === undefined) return [-1, 1];
  const top = Math.max(Math.abs(low), Math.abs(high), level || 0) * 1.08 || 1;
  return low >= 0 || high <= 0 ? [low - 0.06 * (high - low || top), high + 0.06 * (high - low || top)] : [-top, top];
}

function noise(u, level) {
  const v = level ? level() : 0;
  if (!v) return;
  const { ctx, bbox } = u;
  ctx.save();
  ctx.strokeStyle = colour("noise");
  ctx.lineWidth = devicePixelRatio * 1.2;
  ctx.setLineDash([5 * devicePixelRatio, 4 * devicePixelRatio]);
  for (const y of [v, -v]) {
    const at = u.valToPos(y, "y", true);
    if (at < bbox.top || at > bbox.top + bbox.height) continue;
    ctx.beginPath();
    ctx.moveTo(bbox.left, at);
    ctx.lineTo(bbox.left + bbox.width, at);
    ctx.stroke();
  }
  ctx.restore();
}
