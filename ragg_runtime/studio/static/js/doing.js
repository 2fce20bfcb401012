// What the user has done, and where everyone sees what went wrong with it.
import { act, Refused } from "./api.js";
import { fill, h } from "./dom.js";

/** Facts of an error, where everyone sees them. */
export function trouble(facts) {
  const box = document.getElementById("trouble");
  box.hidden = !facts;
  if (!facts) return;
  const rows = ["where", "found", "expected", "remedy"].filter((k) => facts[k]);
  fill(
    box,
    h("p.first", {}, facts.what),
    rows.length ? h("dl", {}, rows.map((k) => [h("dt", {}, k), h("dd", {}, facts[k])])) : null,
    h("button.quiet", { type: "button", onclick: () => trouble(null), "aria-label": "Close this message" }, "Close"),
  );
}

/** Do something; what goes wrong is told. */
export async function doing(what, body) {
  try {
    trouble(null);
    await act(what, body);
    return true;
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    trouble(error.facts);
    return false;
  }
}
