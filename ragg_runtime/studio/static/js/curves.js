// What all curves share: colours from the style sheet, axes, sizes, zoom and pan.
import uPlot from "../vendor/uPlot.esm.js";
import { h, number, superscript } from "./dom.js";

/** A colour of the style sheet. */
export const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

export const rem = () => parseFloat(getComputedStyle(document.documentElement).fontSize);
const FAMILY = 'system-ui, "Helvetica Neue", Arial, sans-serif';
const letters = () => Math.round(rem() * 0.75); // height of labels, CSS pixels
const fonts = () => `${letters()}px ${FAMILY}`;

/** Widths that plots in one column share, so that their axes of time lie below each other. */
export const LEFT = () => 4.6 * rem(), RIGHT = () => 0.9 * rem();

const grouped = (text) => text.replace(/^\d{5,}/, (whole) => whole.replace(/\B(?=(\d{3})+$)/g, "\u202f"));
const tick = (v) => (v < 0 ? "−" : "") + grouped(String(Number(Math.abs(v).toPrecision(6))));
/** Labels of one axis are all written in one way: powers of ten where plain digits would be many. */
const ticks = (found) => {
  const largest = Math.max(...found.filter((v) => v !== null).map(Math.abs));
  const powers = largest >= 1e7 || (largest > 0 && largest < 1e-3);
  return found.map((v) => (v === null ? "" : v === 0 ? "0" : powers ? number(v, 2).replaceAll("\u202f", "") : tick(v)));
};

export function axis(label, more = {}) {
  return {
    label, labelSize: label ? rem() * 1.15 : 0, labelGap: 0, ...(more.side === undefined ? {} : { space: 1.5 * rem() }), size: () => (more.side === undefined ? rem() * 1.9 : rem() * 3.5), gap: 4,
    font: fonts(), labelFont: fonts(),
    stroke: () => colour("ink"), grid: { stroke: () => colour("grid"), width: 1 }, ticks: { stroke: () => colour("line"), width: 1, size: 4 },
    values: (u, found) => ticks(found),
    ...more,
  };
}

/** Labels of a logarithmic axis: 1, 2, 5 where little is spanned, powers of ten where much. */
const logValues = (u, found) => {
  const shown = found.filter((v) => v !== null);
  const decades = Math.log10(shown.at(-1) / shown[0]) || 0;
  return found.map((v) => {
    if (v === null) return "";
    const m = v / 10 ** Math.floor(Math.log10(v) + 1e-9);
    const keep = decades > 3.2 ? m < 1.01 : m < 1.01 || Math.abs(m - 2) < 0.01 || Math.abs(m - 5) < 0.01;
    if (!keep) return "";
    return v >= 1e-3 && v < 1e5 ? String(Number(v.toPrecision(3))) : `${m > 1.01 ? `${Math.round(m)}·` : ""}10${superscript(Math.floor(Math.log10(v) + 1e-9))}`;
  });
};

const labelled = (u, splits) => {
  const shown = logValues(u, splits);
  return splits.map((v, k) => (shown[k] ? v : null));
};
/** Of a logarithmic axis: lines and ticks stand at its labels alone. */
// uPlot's own division of a logarithmic axis has no end where a limit is not a number that it can add to.
function decades(u, axis, low, high) {
  const found = [];
  if (!(low > 0 && Number.isFinite(high))) return found;
  for (let e = Math.floor(Math.log10(low)); e <= Math.log10(high); e++)
    for (let m = 1; m < 10; m++) if (m * 10 ** e >= low * (1 - 1e-9) && m * 10 ** e <= high * (1 + 1e-9)) found.push(m * 10 ** e);
  return found;
}

export const LOG = {
  splits: decades,
  values: logValues,
  filter: (u, splits) => splits, // logValues says which have room
  grid: { stroke: () => colour("grid"), width: 1, filter: labelled },
  ticks: { stroke: () => colour("line"), width: 1, size: 4, filter: labelled },
};

/**
 * A plot that fills its box and is drawn anew when that or the colours change.
 * `label(u, k)` gives the text for sample k below the pointer; it is shown in the figure's heading.
 */
export function mounted(box, options, data, label) {
  const size = () => ({ width: Math.max(200, box.clientWidth), height: Math.max(60, box.clientHeight) });
  const plot = new uPlot({ ...size(), ...options, legend: { show: false } }, data, box);
  let written = rem();
  // letters are as high as the page's, which change with the window, the zoom and the screen it is on
  const rewritten = () => {
    if (rem() === written) return;
    const factor = rem() / written;
    written = rem();
    for (const a of plot.axes) {
      if (!a.show) continue;
      a.labelSize *= factor;
      a.font = a.labelFont = [`${letters() * devicePixelRatio}px ${FAMILY}`, letters() * devicePixelRatio, letters()];
    }
  };
  const watcher = new ResizeObserver(() => (rewritten(), plot.setSize(size())));
  watcher.observe(box);
  if (label) reading(plot, box, label);
  const themed = () => plot.redraw(false);
  document.addEventListener("themed", themed);
  return {
    plot,
    gone() {
      watcher.disconnect();
      document.removeEventListener("themed", themed);
      plot.destroy();
    },
  };
}

function reading(plot, box, label) {
  const place = () => box.closest("figure") && box.closest("figure").querySelector(".readout");
  const say = () => {
    const at = place(), { left, idx } = plot.cursor;
    const text = left >= 0 && idx !== null && idx !== undefined ? label(plot, idx) : "";
    if (at && at.textContent !== text) at.textContent = text;
  };
  // linked plots move their cursors together, and each shows its values
  (plot.hooks.setCursor ||= []).push(say);
}

/** A number as it is read off an axis. */
export const plain = (v) => String(Number(v.toPrecision(6))).replace("-", "−");

/** Least and greatest value of a series in words; once, where they are one sample. */
export const span = (low, high) => (low === high || number(low, 4) === number(high, 4) ? number(low, 4) : `${number(low, 4)} … ${number(high, 4)}`);

/** Wheel zooms about the pointer, Shift or a horizontal wheel pans; `moved` is given the new limits. */
export function wheel(plot, moved) {
  plot.over.addEventListener(
    "wheel",
    (e) => {
      e.preventDefault();
      const { min, max } = plot.scales.x;
      if (min === null) return;
      const width = max - min;
      if (e.shiftKey || Math.abs(e.deltaX) > Math.abs(e.deltaY)) {
        const by = (Math.sign(e.deltaX || e.deltaY) * width) / 12;
        moved(min + by, max + by);
        return;
      }
      const at = plot.posToVal(e.offsetX, "x");
      const factor = 1.2 ** Math.sign(e.deltaY);
      moved(at - (at - min) * factor, at + (max - at) * factor);
    },
    { passive: false },
  );
}

// Series over time: envelopes where samples are many, the noise's one sigma, and what is laid over them.

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
  const series = [{}], bands = [];
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
  if (!Number.isFinite(low) || !Number.isFinite(high)) return [-1, 1];
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

// Amplitude densities on logarithmic axes, the multiples of the spin marked; a band can be brushed.

const LINES = [
  { id: "before", name: "before the last step", short: "before", colour: "before", width: 1.6 },
  { id: "residual", name: "residual", colour: "residual", width: 1.4 },
  { id: "left", name: "with what is ticked", short: "ticked", colour: "effect", width: 1.4 },
  { id: "noise", name: "noise, as estimated", short: "noise", colour: "noise", width: 1.3, dash: [6, 4] },
];

export const spectrumLines = LINES;

export function spectrumPlot(box, { band, banded, harmonic }) {
  let spin = 0;
  const made = mounted(
    box,
    {
      scales: { x: { time: false, distr: 3, range: (u, a, b) => (a > 0 && b > a ? [a, b] : [0.1, 1]) }, y: { distr: 3, range: (u, a, b) => spread(a, b) } },
      series: [{}, ...LINES.map((l) => ({ label: l.name, stroke: () => colour(l.colour), width: l.width, dash: l.dash, points: { show: false } }))],
      axes: [
        axis("frequency before demodulation, Hz", LOG),
        axis("residual, Eo/√Hz", { side: 3, size: () => 3 * rem(), labelSize: 1.4 * rem(), ...LOG }),
      ],
      cursor: { drag: { x: true, y: false, setScale: false }, points: { show: false }, y: false },
      hooks: {
        drawAxes: [(u) => marks(u, spin, band(), harmonic())],
        setSelect: [
          (u) => {
            if (u.select.width < 4) return;
            const found = [u.posToVal(u.select.left, "x"), u.posToVal(u.select.left + u.select.width, "x")];
            u.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
            banded(...found);
          },
        ],
      },
    },
    [[0.1, 1], ...LINES.map(() => [null, null])],
    (u, k) => [
      `${plain(Number(u.data[0][k].toPrecision(4)))} Hz${spin ? ` = ${number(u.data[0][k] / spin, 3)} Ω` : ""}`,
      ...LINES.map((l, i) => (u.data[1 + i][k] === null || u.data[1 + i][k] === undefined ? "" : `${l.short || l.name} ${number(u.data[1 + i][k])}`)),
    ].filter(Boolean).join(" · "),
  );
  made.plot.over.addEventListener("dblclick", () => banded(null, null));
  return {
    ...made,
    show(found) {
      spin = found.spin_Hz;
      const empty = new Array(found.frequency.length).fill(null);
      made.plot.setData([found.frequency, ...LINES.map((l) => (l.id === "noise" ? found.noise : found.lines[l.id]) || empty)]);
    },
    marked: () => made.plot.redraw(false),
  };
}

const DEEPEST = 1e5; // below the top: what a low-pass leaves beyond its band is digits, not signal

function spread(a, b) {
  if (!(a > 0 && Number.isFinite(b))) return [0.1, 10];
  const [low, high] = [Math.max(a, b / DEEPEST) / 1.5, b * 1.5];
  const widen = Math.sqrt(Math.max(1, 10 / (high / low)));
  return [low / widen, high * widen];
}

function marks(u, spin, [low, high], harmonic) {
  const { ctx, bbox } = u;
  const px = devicePixelRatio;
  ctx.save();
  if (low !== null && high !== null) {
    const [x0, x1] = [low, high].map((f) => Math.min(Math.max(u.valToPos(f, "x", true), bbox.left), bbox.left + bbox.width));
    ctx.fillStyle = colour("brush");
    ctx.fillRect(x0, bbox.top, x1 - x0, bbox.height);
  }
  const size = parseFloat(getComputedStyle(document.documentElement).fontSize);
  ctx.font = `${Math.round(size * 0.7 * px)}px system-ui, sans-serif`;
  ctx.textBaseline = "top";
  for (let k = 1; k <= 4 && spin; k++) {
    const x = u.valToPos(k * spin, "x", true);
    if (x < bbox.left || x > bbox.left + bbox.width) continue;
    ctx.strokeStyle = colour(harmonic === k ? "effect" : "quiet");
    ctx.lineWidth = (harmonic === k ? 2 : 1) * px;
    ctx.setLineDash(harmonic === k ? [] : [px, 3 * px]);
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.fillStyle = colour("quiet");
    ctx.fillText(k === 1 ? "Ω" : k, x + 3 * px, bbox.top + 2 * px);
  }
  ctx.restore();
}

// The whole flight as a strip, and the window on it: drag to choose one, drag its middle to move it.

export function overview(box, { whole, limits, moved, marks }) {
  const made = mounted(
    box,
    {
      scales: { x: { time: false, range: () => whole() }, y: { range: (u, a, b) => (a === null ? [-1, 1] : [a, b]) } },
      series: [{}, { stroke: () => colour("before"), width: 1, points: { show: false } }, { stroke: () => colour("before"), width: 1, points: { show: false } }],
      bands: [{ series: [2, 1], fill: () => colour("before") }],
      axes: [axis(undefined, { labelSize: 0, label: undefined }), { show: false }],
      padding: [() => 2, RIGHT, () => 0, LEFT],
      cursor: { show: false },
      hooks: { drawAxes: [(u) => marked(u, marks())], draw: [() => shade()] },
    },
    [[0, 1], [null, null], [null, null]],
  );
  const { plot } = made;
  // the window is drawn by two veils and a frame: moving it must not draw the series again
  const [before, after, frame] = ["veil", "veil", "frame"].map((name) => h(`i.${name}`));
  plot.over.append(before, after, frame);
  function shade() {
    const width = plot.over.clientWidth, [x0, x1] = limits().map((t) => Math.min(Math.max(plot.valToPos(t, "x"), 0), width));
    before.style.width = `${x0}px`;
    after.style.left = `${x1}px`;
    after.style.width = `${width - x1}px`;
    frame.style.left = `${x0}px`;
    frame.style.width = `${Math.max(2, x1 - x0)}px`;
  }
  let grip = null;
  const at = (e) => plot.posToVal(Math.min(Math.max(e.clientX - plot.over.getBoundingClientRect().left, 0), plot.over.clientWidth), "x");
  plot.over.addEventListener("pointerdown", (e) => {
    const t = at(e), [a, b] = limits(), [first, last] = whole();
    const all = b - a >= (last - first) * 0.999;
    const edge = ((last - first) * 8) / plot.over.clientWidth;
    grip = !all && t > a + edge && t < b - edge ? { kind: "move", from: t, a, b }
      : !all && Math.abs(t - a) <= edge ? { kind: "size", from: b }
      : !all && Math.abs(t - b) <= edge ? { kind: "size", from: a }
      : { kind: "size", from: t };
    plot.over.setPointerCapture(e.pointerId);
  });
  plot.over.addEventListener("pointermove", (e) => {
    if (!grip) return;
    const t = at(e);
    if (grip.kind === "move") moved(grip.a + t - grip.from, grip.b + t - grip.from);
    else if (Math.abs(t - grip.from) > 0) moved(Math.min(t, grip.from), Math.max(t, grip.from));
  });
  plot.over.addEventListener("pointerup", () => (grip = null));
  plot.over.addEventListener("dblclick", () => moved(null, null));
  return {
    ...made,
    shade,
    show(found) {
      const clean = (v) => Array.from(v, (x) => (Number.isNaN(x) ? null : x));
      plot.setData([found.x, clean(found.low), clean(found.high)]);
    },
  };
}

/** Gaps as pale columns, lone missing samples as ticks along the top, what is left out by hand crossed out. */
function marked(u, { gaps, alone, cuts }) {
  const { ctx, bbox } = u;
  const px = devicePixelRatio;
  const place = (t) => Math.min(Math.max(u.valToPos(t, "x", true), bbox.left), bbox.left + bbox.width);
  ctx.save();
  for (const [spans, name] of [[gaps, "gap"], [cuts, "cut"]]) {
    ctx.fillStyle = colour(name);
    for (const [a, b] of spans) ctx.fillRect(place(a), bbox.top, Math.max(px, place(b) - place(a)), bbox.height);
  }
  ctx.fillStyle = colour("noise");
  for (const t of alone) {
    const x = place(t);
    ctx.beginPath();
    ctx.moveTo(x - 3 * px, bbox.top);
    ctx.lineTo(x + 3 * px, bbox.top);
    ctx.lineTo(x, bbox.top + 6 * px);
    ctx.fill();
  }
  ctx.restore();
}

// Density over time and frequency as an image below a plot's axes; time and band are brushed together.

// cividis, which colour-blind people read as everyone does (Nunez, Anderton, Renslow 2018), in nine steps
const STOPS = [[0, 32, 77], [0, 48, 111], [57, 72, 108], [87, 93, 109], [112, 113, 115], [138, 134, 120], [166, 157, 117], [196, 181, 108], [255, 234, 70]];

const DARKEST = 1e4; // below the strongest line everything has the darkest colour

function paint(v) {
  const x = Math.min(Math.max(v, 0), 1) * (STOPS.length - 1), k = Math.min(Math.floor(x), STOPS.length - 2), t = x - k;
  return STOPS[k].map((c, i) => c + t * (STOPS[k + 1][i] - c));
}

export function spectrogramPlot(box, { limits, moved, band, banded, harmonic, spin }) {
  let image = null, found = null;
  const made = mounted(
    box,
    {
      scales: { x: { time: false, range: () => limits() }, y: { range: () => (found ? [0, found.frequency[1]] : [0, 1.5]) } },
      series: [{}, { scale: "y", points: { show: false } }],
      axes: [axis("time since the first sample, s", { grid: { show: false } }), axis("frequency, Hz", { side: 3, grid: { show: false }, size: () => 3 * rem(), labelSize: 1.4 * rem() })],
      cursor: { sync: { key: "time", scales: ["x", null] }, drag: { x: true, y: true, uni: 24, setScale: false }, points: { show: false }, y: false },
      hooks: {
        drawClear: [(u) => draw(u)],
        setSelect: [
          (u) => {
            const { left, top, width, height } = u.select;
            if (width < 4 && height < 4) return;
            const whole = { w: u.over.clientWidth, h: u.over.clientHeight };
            u.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
            if (height > 4 && height < whole.h - 2) banded(Math.max(0, u.posToVal(top + height, "y")), u.posToVal(top, "y"));
            if (width > 4 && width < whole.w - 2) moved(u.posToVal(left, "x"), u.posToVal(left + width, "x"));
          },
        ],
      },
    },
    [[0, 1], [null, null]],
  );
  made.plot.over.addEventListener("pointermove", () => tell(made.plot.cursor));
  made.plot.over.addEventListener("pointerleave", () => tell(null));
  function tell(cursor) {
    const place = box.closest("figure").querySelector(".readout");
    if (!place) return;
    if (!cursor || !found || cursor.left < 0) return void (place.textContent = "");
    const t = made.plot.posToVal(cursor.left, "x"), f = made.plot.posToVal(cursor.top, "y");
    const at = ([a, b], n, v) => (n > 1 ? Math.round(((v - a) / (b - a)) * (n - 1)) : 0);
    const i = at(found.time, found.width, t), k = at(found.frequency, found.height, f);
    const v = i >= 0 && i < found.width && k >= 0 && k < found.height ? found.density[k * found.width + i] : NaN;
    place.textContent = Number.isFinite(v) ? `${number(t, 5)} s · ${number(f, 3)} Hz · ${number(v)} Eo/√Hz` : "";
  }
  wheel(made.plot, moved);
  made.plot.over.addEventListener("dblclick", () => (moved(null, null), banded(null, null)));

  function draw(u) {
    const { ctx, bbox } = u;
    const px = devicePixelRatio;
    if (image && found) {
      ctx.save();
      ctx.beginPath();
      ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
      ctx.clip();
      ctx.imageSmoothingEnabled = false;
      const { x, y, width, height } = placed(u);
      ctx.drawImage(image, x, y, width, height);
      const [low, high] = band();
      ctx.strokeStyle = "#ffffff";
      ctx.lineWidth = px;
      if (low !== null) {
        const [a, b] = [low, high].map((f) => u.valToPos(f, "y", true));
        ctx.strokeRect(bbox.left, b, bbox.width, a - b);
      }
      for (let k = 1; k <= 6; k++) {
        const y = u.valToPos(k * spin(), "y", true);
        if (y < bbox.top) break;
        ctx.setLineDash(harmonic() === k ? [] : [2 * px, 6 * px]);
        ctx.globalAlpha = harmonic() === k ? 1 : 0.6;
        ctx.beginPath();
        ctx.moveTo(bbox.left, y);
        ctx.lineTo(bbox.left + bbox.width, y);
        ctx.stroke();
      }
      ctx.restore();
    }
  }

  /** Where the image lies, in pixels of the canvas. */
  function placed(u) {
    const step = found.width > 1 ? (found.time[1] - found.time[0]) / (found.width - 1) : 1;
    const rise = found.height > 1 ? (found.frequency[1] - found.frequency[0]) / (found.height - 1) : 1;
    const x = u.valToPos(found.time[0] - step / 2, "x", true), y = u.valToPos(found.frequency[1] + rise / 2, "y", true);
    return { x, y, width: u.valToPos(found.time[1] + step / 2, "x", true) - x, height: u.valToPos(found.frequency[0] - rise / 2, "y", true) - y };
  }

  return {
    ...made,
    show(data) {
      found = data;
      const { width, height, density } = data;
      const shown = [...density].filter(Number.isFinite).sort((a, b) => a - b);
      // from below the noise to the strongest line
      const high = Math.log(shown.at(-1) || 1), low = Math.min(Math.max(Math.log(shown[Math.floor(shown.length * 0.05)] || 1e-9), high - Math.log(DARKEST)), high - Math.log(20));
      image = document.createElement("canvas");
      image.width = width;
      image.height = height;
      const c = image.getContext("2d"), pixels = c.createImageData(width, height);
      for (let k = 0; k < height; k++) {
        for (let i = 0; i < width; i++) {
          const v = density[k * width + i], at = 4 * ((height - 1 - k) * width + i);
          if (!Number.isFinite(v)) continue;
          const [r, g, b] = paint((Math.log(v) - low) / (high - low));
          pixels.data.set([r, g, b, 255], at);
        }
      }
      c.putImageData(pixels, 0, 0);
      made.plot.setScale("x", { min: limits()[0], max: limits()[1] });
      made.plot.redraw(false, true);
      return { low: Math.exp(low), high: Math.exp(high) };
    },
    marked: () => made.plot.redraw(false),
    zoomed: () => made.plot.setScale("x", { min: limits()[0], max: limits()[1] }),
  };
}

/** The colours of the scale, for a legend. */
export const ramp = () => STOPS.map((c, k) => `rgb(${c.join(" ")}) ${(100 * k) / (STOPS.length - 1)}%`).join(", ");
