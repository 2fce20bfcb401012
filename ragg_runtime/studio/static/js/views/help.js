// The keys, in a dialog.
import { h } from "../dom.js";

const KEYS = [
  ["1 … 7", "the views, from left to right"],
  ["j, k", "next and previous effect"],
  ["Space", "tick or untick the effect"],
  ["Enter", "on an effect: open or close what is known of it"],
  ["a", "derive and calibrate what is ticked"],
  ["v, e, i, c", "V, Eo, inline, cross"],
  ["+, −", "zoom in and out"],
  ["[, ]", "move left and right"],
  ["0", "the whole flight"],
  ["f, o", "next flight, next output"],
  ["u, r", "undo, redo"],
  ["d", "light or dark"],
  ["wheel", "zoom about the pointer; with Shift: move"],
  ["drag", "choose a stretch of time, a band of frequencies; double click: all"],
];

export function help() {
  const box = h(
    "dialog.help", { "aria-label": "Keys", onclose: () => box.remove() },
    h("h2", {}, "Keys"),
    h("table", {}, h("tbody", {}, KEYS.map(([key, what]) => h("tr", {}, h("th", { scope: "row" }, h("kbd", {}, key)), h("td", {}, what))))),
    h("form", { method: "dialog" }, h("button", {}, "Close")),
  );
  document.body.append(box);
  box.showModal();
}
