// Density over time and frequency as an image below a plot's axes; time and band are brushed together.
import { axis, mounted, rem, wheel } from "./axes.js";

// cividis, which colour-blind people read as everyone does (Nunez, Anderton, Renslow 2018), in nine steps
const STOPS = [[0, 32, 77], [0, 48, 111], [57, 72, 108], [87, 93, 109], [112, 113, 115], [138, 134, 120], [166, 157, 117], [196, 181, 108], [255, 234, 70]];

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
      axes: [axis("time since the first sample, s", { grid: { show: false } }), axis("frequency, Hz", { side: 3, grid: { show: false }, size: 3 * rem(), labelSize: 1.4 * rem() })],
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
      const step = found.width > 1 ? (found.time[1] - found.time[0]) / (found.width - 1) : 1;
      const rise = found.height > 1 ? (found.frequency[1] - found.frequency[0]) / (found.height - 1) : 1;
      const x0 = u.valToPos(found.time[0] - step / 2, "x", true), x1 = u.valToPos(found.time[1] + step / 2, "x", true);
      const y0 = u.valToPos(found.frequency[0] - rise / 2, "y", true), y1 = u.valToPos(found.frequency[1] + rise / 2, "y", true);
      ctx.imageSmoothingEnabled = false;
      ctx.drawImage(image, x0, y1, x1 - x0, y0 - y1);
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

  return {
    ...made,
    show(data, floor) {
      found = data;
      const { width, height, density } = data;
      const shown = [...density].filter(Number.isFinite).sort((a, b) => a - b);
      // from below the noise to the strongest line
      const low = Math.log(shown[Math.floor(shown.length * 0.05)] || 1e-9), high = Math.max(Math.log(shown.at(-1) || 1), low + Math.log(20));
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
    image: () => (image ? image.toDataURL() : null),
    zoomed: () => made.plot.setScale("x", { min: limits()[0], max: limits()[1] }),
  };
}

/** The colours of the scale, for a legend. */
export const ramp = () => STOPS.map((c, k) => `rgb(${c.join(" ")}) ${(100 * k) / (STOPS.length - 1)}%`).join(", ");
