// The frame of a figure: heading, legend, what the pointer reads, and the figure as a file.
import { fill, h } from "../dom.js";
import { take } from "./export.js";

/** Two buttons that hand a figure over; `text` gives it as SVG text, `name` that of the file. */
export const saves = (title, name, text) =>
  h("span.saves", {}, ["svg", "png"].map((k) => h("button.save", { type: "button", onclick: () => take(name(), text(), k), "aria-label": `${title} as ${k.toUpperCase()}` }, k.toUpperCase())));

/**
 * @param text gives the figure as SVG text, once it is drawn; `name` that of the file
 */
export function frame({ id, title, name, text, body = h("div.plot"), kind = "figure.panel", more = [] }) {
  const note = h("p.plot-note", { hidden: true }), legend = h("div.legend");
  const element = h(kind, { class: id, "aria-label": title }, h("figcaption", {}, h("h2", {}, title), legend, ...more, h("span.readout", { "aria-hidden": "true" }), saves(title, name, text)), body, note);
  return {
    element, body, note, legend,
    /** rows of [name, colour, kind] */
    keys: (rows) => fill(legend, rows.filter(Boolean).map(([what, colour, dashed]) => h("span", {}, h(`i.key.${colour}`, { class: dashed || "" }), what))),
    say(words) {
      note.hidden = !words;
      note.textContent = words || "";
    },
  };
}

/** A file name of what a figure shows. */
export const fileName = (...parts) => parts.filter(Boolean).join("-").replace(/[^\p{L}\p{N}]+/gu, "-").slice(0, 80) || "figure";
