// Density over time and frequency as an image below a plot's axes; time and band are brushed together.
import { number } from "../dom.js";
import { axis, mounted, rem, wheel } from "./axes.js";

// cividis, which colour-blind people read as everyone does (Nunez, Anderton, Renslow 2018), in nine steps
const STOPS = [[0, 32, 77], [0, 48, 111], [57, 72, 108], [87, 93, 109], [112, 113, 115], [138, 134, 120], [166, 157, 117], [196, 181, 108], [255, 234, 70]];

const DEEPEST = 1e4; // below the strongest line everything has the darkest colour

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
      const { x, y, width, height } = placed(u, true);
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

  /** Where the image lies, in pixels of the canvas or of the page. */
  function placed(u, canvas) {
    const step = found.width > 1 ? (found.time[1] - found.time[0]) / (found.width - 1) : 1;
    const rise = found.height > 1 ? (found.frequency[1] - found.frequency[0]) / (found.height - 1) : 1;
    const x = u.valToPos(found.time[0] - step / 2, "x", canvas), y = u.valToPos(found.frequency[1] + rise / 2, "y", canvas);
    return { x, y, width: u.valToPos(found.time[1] + step / 2, "x", canvas) - x, height: u.valToPos(found.frequency[0] - rise / 2, "y", canvas) - y };
  }

  return {
    ...made,
    show(data) {
      found = data;
      const { width, height, density } = data;
      const shown = [...density].filter(Number.isFinite).sort((a, b) => a - b);
      // from below the noise to the strongest line
      const high = Math.log(shown.at(-1) || 1), low = Math.min(Math.max(Math.log(shown[Math.floor(shown.length * 0.05)] || 1e-9), high - Math.log(DEEPEST)), high - Math.log(20));
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
    image: () => (image && found ? { href: image.toDataURL(), ...placed(made.plot, false) } : null),
    zoomed: () => made.plot.setScale("x", { min: limits()[0], max: limits()[1] }),
  };
}

/** The colours of the scale, for a legend. */
export const ramp = () => STOPS.map((c, k) => `rgb(${c.join(" ")}) ${(100 * k) / (STOPS.length - 1)}%`).join(", ");
