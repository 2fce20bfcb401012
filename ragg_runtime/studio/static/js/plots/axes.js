// What all curves share: colours from the style sheet, axes, sizes, zoom and pan.
import uPlot from "../../vendor/uPlot.esm.js";
import { number, superscript } from "../dom.js";

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
export const LOG = {
  values: logValues,
  filter: (u, splits) => splits, // logValues says which have room
  grid: { stroke: () => colour("grid"), width: 1, filter: labelled },
  ticks: { stroke: () => colour("line"), width: 1, size: 4, filter: labelled },
};

/**
 * A plot that fills its box and is drawn anew when that or the colours change.
 * `told(u, k)` says in words what stands at sample k below the pointer; it is shown in the figure's heading.
 */
export function mounted(box, options, data, told) {
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
  if (told) reading(plot, box, told);
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

function reading(plot, box, told) {
  const place = () => box.closest("figure") && box.closest("figure").querySelector(".readout");
  const say = () => {
    const at = place(), { left, idx } = plot.cursor;
    const text = left >= 0 && idx !== null && idx !== undefined ? told(plot, idx) : "";
    if (at && at.textContent !== text) at.textContent = text;
  };
  // linked plots move their cursors together, and each says what stands there
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
