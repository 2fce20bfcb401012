// What ticked effects would leave: asked at once, shown everywhere.
import { ask, Refused } from "../api.js";
import { look, on, server, view } from "../store.js";

let found = null;
let asked = 0;

/** The last answer for what is ticked, or null. */
export const foreseen = () => found;

async function again() {
  const mine = ++asked;
  const effects = view.ticked.join(",");
  if (!effects || !server.state || !server.state.effects.length) {
    found = null;
    look({ foreseen: String(mine) }, true);
    return;
  }
  const began = performance.now();
  try {
    const answer = await ask("preview", { effects });
    if (mine !== asked) return;
    found = answer;
    document.documentElement.dataset.preview = (performance.now() - began).toFixed(1);
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    found = null;
  }
  look({ foreseen: String(mine) }, true);
}

on("ticked", again);
on("server", () => {
  // effects that are in the model now, or unknown, are ticked no longer
  const ids = new Set((server.state ? server.state.effects : []).map((e) => e.id));
  if (server.state && server.state.effects.length) {
    const kept = view.ticked.filter((e) => ids.has(e));
    if (kept.length !== view.ticked.length) look({ ticked: kept });
    else if (view.ticked.length && !found) again();
  } else if (server.state && server.state.banner && !server.state.effects.length && found) again();
});
