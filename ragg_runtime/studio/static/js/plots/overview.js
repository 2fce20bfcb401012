// The whole flight as a strip, and the window on it: drag to choose one, drag its middle to move it.
import { axis, colour, mounted, rem } from "./axes.js";

export function overview(box, { whole, limits, moved }) {
  const made = mounted(
    box,
    {
      scales: { x: { time: false, range: () => whole() }, y: { range: (u, a, b) => (a === null ? [-1, 1] : [a, b]) } },
      series: [{}, { stroke: () => colour("before"), width: 1, points: { show: false } }, { stroke: () => colour("before"), width: 1, points: { show: false } }],
      bands: [{ series: [2, 1], fill: () => colour("before") }],
      axes: [axis(undefined, { labelSize: 0, label: undefined }), { show: false }],
      padding: [2, 8, 0, 4.2 * rem()],
      cursor: { show: false },
      hooks: { draw: [(u) => shade(u, limits())] },
    },
    [[0, 1], [null, null], [null, null]],
  );
  const { plot } = made;
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
    show(found) {
      const clean = (v) => Array.from(v, (x) => (Number.isNaN(x) ? null : x));
      plot.setData([found.x, clean(found.low), clean(found.high)]);
    },
  };
}

function shade(u, [a, b]) {
  const { ctx, bbox } = u;
  const [x0, x1] = [a, b].map((t) => Math.min(Math.max(u.valToPos(t, "x", true), bbox.left), bbox.left + bbox.width));
  ctx.save();
  ctx.fillStyle = colour("veil");
  ctx.fillRect(bbox.left, bbox.top, x0 - bbox.left, bbox.height);
  ctx.fillRect(x1, bbox.top, bbox.left + bbox.width - x1, bbox.height);
  ctx.strokeStyle = colour("ink");
  ctx.lineWidth = devicePixelRatio;
  ctx.strokeRect(x0, bbox.top, Math.max(1, x1 - x0), bbox.height);
  ctx.restore();
}
