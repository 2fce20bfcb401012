// Which parameters the record sees: combinations with uncertainty, correlations, the pull of the sheet, the next motion.
import { fill, h, number, symbol } from "../dom.js";
import { on, server } from "../store.js";

const SAID = "Calibrated ± uncertainty; below it the test sheet. Grey: the record does not see it, the value is the sheet’s. Italic: it sees a part of it.";

const cell = (c) => h("td", { class: `n ${c.state}`, title: `test sheet: ${c.nominal}` }, c.value, h("small", {}, c.nominal));

const table = (rows, heads, caption) =>
  h("div.wide", {}, h("table.numbers", {}, h("caption", {}, caption),
    h("thead", {}, h("tr", {}, h("th", {}, "parameter"), h("th", {}, "unit"), heads.map((x) => h("th.n", {}, x)))),
    h("tbody", {}, rows.map((r) => h("tr", {}, h("th", { scope: "row", title: r.symbol.meaning }, symbol(r.symbol.pieces), h("small", {}, ` ${r.symbol.name}`)), h("td", {}, r.unit), r.cells.length === 1 ? [cell(r.cells[0]), h("td", { colspan: String(heads.length - 1) })] : r.cells.map(cell))))));

const piece = (p, k) => [p.sign ? ` ${p.sign} ` : k ? " " : "", p.factor ? `${p.factor} ` : "", h("span.pattern", {}, p.pattern), " ", symbol(p.symbol.pieces)];

export function parametersView(main) {
  const known = () => {
    const { state } = server;
    const p = state && state.parameters;
    if (!p) return void fill(main, h("p.empty-note", {}, "The parameters are known once a flight is compared."));
    const most = Math.max(1, ...p.pull.map((x) => Math.abs(x.sigma)));
    fill(
      main,
      h("section.card", {}, h("h2", {}, "What the record determines"),
        h("p.lead", {}, `${p.determined} of ${p.total} directions of the parameters are the record’s own; the others stay where the test sheet puts them.`),
        p.groups.length ? [h("h3", {}, "Seen together only"), h("ul", {}, p.groups.map((g) => h("li", {}, g.members.map((m, k) => [k ? ", " : "", piece({ ...m, sign: "" }, 0)]), g.seen.length ? [": the record sees ", g.seen.map((row, k) => [k ? "; " : "", row.map(piece)])] : ": none of them")))] : null,
        p.unseen.length ? [h("h3", {}, "Not seen at all"), h("ul", {}, p.unseen.map((u) => h("li", {}, h("span.pattern", {}, u.pattern), " of ", u.symbols.map((x, k) => [k ? ", " : "", symbol(x.pieces)]))))] : null),
      p.combined.length ? h("section.card", {}, h("h2", {}, "Combinations of the four accelerometers"), table(p.combined, p.patterns, SAID)) : null,
      h("div.pair", {},
        h("section.card", {}, h("h2", {}, "Pull of the test sheet"), h("p.note", {}, "How far the calibration moved a value from the sheet, in plausible errors."),
          h("ul.pulls", {}, p.pull.map((x) => {
            const bar = h("i");
            bar.style.setProperty("--size", `${(50 * Math.abs(x.sigma)) / most}%`);
            return h("li", {}, h("code", {}, x.label), h("span", { class: x.sigma < 0 ? "left" : "right" }, bar), h("b", {}, `${x.sigma < 0 ? "−" : "+"}${number(Math.abs(x.sigma), 2)}`));
          }))),
        h("section.card", {}, h("h2", {}, "Tied most closely"), h("p.note", {}, "Correlations of calibrated values: what the record tells of both together rather than of each."),
          h("ul.pulls", {}, p.correlations.map((x) => h("li.pairing", {}, h("code", {}, x.a), h("code", {}, x.b), h("b", {}, (x.r < 0 ? "−" : "+") + Math.abs(x.r).toFixed(3))))))),
      h("section.card", {}, h("h2", {}, "Each accelerometer"), table(p.single, p.accelerometers, SAID)),
      h("section.card", {}, h("h2", {}, "Which flight next"), state.next_motion.length ? h("ul", {}, state.next_motion.map((m) => h("li", {}, m.words))) : h("p.note", {}, "No rivals are left that another motion would have to tell apart.")),
    );
  };
  known();
  return on("server", known);
}
