// Every plot as PNG and as SVG: the PNG is its canvas on paper, the SVG is written from its data.
import { colour } from "./axes.js";

function saved(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

export function png(plot, name) {
  const from = plot.ctx.canvas;
  const canvas = document.createElement("canvas");
  canvas.width = from.width;
  canvas.height = from.height;
  const c = canvas.getContext("2d");
  c.fillStyle = colour("paper");
  c.fillRect(0, 0, canvas.width, canvas.height);
  c.drawImage(from, 0, 0);
  canvas.toBlob((blob) => saved(`${name}.png`, blob), "image/png");
}

const escaped = (t) => String(t).replace(/[<>&"]/g, (c) => ({ "<": "&lt;", ">": "&gt;", "&": "&amp;", '"': "&quot;" })[c]);

function path(plot, k, x) {
  const s = plot.series[k];
  let d = "", pen = "M";
  for (let i = 0; i < x.length; i++) {
    const v = plot.data[k][i];
    if (v === null || v === undefined || Number.isNaN(v) || x[i] < plot.scales.x.min || x[i] > plot.scales.x.max) { pen = "M"; continue; }
    d += `${pen}${plot.valToPos(x[i], "x").toFixed(1)} ${plot.valToPos(v, s.scale).toFixed(1)}`;
    pen = "L";
  }
  return d;
}

function ticks(plot, k, box) {
  const a = plot.axes[k], made = [];
  const splits = a._splits || [], values = a._values || [];
  splits.forEach((v, i) => {
    if (v === null || !values[i]) return;
    const p = plot.valToPos(v, a.scale);
    if (k === 0) {
      if (p < -1 || p > box.w + 1) return;
      made.push(`<line x1="${p}" x2="${p}" y1="0" y2="${box.h}" stroke="${colour("grid")}"/><text x="${p}" y="${box.h + 16}" text-anchor="middle">${escaped(values[i])}</text>`);
    } else {
      if (p < -1 || p > box.h + 1) return;
      made.push(`<line x1="0" x2="${box.w}" y1="${p}" y2="${p}" stroke="${colour("grid")}"/><text x="-6" y="${p + 4}" text-anchor="end">${escaped(values[i])}</text>`);
    }
  });
  const label = escaped(typeof a.label === "function" ? a.label(plot, k) : a.label || "");
  made.push(k === 0
    ? `<text x="${box.w / 2}" y="${box.h + 34}" text-anchor="middle">${label}</text>`
    : `<text transform="translate(-46 ${box.h / 2}) rotate(-90)" text-anchor="middle">${label}</text>`);
  return made.join("");
}

/** The plot as SVG text; `image` is a data address that lies below the curves (a spectrogram). */
export function svgText(plot, image) {
  const box = { w: plot.over.clientWidth, h: plot.over.clientHeight };
  const x = plot.data[0];
  const lines = plot.series.slice(1).map((s, k) => {
    if (!s.show || !plot.data[k + 1]) return "";
    const stroke = typeof s.stroke === "function" ? s.stroke(plot, k + 1) : s.stroke;
    const width = typeof s.width === "number" ? s.width : 1;
    return `<path d="${path(plot, k + 1, x)}" fill="none" stroke="${stroke}" stroke-width="${width}"${s.dash ? ` stroke-dasharray="${s.dash.join(" ")}"` : ""}/>`;
  });
  const under = image ? `<image href="${image}" x="0" y="0" width="${box.w}" height="${box.h}" preserveAspectRatio="none"/>` : "";
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="-64 -12 ${box.w + 84} ${box.h + 56}" font-family="system-ui, Arial, sans-serif" font-size="12" fill="${colour("ink")}">
<rect x="-64" y="-12" width="${box.w + 84}" height="${box.h + 56}" fill="${colour("paper")}"/>
${image ? under + ticks(plot, 0, box) + ticks(plot, 1, box) : ticks(plot, 0, box) + ticks(plot, 1, box)}
<clipPath id="c"><rect width="${box.w}" height="${box.h}"/></clipPath><g clip-path="url(#c)">${lines.join("\n")}</g>
<rect width="${box.w}" height="${box.h}" fill="none" stroke="${colour("line")}"/></svg>\n`;
}

export const svg = (plot, name, image) => saved(`${name}.svg`, new Blob([svgText(plot, image)], { type: "image/svg+xml" }));
