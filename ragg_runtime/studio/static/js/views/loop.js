// The loop: where one stands, where the model fails, what is missing, and what ticking it would do.
import { h } from "../dom.js";
import { on } from "../store.js";
import { banner } from "./banner.js";
import { effectsPane } from "./effects.js";
import { figures } from "./figures.js";
import { unexplainedPane } from "./unexplained.js";

export function loopView(main) {
  const top = h("section.banner", { "aria-label": "Where one stands" });
  const left = h("div.figures");
  const right = h("aside.effects", { "aria-label": "Effects" });
  const below = h("section.unexplained", { "aria-label": "What is unexplained" });
  main.replaceChildren(top, h("div.columns", {}, left, h("div.side", {}, right, below)));
  const parts = [banner(top), figures(left), effectsPane(right), unexplainedPane(below)];
  const off = on("server", () => parts.forEach((p) => p.known && p.known()));
  parts.forEach((p) => p.known && p.known());
  return () => {
    off();
    parts.forEach((p) => p.gone && p.gone());
  };
}
