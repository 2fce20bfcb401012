// The whole flight as a strip, and the window on it: drag to choose one, drag its middle to move it.
import { h } from "../dom.js";
import { axis, colour, LEFT, mounted, RIGHT } from "./axes.js";

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
    /** Marks and window for the figure as a file. */
    text() {
      const { clientWidth: width, clientHeight: height } = plot.over, place = (t) => Math.min(Math.max(plot.valToPos(t, "x"), 0), width);
      const { gaps, alone, cuts } = marks(), [x0, x1] = limits().map(place);
      const columns = [[gaps, "gap"], [cuts, "cut"]].flatMap(([spans, name]) => spans.map(([a, b]) => `<rect x="${place(a)}" width="${Math.max(1, place(b) - place(a))}" height="${height}" fill="${colour(name)}"/>`));
      const spikes = alone.map((t) => `<path d="M${place(t) - 3} 0h6l-3 6z" fill="${colour("noise")}"/>`);
      return { under: [...columns, ...spikes].join(""), over: `<rect x="${x0}" width="${x1 - x0}" height="${height}" fill="none" stroke="${colour("ink")}"/>` };
    },
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
