// The page: tabs, keys, what the server is doing, and which view is open.
//
// Imports go down alone: app -> loop, model, files, take -> effects, figures -> store, api, dom.
//   dom     elements, numbers, sections                    api     what the server is asked; actions, and what went wrong
//   store   what is known (server) and looked at (view)
import { ask, doing, events, Refused, trouble } from "./api.js";
import { filesView } from "./files.js";
import { fill, h, keys } from "./dom.js";
import { historyView, parametersView, sheetView } from "./model.js";
import { known, look, on, recall, server, view } from "./store.js";
import { loopView } from "./loop.js";
import { takeView } from "./take.js";

const VIEWS = [
  ["loop", "Diagnosis", loopView],
  ["parameters", "Parameters", parametersView],
  ["sheet", "Test sheet", sheetView],
  ["history", "History", historyView],
  ["files", "Files", filesView],
  ["take", "Export", takeView],
];
const $ = (id) => document.getElementById(id);
let leave = null;

function tabs() {
  fill($("tabs"), VIEWS.map(([id, name], k) =>
    h("button", { type: "button", "aria-current": view.view === id ? "page" : undefined, onclick: () => look({ view: id }), title: `${name} (${k + 1})` }, name)));
}

function tools() {
  const { state } = server;
  const history = state && state.history;
  fill(
    $("tools"),
    h("button.icon", { type: "button", disabled: !(history && history.can_undo), onclick: () => doing("undo"), title: "Undo (u)", "aria-label": "Undo" }, "↶"),
    h("button.icon", { type: "button", onclick: darker, title: "Light or dark (d)", "aria-label": "Light or dark" }, "◐"),
    h("button.icon", { type: "button", onclick: help, title: "Keys (?)", "aria-label": "Keys" }, "?"),
  );
}

function heading() {
  const { state } = server;
  const flights = state ? state.flights : [];
  fill(
    $("what"),
    state && state.model ? h("strong", {}, state.model.name) : "no model",
    flights.length ? [h("span.times", {}, " with "), flights.length > 1 ? `${flights.length} flights` : flights[0].name] : null,
  );
  document.title = state && state.model ? `${state.model.name} – ragg studio` : "ragg studio";
}

function job(status) {
  const box = $("job");
  const busy = Boolean(status.job);
  box.hidden = !busy;
  document.documentElement.toggleAttribute("data-busy", busy);
  if (!busy) return;
  if (box.dataset.job !== status.job) {
    box.dataset.job = status.job;
    fill(box, h("span.name", {}, status.job), h("progress", { "aria-label": status.job }), h("button.quiet", { type: "button", onclick: () => doing("cancel") }, "Cancel"));
  }
}

function darker() {
  look({ theme: document.documentElement.dataset.theme === "dark" ? "light" : "dark" });
}

function themed() {
  document.documentElement.dataset.theme = view.theme || (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  document.dispatchEvent(new Event("themed"));
}

function opened() {
  if (leave) leave();
  const [, name, open] = VIEWS.find(([id]) => id === view.view) || VIEWS[0];
  const main = $("main");
  main.className = `view-${view.view}`;
  main.setAttribute("aria-label", name);
  leave = open(main);
  scrollTo(0, 0);
  tabs();
}

const KEYS = {
  u: () => doing("undo"),
  d: darker,
  "?": help,
  Escape: () => trouble(null),
  ...Object.fromEntries(VIEWS.map(([id], k) => [String(k + 1), () => look({ view: id })])),
};

keys((e) => (KEYS[e.key] ? void KEYS[e.key]() : false));

let asked = 0;
async function refresh() {
  const mine = ++asked;
  try {
    const state = await ask("state");
    if (mine === asked) known(state);
  } catch (error) {
    if (error instanceof Refused) trouble(error.facts);
  }
}

let last = { job: "", count: -1 };
let lost = false;
function gone() {
  lost = true;
  trouble({ what: "the server does not answer", remedy: "if it was stopped, start it again: ragg studio; nothing is lost" });
}
function changed(status) {
  if (lost) trouble(null);
  lost = false;
  const idle = !status.job;
  job(status);
  if (status.error && idle && last.count !== status.count) trouble(status.error);
  const same = status.revision === last.revision && status.job === last.job;
  last = status;
  if (!same) refresh();
}

recall();
themed();
on("theme", themed);
on("view", opened);
on("server", () => (heading(), tools(), lead()));

// Without a model, or with a file whose columns must be described, the page goes to Files by itself, once, and back.
let led = "";
function lead() {
  const { state } = server;
  if (!state || state.status.job) return;
  const [foreign] = state.status.error ? [] : state.unread;
  const why = foreign || (state.model ? "" : "no model");
  if (why && why !== led && view.view === "loop") look({ view: "files" });
  else if (!why && led === "no model" && view.view === "files") look({ view: "loop" });
  led = why;
}
addEventListener("hashchange", () => recall());
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", themed);
tabs();
tools();
await refresh();
opened();
// A browser keeps few connections to one server: a tab that is not seen must not hold one.
let listening = null;
function listen() {
  if (document.hidden && listening) listening = void listening.close();
  else if (!document.hidden && !listening) {
    listening = events(changed, gone);
  }
}
document.addEventListener("visibilitychange", listen);
listen();
document.documentElement.dataset.ready = "yes";

// The keys, in a dialog.

const HELP = [
  ["1 … 6", "the views, from left to right"],
  ["j, k", "next and previous effect"],
  ["Space", "tick or untick the effect"],
  ["Enter", "on an effect: open or close what is known of it"],
  ["a", "derive and calibrate what is ticked"],
  ["+, −", "zoom in and out"],
  ["[, ]", "move left and right"],
  ["0", "the whole flight"],
  ["f, o", "next flight, next output"],
  ["u", "undo"],
  ["d", "light or dark"],
];

export function help() {
  const box = h(
    "dialog.help", { "aria-label": "Keys", onclose: () => box.remove() },
    h("h2", {}, "Keys"),
    h("table", {}, h("tbody", {}, HELP.map(([key, what]) => h("tr", {}, h("th", { scope: "row" }, h("kbd", {}, key)), h("td", {}, what))))),
    h("form", { method: "dialog" }, h("button", {}, "Close")),
  );
  document.body.append(box);
  box.showModal();
}
