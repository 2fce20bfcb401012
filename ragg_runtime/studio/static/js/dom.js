// Elements without templates: text stays text, whatever a file or a channel is called.
/** An element: h("p", {class: "note", onclick}, "text", child, [children]). */
export function h(name, attributes = {}, ...children) {
  const [tag, ...classes] = name.split(".");
  const made = document.createElement(tag || "div");
  if (classes.length) made.className = classes.join(" ");
  for (const [key, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (key === "class") made.className = [made.className, value].filter(Boolean).join(" ");
    else if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (key in made && typeof value !== "string") made[key] = value;
    else made.setAttribute(key, value === true ? "" : value);
  }
  append(made, children);
  return made;
}

export function append(to, children) {
  for (const child of children.flat(Infinity)) {
    if (child !== null && child !== undefined && child !== false) to.append(child);
  }
}

export function fill(element, ...children) {
  const made = document.createDocumentFragment();
  append(made, children);
  element.replaceChildren(made);
  return element;
}

/** Sections of a result as the server renders them for all its pages: escaped there, and the page's policy runs no code but its own. */
export const sections = (text) => h("div.sections", {}, ...new DOMParser().parseFromString(text, "text/html").body.childNodes);

/** A panel of the reports as a picture, with a link to its file. */
export function pictureNode(what, values) {
  const source = `/api/panel?${new URLSearchParams({ what, ...values })}`;
  const note = h("p.note", { hidden: true });
  const image = h("img.picture", { src: source, alt: what, onerror: () => fetch(source).then((r) => r.json()).then((e) => { image.hidden = true; note.hidden = false; note.textContent = e.error.what; }) });
  return h("div", {}, image, note);
}

/** A rate: at most five digits, and no zeros at the end. */
export const hertz = (x) => String(Number(x.toPrecision(5)));

/** Three significant digits, a true minus sign. */
export function number(x, digits = 3) {
  if (x === null || x === undefined || Number.isNaN(x)) return "–";
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size >= 1e6 || size < 1e-3) {
    const [m, e] = x.toExponential(digits - 1).split("e");
    return `${m.replace("-", "−")}\u202f×\u202f10${superscript(Number(e))}`;
  }
  const places = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  let text = size.toFixed(places);
  if (size >= 1e4) text = Number(x.toPrecision(digits)).toFixed(0).replace("-", "").replace(/\B(?=(\d{3})+$)/g, "\u202f");
  return (x < 0 ? "−" : "") + text;
}

/** A whole number in groups of three. */
export const counted = (n) => n.toLocaleString("en").replaceAll(",", "\u202f");

const RAISED = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };
export const superscript = (n) => String(n).replace(/./g, (c) => RAISED[c]);

/** Keys of the page, but for what is typed and while a dialog is open; `handle` returns false for those that are not its own. */
export function keys(handle) {
  const heard = (e) => {
    const typing = /^(textarea|select)$/i.test(e.target.tagName) || (e.target.tagName === "INPUT" && e.target.type !== "checkbox");
    if (e.ctrlKey || e.metaKey || e.altKey || typing || document.querySelector("dialog[open]")) return;
    if (handle(e) !== false) e.preventDefault();
  };
  addEventListener("keydown", heard);
  return () => removeEventListener("keydown", heard);
}

/** Runs f once things have been quiet for so long. */
export function calm(f, wait) {
  let timer = 0;
  return (...args) => {
    clearTimeout(timer);
    timer = setTimeout(() => f(...args), wait);
  };
}
