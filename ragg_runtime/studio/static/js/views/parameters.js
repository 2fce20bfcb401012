// Which parameters the record sees: combinations with uncertainty, correlations, the pull of the sheet, the next motion.
import { fill, h, symbol } from "../dom.js";
import { on, server } from "../store.js";
import { drawingText } from "../plots/export.js";
import { fileName, saves } from "../plots/figure.js";
import { pullBars } from "../plots/pulls.js";

const SAID = "Calibrated ± uncertainty; below it the test sheet. Grey: the record does not see it, the value is the sheet’s. Italic: it sees a part of it.";
const SHORT = 2; // sums up to which they are told in the line; more are unfolded

const cell = (c) => h("td", { class: `n ${c.state}`, title: `test sheet: ${c.nominal}` }, c.value, h("small", {}, c.nominal));

const table = (rows, heads, caption) =>
  h("div.wide", { tabindex: "0", role: "group", "aria-label": caption }, h("table.numbers", { class: heads.length > 4 ? "many" : "" }, h("caption", {}, caption),
    h("thead", {}, h("tr", {}, h("th", {}, "parameter"), h("th", {}, "unit"), heads.map((x) => h("th.n", {}, x)))),
    h("tbody", {}, rows.map((row) => h("tr", {}, h("th", { scope: "row", title: row.symbol.meaning }, symbol(row.symbol.pieces), h("small", {}, ` ${row.symbol.name}`)), h("td", {}, row.unit), row.cells.length === 1 ? [cell(row.cells[0]), h("td", { colspan: String(heads.length - 1) })] : row.cells.map(cell))))));

const piece = (p, k) => [p.sign ? ` ${p.sign} ` : k ? " " : "", p.factor ? `${p.factor} ` : "", p.pattern ? [h("span.pattern", {}, p.pattern), " "] : "", symbol(p.symbol.pieces)];
const sum = (row) => row.map(piece);
const listed = (items) => items.map((x, k) => [k ? ", " : "", x]);

/** [{pattern, symbol}] as "K₂, K₅ of A1, A2": those that stand for the same accelerometers together. */
function gathered(members) {
  const own = new Map();
  for (const m of members) {
    const known = own.get(m.symbol.name) || { symbol: m.symbol, of: [] };
    known.of.push(m.pattern);
    own.set(m.symbol.name, known);
  }
  const alike = new Map();
  for (const x of own.values()) {
    const key = x.of.join(", ");
    alike.set(key, [...(alike.get(key) || []), x.symbol]);
  }
  return [...alike].map(([of, symbols], k) => [k ? "; " : "", listed(symbols.map((x) => symbol(x.pieces))), of ? [" of ", h("span.pattern", {}, of)] : ""]);
}

const group = (g) =>
  g.seen.length <= SHORT
    ? h("li", {}, gathered(g.members), g.seen.length ? [": the record sees ", g.seen.map((row, k) => [k ? "; " : "", sum(row)])] : ": none of them")
    : h("li", {}, h("details", {}, h("summary", {}, gathered(g.members), `: of ${g.members.length} the record sees ${g.seen.length} sums`), h("ul.sums", {}, g.seen.map((row) => h("li", {}, sum(row))))));

/** What stays as the sheet has it: by combination, or of which accelerometers. */
const unseen = (p) =>
  p.patterned
    ? p.unseen.map((u) => h("li", {}, h("span.pattern", {}, u.pattern), " of ", listed(u.symbols.map((x) => symbol(x.pieces)))))
    : h("li", {}, gathered(p.unseen.flatMap((u) => u.symbols.map((x) => ({ pattern: u.pattern, symbol: x })))));

function pull(rows, model) {
  const drawn = pullBars(rows.map((x) => ({ name: x.of.pattern, pieces: x.of.symbol.pieces, symbol: x.of.symbol.name, sigma: x.sigma })));
  return h("section.card", {}, h("figure.drawn", { "aria-label": "Pull of the test sheet" },
    h("figcaption", {}, h("h2", {}, "Pull of the test sheet"), h("span.spacer"), saves("Pull of the test sheet", () => fileName(model, "pull"), () => drawingText(drawn))),
    h("p.note", {}, "How far the calibration moved a value from the sheet, in plausible errors; the farthest."), drawn));
}

export function parametersView(main) {
  let shown = "";
  const known = () => {
    const { state } = server;
    const p = state && state.parameters;
    const key = JSON.stringify([p, p && state.next_motion]);
    if (key === shown) return; // what is unfolded stays so
    shown = key;
    if (!p) return void fill(main, h("p.empty-note", {}, "The parameters are known once a flight is compared."));
    fill(
      main,
      h("section.card", {}, h("h2", {}, "What the record determines"),
        h("p.lead", {}, `${p.determined} of ${p.total} directions of the parameters are the record’s own; the others stay where the test sheet puts them.`),
        p.groups.length ? [h("h3", {}, "Seen together only"), h("ul.together", {}, p.groups.map(group))] : null,
        p.unseen.length ? [h("h3", {}, "Not seen at all"), h("ul", {}, unseen(p))] : null),
      p.combined.length ? h("section.card", {}, h("h2", {}, "Combinations of the four accelerometers"), table(p.combined, p.patterns, SAID)) : null,
      h("div.pair", {},
        pull(p.pull, state.model.name),
        h("section.card", {}, h("h2", {}, "Tied most closely"), h("p.note", {}, "Correlations of calibrated values: what the record tells of both together rather than of each."),
          h("ul.tied", {}, p.correlations.map((x) => h("li", {}, h("span", {}, piece(x.a, 0)), h("span", {}, piece(x.b, 0)), h("b", {}, (x.r < 0 ? "−" : "+") + Math.abs(x.r).toFixed(3))))))),
      h("section.card", {}, h("h2", {}, "Each accelerometer"), table(p.single, p.accelerometers, SAID)),
      h("section.card", {}, h("h2", {}, "Which flight next"), state.next_motion.length ? h("ul", {}, state.next_motion.map((m) => h("li", {}, m.words))) : h("p.note", {}, "No rivals are left that another motion would have to tell apart.")),
    );
  };
  known();
  return on("server", known);
}
