// Amplitude densities on logarithmic axes, the multiples of the spin marked; a band can be brushed.
import { number } from "../dom.js";
import { axis, colour, LOG, mounted, plain, rem } from "./axes.js";

const LINES = [
  { id: "beside", name: "model beside it", colour: "beside", width: 1.6 },
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
      scales: { x: { time: false, distr: 3, range: (u, a, b) => [a, b] }, y: { distr: 3, range: (u, a, b) => spread(a, b) } },
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
  if (!(a > 0)) return [0.1, 10];
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
