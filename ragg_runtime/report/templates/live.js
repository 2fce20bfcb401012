// Reads out and zooms the curves of a report, and switches between light and dark. Without it the page is whole.
"use strict";
(() => {
  const SVG = "http://www.w3.org/2000/svg";
  const CLOSEST = 1 / 60; // share of an axis that is the least that is shown: coordinates are written to 0.01 point
  const drawn = (tag, attributes, to) => {
    const made = document.createElementNS(SVG, tag);
    for (const [k, v] of Object.entries(attributes)) made.setAttribute(k, v);
    return to.appendChild(made);
  };
  const element = (tag, name, text, to) => {
    const made = document.createElement(tag);
    made.className = name;
    made.textContent = text;
    return to.appendChild(made);
  };
  const words = (x, digits) => {
    if (x === 0) return "0";
    const size = Math.abs(x);
    const text = size >= 1e6 || size < 1e-3 ? x.toExponential(digits - 1).replace("e", " × 10^").replace("+", "") : String(Number(x.toPrecision(digits)));
    return text.replaceAll("-", "−");
  };
  // [first, last, logarithmic]: the value at a share of an axis, and the share of a value
  const at = ([a, b, log], s) => (log ? a * (b / a) ** s : a + (b - a) * s);
  const share = ([a, b, log], v) => (log ? Math.log(v / a) / Math.log(b / a) : (v - a) / (b - a));

  /** Round values of which about `most` lie between two; of a logarithmic axis 1, 2, 5 where decades are few. */
  function ticks(a, b, log, most) {
    const found = [];
    if (log && b / a > 8) {
      for (let d = Math.floor(Math.log10(a)); d <= Math.log10(b); d++) for (const m of b / a > 3000 ? [1] : [1, 2, 5]) found.push(m * 10 ** d);
    } else {
      const raw = (b - a) / most, ten = 10 ** Math.floor(Math.log10(raw)), step = ten * [1, 2, 5, 10].find((m) => m * ten >= raw);
      for (let k = Math.ceil(a / step); k * step <= b; k++) found.push(k * step);
    }
    return found.filter((v) => v >= a && v <= b).map((v) => Number(v.toPrecision(12)));
  }

  /** A curve's own path, its points, and how it is written again. */
  function curve(group, label) {
    const path = group.querySelector("path"), use = group.querySelector("use");
    const down = use ? Number(use.getAttribute("y")) : 0; // areas are drawn from the lower edge of the figure
    const whole = path.getAttribute("d"), parts = whole.match(/[A-Za-z]|-?[\d.]+/g), kind = [], x = [], y = [];
    for (let k = 0; k < parts.length; k += parts[k] === "z" ? 1 : 3) {
      kind.push(parts[k]);
      x.push(Number(parts[k + 1]));
      y.push(Number(parts[k + 2]) + down);
    }
    const write = (zoomed, fx, fy) => path.setAttribute("d", !zoomed ? whole : kind.map((c, i) => (c === "z" ? c : `${c}${fx(x[i]).toFixed(2)} ${(fy(y[i]) - down).toFixed(2)}`)).join(""));
    /** Ordinates of the curve at an abscissa: one of a line, two of an area, none in a gap. */
    const over = (u) => {
      const found = [];
      for (let i = 1; i < x.length; i++) {
        if (kind[i] !== "L" || x[i] === x[i - 1] || (x[i] - u) * (x[i - 1] - u) > 0) continue;
        found.push(y[i - 1] + ((u - x[i - 1]) / (x[i] - x[i - 1])) * (y[i] - y[i - 1]));
      }
      return found.length ? [Math.min(...found), Math.max(...found)] : null;
    };
    const style = getComputedStyle(use || path);
    return { label, write, over, area: Boolean(use), colour: () => (use && style.fill !== "none" ? style.fill : style.stroke) };
  }

  function chart(svg, name, spec, n) {
    const [left, top, width, height] = spec.box;
    const by = (id) => document.getElementById(`${name}-${id}`);
    const curves = spec.curves.map((label, k) => curve(by(`c${n}-${k}`), label));
    const texts = Array.from({ length: spec.texts }, (_, k) => by(`t${n}-${k}`)).filter(Boolean);
    let x = [0, 1], y = [0, 1]; // what is shown, in shares of the whole axes
    const toX = (u) => left + width * (((u - left) / width - x[0]) / (x[1] - x[0]));
    const toY = (v) => top + height * (1 - (1 - (v - top) / height - y[0]) / (y[1] - y[0]));
    const ofX = (u) => x[0] + ((u - left) / width) * (x[1] - x[0]);
    const ofY = (v) => y[0] + (1 - (v - top) / height) * (y[1] - y[0]);

    function scale(which, limits, shown, most) {
      const group = by(`${which}${n}`), own = group.querySelectorAll(`[id*="${which}tick_"]`), labelled = [...own].some((g) => g.querySelector("text"));
      group.querySelectorAll(".own").forEach((g) => g.remove());
      const whole = shown[0] === 0 && shown[1] === 1;
      own.forEach((g) => (g.style.display = whole ? "" : "none"));
      if (whole) return;
      const made = drawn("g", { class: "own", "font-size": 9 }, group);
      const [a, b] = shown.map((s) => at(limits, s));
      for (const v of ticks(a, b, limits[2], most)) {
        const s = (share(limits, v) - shown[0]) / (shown[1] - shown[0]);
        const [p, q] = [left + width * s, top + height * (1 - s)];
        const line = which === "x" ? { x1: p, x2: p, y1: top, y2: top + height } : { x1: left, x2: left + width, y1: q, y2: q };
        drawn("line", { ...line, stroke: "var(--grid)", "stroke-width": 0.6 }, made);
        if (!labelled) continue;
        const place = which === "x" ? { x: p, y: top + height + 12, "text-anchor": "middle" } : { x: left - 6, y: q + 3, "text-anchor": "end" };
        drawn("text", place, made).textContent = words(v, 6);
      }
    }

    const zoomed = () => x[0] > 0 || x[1] < 1 || y[0] > 0 || y[1] < 1;
    function draw() {
      curves.forEach((c) => c.write(zoomed(), toX, toY));
      scale("x", spec.x, x, 8);
      scale("y", spec.y, y, 4);
      for (const t of texts) {
        t.removeAttribute("transform");
        const from = t.getBBox().x, to = toX(from);
        t.setAttribute("transform", `translate(${to - from} 0)`);
        t.style.display = to < left - 1 || to > left + width ? "none" : "";
      }
    }

    return {
      svg, spec, key: JSON.stringify(spec.x), draw,
      show(nx, ny) {
        if (nx) x = nx;
        if (ny) y = ny;
        draw();
      },
      view: () => [x, y],
      zoomed,
      inside: (p) => p.x >= left && p.x <= left + width && p.y >= top && p.y <= top + height,
      shares: (p, q) => [[ofX(p.x), ofX(q.x)], [ofY(p.y), ofY(q.y)]].map((r) => r.sort((a, b) => a - b).map((s) => Math.min(1, Math.max(0, s)))),
      /** What is at a point: its abscissa, and a row for each curve. */
      read(p) {
        const full = left + width * ofX(p.x), rows = [];
        for (const c of curves) {
          const found = c.label && c.over(full);
          if (!found) continue;
          const values = found.map((v) => at(spec.y, 1 - (v - top) / height)).reverse();
          const shown = c.area ? values : values.slice(0, 1);
          rows.push({ label: c.label, colour: c.colour(), text: `${shown.map((v) => words(v, 3)).join(" … ")} ${spec.units[1]}`, y: c.area ? [] : [toY(found[0])] });
        }
        return { title: `${words(at(spec.x, ofX(p.x)), 4)} ${spec.units[0]}`, rows, top, bottom: top + height };
      },
    };
  }

  const charts = [];
  for (const svg of document.querySelectorAll("svg[data-live]")) {
    const { name, axes } = JSON.parse(svg.dataset.live);
    const own = axes.map((spec, n) => chart(svg, name, spec, n));
    charts.push(...own);
    controlled(svg, own);
  }

  /** The window of time or frequency is one for all figures that span the same. */
  function zoom(chart_, x, y) {
    for (const c of charts) {
      if (c === chart_) c.show(x, y);
      else if (x && c.key === chart_.key) c.show(x, null);
    }
    document.querySelectorAll(".tools").forEach((t) => t.dispatchEvent(new Event("zoomed")));
  }

  function scaled(c, factor, by) {
    const [x] = c.view(), width = Math.min(1, Math.max(CLOSEST, (x[1] - x[0]) * factor));
    const first = Math.min(1 - width, Math.max(0, (x[0] + x[1] - width) / 2 + by * width));
    zoom(c, [first, first + width], null);
  }

  function controlled(svg, own) {
    const tools = element("div", "tools", "", svg.parentNode);
    svg.after(tools);
    const button = (text, label, act) => {
      const made = element("button", "", text, tools);
      made.type = "button";
      made.setAttribute("aria-label", label);
      made.onclick = act;
    };
    button("+", "Zoom in", () => scaled(own[0], 1 / 1.6, 0));
    button("−", "Zoom out", () => scaled(own[0], 1.6, 0));
    button("‹", "Earlier or lower", () => scaled(own[0], 1, -0.5));
    button("›", "Later or higher", () => scaled(own[0], 1, 0.5));
    button("all", "Show all of it", () => own.forEach((c) => zoom(c, [0, 1], [0, 1])));
    const hint = element("span", "hint", "", tools);
    const said = () => (hint.textContent = own.some((c) => c.zoomed()) ? "double click: all" : "drag in the figure to zoom");
    tools.addEventListener("zoomed", said);
    said();
    pointed(svg, own);
  }

  const tip = element("div", "tip", "", document.body);
  tip.hidden = true;

  function pointed(svg, own) {
    let marks = null, from = null, brush = null;
    const place = (e) => new DOMPoint(e.clientX, e.clientY).matrixTransform(svg.getScreenCTM().inverse());
    const away = () => {
      tip.hidden = true;
      if (marks) marks.remove();
      marks = null;
    };
    function show(c, p, e) {
      const found = c.read(p);
      away();
      marks = drawn("g", { "pointer-events": "none" }, svg);
      drawn("line", { class: "hair", x1: p.x, x2: p.x, y1: found.top, y2: found.bottom }, marks);
      tip.replaceChildren();
      element("b", "", found.title, tip);
      for (const row of found.rows) {
        const line = element("div", "", "", tip);
        element("i", "", "", line).style.setProperty("--own", row.colour);
        line.append(`${row.label} ${row.text}`);
        for (const y of row.y) if (y >= found.top && y <= found.bottom) drawn("circle", { class: "dot", cx: p.x, cy: y, r: 2.4, fill: row.colour }, marks);
      }
      tip.hidden = false;
      const right = e.clientX + 16 + tip.offsetWidth > innerWidth;
      tip.style.left = `${right ? e.clientX - 16 - tip.offsetWidth : e.clientX + 16}px`;
      tip.style.top = `${Math.min(e.clientY + 12, innerHeight - tip.offsetHeight - 4)}px`;
    }
    svg.addEventListener("pointermove", (e) => {
      const p = place(e);
      if (from) {
        const [x, y] = [Math.min(p.x, from.p.x), Math.min(p.y, from.p.y)];
        const [w, h] = [Math.abs(p.x - from.p.x), Math.abs(p.y - from.p.y)];
        const [left, top, width, height] = from.c.spec.box;
        if (!brush && Math.hypot(w, h) > 4) brush = drawn("rect", { class: "brush" }, svg);
        // a level drag is meant along the abscissa alone, an upright one along the ordinate alone
        const box = h < 10 ? { x, width: w, y: top, height } : w < 10 ? { x: left, width, y, height: h } : { x, width: w, y, height: h };
        if (brush) for (const [k, v] of Object.entries(box)) brush.setAttribute(k, v);
        return away();
      }
      const c = own.find((o) => o.inside(p));
      if (c) show(c, p, e);
      else away();
    });
    svg.addEventListener("pointerleave", away);
    svg.addEventListener("pointerdown", (e) => {
      const p = place(e), c = own.find((o) => o.inside(p));
      if (!c || e.button) return;
      from = { p, c };
      svg.setPointerCapture(e.pointerId);
      e.preventDefault();
    });
    const done = (e, keep) => {
      if (from && brush && keep) {
        const p = place(e), [x, y] = from.c.shares(from.p, p);
        const flat = Math.abs(p.y - from.p.y) < 10, steep = Math.abs(p.x - from.p.x) < 10;
        if (!(flat && steep)) zoom(from.c, steep || x[1] - x[0] < CLOSEST ? null : x, flat || y[1] - y[0] < CLOSEST ? null : y);
      }
      if (brush) brush.remove();
      from = brush = null;
    };
    svg.addEventListener("pointerup", (e) => done(e, true));
    svg.addEventListener("pointercancel", (e) => done(e, false));
    svg.addEventListener("dblclick", () => own.forEach((c) => zoom(c, [0, 1], [0, 1])));
  }

  // what is too wide for the page can be moved by keyboard
  const reachable = () => document.querySelectorAll(".wide, figure").forEach((box) => {
    if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
    else box.removeAttribute("tabindex");
  });
  addEventListener("resize", reachable);
  reachable();

  const scheme = element("button", "scheme", "", document.querySelector("header"));
  const dark = () => (document.documentElement.style.colorScheme || (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light")) === "dark";
  const named = () => (scheme.textContent = dark() ? "light" : "dark");
  scheme.type = "button";
  scheme.setAttribute("aria-label", "Light or dark");
  scheme.onclick = () => {
    document.documentElement.style.colorScheme = dark() ? "light" : "dark";
    named();
  };
  named();
  document.documentElement.dataset.ready = "yes";
})();
