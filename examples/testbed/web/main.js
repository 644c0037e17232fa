// SPDX-License-Identifier: MIT
// The page: controls from the tables of settings.hpp, the clock, the status. The simulation runs in
// worker.js. One frame is under way at a time: the page asks for it when the browser is about to draw.
import "./main.css";
import { Plots } from "./plots.js";
import { View } from "./view.js";
import { scaleGradient } from "./colours.js";

const element = (id) => document.getElementById(id);
const worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
let view = null;
try {
  view = new View(element("canvas"));
} catch (error) {
  element("loading").textContent = `The page cannot draw, because WebGL is not available: ${error.message}`;
  throw error;
}
const plots = new Plots(element("plots"));

let tables = null;
const state = { scene: 0, dimension: 2, label: "angular", playing: true, values: {} };
let generation = -1; // of the scene that is shown
let waiting = false; // for a frame
let arrays = []; // that go to and fro
let latest = null; // a frame that is not drawn yet
let stepOnce = false;
let refresh = false; // a frame without a step
const waitingRuns = [];

// Settings

/** Four digits, as short as possible. */
const short = (x) => (x === 0 ? "0" : Math.abs(x) >= 1e5 || Math.abs(x) < 1e-3 ? Number(x.toPrecision(4)).toExponential() : String(Number(x.toPrecision(4))));

const three = (x) => String(Number(x.toPrecision(3)));

function makeSlider(setting, index) {
  const holder = document.createElement("div");
  holder.className = "slider";
  holder.title = setting.help;
  const id = `setting-${setting.key}`;
  const propose = (value, again) => {
    if (setting.rebuilds && !again) return;
    worker.postMessage({ type: "set", index, value, rebuild: setting.rebuilds === 1 });
  };
  setting.holder = holder;
  if (setting.whole && setting.low === 0 && setting.high === 1) {
    holder.innerHTML = `<label><input type="checkbox" id="${id}"> <span></span></label>`;
    const box = holder.querySelector("input");
    holder.querySelector("span").textContent = setting.label;
    setting.show = (value) => (box.checked = value === 1);
    setting.refuse = () => {};
    box.addEventListener("change", () => propose(box.checked ? 1 : 0, true));
    return holder;
  }
  holder.innerHTML = `<div class="head"><label for="${id}"></label><input type="text" inputmode="decimal" id="${id}"><span></span></div><input type="range">`;
  const [label, number, unit] = holder.firstChild.children, range = holder.lastChild;
  label.textContent = setting.label;
  unit.textContent = setting.unit === "-" ? "" : setting.unit;
  range.setAttribute("aria-label", setting.label);
  const toRange = setting.logarithmic ? Math.log : (x) => x, toValue = setting.logarithmic ? Math.exp : (x) => x;
  range.min = toRange(setting.low);
  range.max = toRange(setting.high);
  range.step = setting.whole && !setting.logarithmic ? 1 : "any";
  setting.show = (value) => {
    number.value = short(value);
    range.value = toRange(Math.max(value, setting.low));
    holder.classList.remove("wrong");
  };
  setting.refuse = () => holder.classList.add("wrong");
  const ofRange = () => {
    const value = toValue(Number(range.value));
    return setting.whole ? Math.round(value) : Number(value.toPrecision(3));
  };
  range.addEventListener("input", () => {
    number.value = short(ofRange());
    propose(ofRange(), false);
  });
  range.addEventListener("change", () => propose(ofRange(), true));
  number.addEventListener("change", () => {
    const text = number.value.trim(), value = text === "" ? NaN : Number(text.replace(",", "."));
    if (!Number.isNaN(value)) return propose(value, true);
    setting.refuse();
    showError(`${setting.label}: »${text}« is not a number.`);
  });
  return holder;
}
function setValue(key, value) {
  const index = tables.settings.findIndex((setting) => setting.key === key);
  worker.postMessage({ type: "set", index, value });
}

function makeChoice(id, entries, current, choose) {
  const holder = element(id);
  holder.replaceChildren(...entries.map(({ label, value }) => {
    const button = document.createElement("button");
    button.textContent = label;
    button.setAttribute("role", "radio");
    button.setAttribute("aria-checked", String(value === current()));
    button.addEventListener("click", () => {
      choose(value);
      for (const other of holder.children) other.setAttribute("aria-checked", String(other === button));
      load();
    });
    return button;
  }));
}

function makeControls() {
  makeChoice("scenes", tables.scenes.map(({ label }, k) => ({ label, value: k })), () => state.scene, (k) => (state.scene = k));
  makeChoice("dimensions", [{ label: "plane", value: 2 }, { label: "space", value: 3 }], () => state.dimension, (d) => (state.dimension = d));
  const labels = [...new Set(tables.shapes.map(({ label }) => label))];
  makeChoice("shapes", labels.map((label) => ({ label, value: label })), () => state.label, (label) => (state.label = label));
  const solver = ["step", "stiffness", "tolerance", "sweeps"];
  for (const holder of ["sliders", "solverSliders"]) element(holder).replaceChildren();
  tables.settings.forEach((setting, k) => {
    element(solver.includes(setting.key) ? "solverSliders" : "sliders").append(makeSlider(setting, k));
    setting.show(state.values[setting.key]);
  });
}

// Scene

const shapeIndex = () => tables.shapes.findIndex((shape) => shape.dimension === state.dimension && shape.label === state.label);
function load() {
  view.letLoose();
  showBuilding();
  adaptDefaults();
  sendLoad();
  describeScene();
  writeAddress();
}
function describeScene() {
  const scene = tables.scenes[state.scene];
  element("tryThis").textContent = scene.tryThis;
  element("action").textContent = scene.action;
  const hasSample = tables.settings.find(({ key }) => key === "seed").scenes & (1 << state.scene);
  element("newSeed").disabled = !hasSample;
  element("hint").textContent = element("touchHint").textContent = state.dimension === 3
    ? "Drag a grain to pull or throw it, double-click to remove it. Drag beside the grains to turn the picture, wheel to zoom."
    : "Drag a grain to pull or throw it, double-click to remove it. Drag beside the grains to move the picture, wheel to zoom.";
  for (const setting of tables.settings) setting.holder.hidden = (setting.scenes & (1 << state.scene)) === 0;
}
/** The default of a setting in the dimension that is shown, or in another. */
function defaultOf(key, dimension = state.dimension) {
  const inSpace = tables.inSpace.find((entry) => entry.key === key);
  return dimension === 3 && inSpace ? inSpace.value : tables.settings.find((entry) => entry.key === key).value;
}
/** After a change of the dimension: what had the default takes the default there. */
function adaptDefaults(given = []) {
  if (adapted === state.dimension) return;
  for (const { key } of tables.inSpace)
    if (!given.includes(key) && state.values[key] === defaultOf(key, adapted)) setValue(key, defaultOf(key));
  adapted = state.dimension;
  // In space grains are opaque until one wants to look into them.
  if (!given.includes("show")) showOption("chains", state.dimension === 2);
}
let adapted = 2;
/** One scene is built at a time. Of the choices made meanwhile only the last is built. */
function sendLoad() {
  wanted = loading;
  if (!loading) worker.postMessage({ type: "load", scene: state.scene, shape: shapeIndex() });
  loading = true;
}
/** After an answer to "load": builds what was chosen meanwhile. Returns whether there is such a choice. */
function loadWanted() {
  loading = false;
  const again = wanted;
  if (again) sendLoad();
  return again;
}
let loading = false, wanted = false, isNew = false; // a scene without a frame
/** Says that the scene is being built, if that takes longer than an eye notices. */
function showBuilding() {
  clearTimeout(building);
  building = setTimeout(() => {
    element("loading").textContent = "Building the scene…";
    element("status").textContent = "";
    element("loading").className = "over";
    element("loading").hidden = false;
  }, 150);
}
function hideBuilding() {
  clearTimeout(building);
  element("loading").hidden = true;
}
let building = 0;
function play(on) {
  state.playing = on;
  element("play").textContent = on ? "Pause" : "Play";
  // A frame without a step shows it in the line below the picture.
  rate.shown = on ? "" : "<span>paused</span>";
  rate.steps = rate.simulated = 0;
  rate.begin = performance.now();
  refresh = true;
}
function showError(text) {
  element("error").hidden = false;
  element("error").firstChild.textContent = text;
}

// Frames

const rate = { real: 0, simulated: 0, steps: 0, shown: "", begin: performance.now() };
let before = performance.now(), interval = 16.7, plotsDrawn = 0;

function tick(now) {
  requestAnimationFrame(tick);
  const passed = now - before;
  before = now;
  if (latest) draw(now);
  else if (view.stale) view.render();
  if (waiting || generation < 0) return;
  if (passed < 1000) interval += 0.1 * (passed - interval);
  // Without a graphics card drawing takes the time of the steps: fewer pixels then.
  if (interval < 80 || !state.playing) slowFrames = 0;
  else if (++slowFrames > 15) {
    view.coarsen();
    slowFrames = 0;
  }
  // A slow machine runs in slow motion: at most the time of one frame is made up for.
  const real = Math.min(passed, 100) / 1000;
  const moves = state.playing || stepOnce;
  const step = state.values.step;
  // What was too short for a step is kept for the next frame.
  rest = Math.min(rest + real, 0.1);
  const duration = stepOnce ? step : rest;
  if (!moves && !refresh) return;
  if (moves && duration < step) return;
  rest = 0;
  waiting = true;
  worker.postMessage(
    { type: "frame", arrays, duration: moves ? duration : 0, step, budget: Math.min(250, Math.max(8, 0.8 * interval)) },
    arrays.map((array) => array.buffer));
  arrays = [];
  stepOnce = refresh = false;
}
let rest = 0, slowFrames = 0;

function draw(now) {
  const { arrays: got, sizes, status, steps } = latest;
  latest = null;
  if (isNew) hideBuilding();
  isNew = false;
  view.setBounds(status.bounds);
  plots.pathsFrom = status.pathsFrom;
  plots.setSpan(tables.scenes[state.scene].key === "box" ? Math.max(3, 5 / state.values.frequency) : 3);
  plots.add(got[4], sizes[4], state.values.step);
  const force = plots.last("f");
  view.update(
    {
      poses: got[0], colours: got[1], walls: got[2], wallCount: sizes[2] / 8, segments: got[3], segmentCount: sizes[3] / 14,
    },
    force === null ? null : { now: force, most: state.values.fmax },
    steps * state.values.step);
  arrays = got;
  view.render();
  // A fault is said once: who goes on nevertheless may look at it.
  if (status.fault && !fault) {
    play(false);
    showError(`Paused, because ${status.fault}: begin anew with a smaller force, a shorter time step or stiffer contacts.`);
  }
  fault = status.fault;
  if (now - plotsDrawn > 90) {
    plotsDrawn = now;
    plots.draw();
  }
  showStatus(status, steps, now);
}

let fault = "";
let saved = null, quietSave = false; // the state that was saved last
let stageTimes = null; // [ms]

/** The speed of the clock as text. */
function speedText(factor) {
  if (factor >= 0.9) return "real time";
  if (factor >= 0.1) return `slow motion: ${factor.toPrecision(2)} × real time`;
  const [value, unit] = factor > 1 / 120 ? [1 / factor, "s"] : factor > 1 / 7200 ? [1 / 60 / factor, "min"] : [1 / 3600 / factor, "h"];
  return `slow motion: 1 s takes ${Number.isFinite(value) ? Number(value.toPrecision(2)) : "very many"} ${unit}`;
}
/** Times of the stages of a step, smoothed, and the hash of the state if the clock stands still. */
function showStages({ ms, hash }, steps) {
  if (steps > 0) stageTimes = stageTimes?.map((mean, k) => mean + 0.1 * (ms[k] - mean)) ?? ms;
  else stageTimes ??= ms;
  const parts = tables.stages.slice(0, -1).map(({ label }, k) => `${label} ${stageTimes[k].toFixed(2)}`);
  element("stages").textContent = `ms per step: ${stageTimes.at(-1).toFixed(2)} (${parts.join(", ")})` +
    (state.playing ? "" : `; hash of the state ${hash}`);
}
function showStatus(status, steps, now) {
  rate.steps += steps;
  rate.simulated += steps * state.values.step;
  rate.real = (now - rate.begin) / 1000;
  if (rate.real > 0.5) {
    const factor = rate.simulated / rate.real;
    rate.shown = state.playing
      ? `<span>${(rate.steps / rate.real).toFixed(0)} steps/s</span><span>${speedText(factor)}</span>`
      : "<span>paused</span>";
    rate.steps = rate.simulated = 0;
    rate.begin = now;
  }
  const last = (key) => plots.last(key);
  const residual = last("residual");
  element("status").innerHTML =
    `<span>${status.stage}</span><span>t = ${status.time.toFixed(state.playing ? 3 : 4)} s</span>${rate.shown}` +
    `<span>${view.count} ${tables.scenes[state.scene].key === "arch" ? "blocks" : "grains"}${state.dimension === 2 ? ", 4 cm thick" : ""}, ` +
    `${three(status.mass)} kg, weight ${three(status.mass * Math.abs(state.values.gravity))} N</span>` +
    `<span>${status.points} contact points</span>` +
    `<span>${residual === null ? "" : `residual ${residual.toExponential(0)}`}</span>` +
    (status.hand > 0 ? `<span class="hand">the hand pulls with ${short(status.hand)} N${status.hand > 0.99 * state.values.hand ? ", its full strength" : ""}</span>` : "") +
    (status.capped > 0 ? `<span>${status.capped} steps not solved to the tolerance</span>` : "");
  showStages(status, steps);
  element("action").disabled = !status.canAct;
  element("advice").textContent = status.advice;
  const colour = view.options.colour;
  element("legend").hidden = colour === "size";
  element("contactLegend").hidden = !view.options.contacts;
  element("chainLegend").hidden = !(view.options.chains && view.fullForce > 0);
  element("drawnLegend").hidden = element("contactLegend").hidden && element("chainLegend").hidden;
  element("chainLegend").textContent = `force chains: full width = ${short(view.fullForce)} N`;
  if (colour !== "size") {
    const [title, unit] = { speed: ["speed", "m/s"], force: ["sum of the normal forces on a grain", "N"], residual: ["residual, as a velocity", "m/s"] }[colour];
    element("legendTitle").textContent = title;
    element("legendMost").textContent = `${Number(view.colourMax.toPrecision(2))} ${unit}`;
  }
  memory = status;
}
let memory = null;

worker.onmessage = ({ data }) => {
  switch (data.type) {
    case "tables":
      tables = data.tables;
      for (const { key, value } of tables.settings) state.values[key] = value;
      readAddress();
      makeControls();
      load();
      break;
    case "scene":
      if (!data.kept && loadWanted()) break;
      generation = data.generation;
      latest = null;
      view.load(data.shapes, data.description, tables.shapes[data.shape].dimension === 3, data.ground);
      refresh = true;
      if (data.kept) break; // the same scene with other grains
      showLoaded(data);
      plots.load(data.description);
      isNew = true;
      fault = "";
      stageTimes = null;
      element("error").hidden = true;
      if (addressFault) showError(addressFault);
      addressFault = "";
      refresh = true;
      break;
    case "frame":
      waiting = false;
      if (data.generation === generation) latest = data;
      else arrays = data.arrays;
      break;
    case "set": {
      const setting = tables.settings[data.index];
      if (!data.refused) {
        state.values[setting.key] = data.value;
        setting.show(data.value);
        writeAddress();
        element("error").hidden = true;
        if (data.rebuild) load();
      } else {
        setting.refuse();
        // "testbed: fmax = -5 must ...": the page has the label of the slider instead of the names of the program.
        showError(data.refused.replace(/^[\w:]+: \w+ = /, `${setting.label} = `));
      }
      break;
    }
    case "saved":
      saved = data;
      if (!quietSave) download(data.bytes, data.name);
      quietSave = false;
      break;
    case "error":
      waiting = false;
      if (!loading || !loadWanted()) hideBuilding();
      showError(data.text);
      if (/Simulation::step/.test(data.text)) play(false);
      break;
    case "run":
      plots.add(data.rows, data.rows.length, state.values.step);
      view.meanForce = view.fullForce = 0;
      refresh = true;
      waitingRuns.shift()?.(data);
      break;
    case "fatal":
      element("loading").textContent = data.text;
  }
};
worker.onerror = (event) => (element("loading").textContent = `The simulation could not be started: ${event.message}`);

/** Takes over scene, shape and values of a state that was loaded from a file. */
function showLoaded({ scene, shape, values }) {
  const { dimension, label } = tables.shapes[shape];
  const other = scene !== state.scene || dimension !== state.dimension || label !== state.label;
  Object.assign(state, { scene, dimension, label });
  Object.assign(state.values, values);
  adapted = dimension;
  if (other) makeControls();
  for (const setting of tables.settings) setting.show(state.values[setting.key]);
  describeScene();
  writeAddress();
}
/** #scene=column&shape=disk&grains=500. What the page does not know is said once the scene is shown. */
function readAddress() {
  const entries = [...new URLSearchParams(location.hash.slice(1))], given = entries.map(([key]) => key);
  for (const [key, value] of entries) {
    const scene = tables.scenes.findIndex((entry) => entry.key === value);
    const shape = tables.shapes.find((entry) => entry.key === value);
    const number = value.trim() === "" ? NaN : Number(value);
    if (key === "scene" && scene >= 0) state.scene = scene;
    else if (key === "shape" && shape) Object.assign(state, { dimension: shape.dimension, label: shape.label });
    else if (key === "show" && value.split(",").every((name) => name === "" || shown.includes(name)))
      for (const name of shown) showOption(name, value.split(",").includes(name));
    else if (key === "colour" && [...element("colour").options].some((option) => option.value === value)) showOption("colour", value);
    else if (tables.settings.some((setting) => setting.key === key) && !Number.isNaN(number)) setValue(key, number);
    else addressFault = `The address has ${key}=${value}, which this page does not know.`;
  }
  adaptDefaults(given);
}
const shown = ["chains", "contacts", "normals", "boxes"];
/** Keeps the scene, the shape, all settings that are not the defaults, and what is shown in the address. */
function writeAddress() {
  const address = new URLSearchParams({ scene: tables.scenes[state.scene].key, shape: tables.shapes[shapeIndex()].key });
  for (const { key } of tables.settings)
    if (state.values[key] !== defaultOf(key)) address.set(key, String(Number(state.values[key].toPrecision(9))));
  const list = shown.filter((name) => view.options[name]).join(",");
  if (list !== (state.dimension === 2 ? "chains" : "")) address.set("show", list);
  if (view.options.colour !== "size") address.set("colour", view.options.colour);
  location.replace(`#${address}`);
}
let addressFault = "";

// Buttons

view.onPull = (grain, { x, y, z }) => {
  worker.postMessage({ type: "pull", grain, x, y, z });
  for (const id of ["hint", "touchHint"]) element(id).classList.add("used");
};
view.onThrow = ({ x, y, z }) => worker.postMessage({ type: "throw", x, y, z });
view.onRelease = () => worker.postMessage({ type: "release" });
const actions = {
  play: () => play(!state.playing),
  step() {
    play(false);
    stepOnce = true;
  },
  reset: () => load(),
  newSeed() {
    setValue("seed", (state.values.seed % 100) + 1);
    load();
  },
  action: () => worker.postMessage({ type: "act" }),
  camera: () => view.frameScene(),
  defaults() {
    for (const { key } of tables.settings) setValue(key, defaultOf(key));
    load();
  },
  add() {
    worker.postMessage({ type: "add" });
    refresh = true;
  },
  save: () => worker.postMessage({ type: "save" }),
  open: () => element("file").click(),
  closeError: () => (element("error").hidden = true),
};
for (const [id, act] of Object.entries(actions)) element(id).addEventListener("click", () => tables && act());
function removeGrain(grain) {
  view.letLoose();
  worker.postMessage({ type: "remove", grain });
  refresh = true;
}
element("canvas").addEventListener("dblclick", (event) => {
  const grain = view.grainAt(event);
  if (grain >= 0) removeGrain(grain);
});
element("file").addEventListener("change", async ({ target }) => {
  const [file] = target.files;
  target.value = "";
  if (!file) return;
  const bytes = await file.arrayBuffer();
  worker.postMessage({ type: "open", bytes }, [bytes]);
});
function download(bytes, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([bytes]));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
const keys = { " ": "play", s: "step", r: "reset", n: "newSeed", c: "camera", a: "add" };
addEventListener("keydown", (event) => {
  const at = document.activeElement;
  if (event.ctrlKey || event.metaKey || event.altKey || at?.matches("input[type=text], select")) return;
  // Who walks over the controls by the Tab key presses them by space.
  if (event.key === " " && at?.matches("button, summary, input")) return;
  const id = keys[event.key];
  if (!id || !tables) return;
  event.preventDefault();
  actions[id]();
});
// A control that was pressed by the pointer does not keep the keys.
addEventListener("click", (event) => {
  const at = document.activeElement;
  if (event.detail > 0 && at?.matches("button, summary, input:not([type=text])")) at.blur();
});
for (const name of shown)
  element(name).addEventListener("change", (event) => {
    showOption(name, event.target.checked);
    writeAddress();
  });
element("colour").addEventListener("change", (event) => {
  showOption("colour", event.target.value);
  writeAddress();
  event.target.blur();
});
function showOption(name, value) {
  view.options[name] = value;
  if (name === "colour") element(name).value = value;
  else element(name).checked = value;
  view.colourMax = 0;
  refresh = true;
}
element("legendBar").style.background = scaleGradient;

// For tests: the page as an object.
window.testbed = {
  state, view, plots, play,
  isReady: () => generation >= 0,
  tables: () => tables,
  memory: () => memory,
  generation: () => generation,
  error: () => (element("error").hidden ? "" : element("error").firstChild.textContent),
  load(scene, shape, values = {}) {
    state.scene = tables.scenes.findIndex((entry) => entry.key === scene);
    const { dimension, label } = tables.shapes.find((entry) => entry.key === shape);
    Object.assign(state, { dimension, label });
    adapted = dimension;
    showOption("chains", dimension === 2);
    for (const { key } of tables.settings) setValue(key, values[key] ?? defaultOf(key));
    makeControls();
    load();
  },
  hash: () => memory.hash,
  refresh: () => (refresh = true),
  /** The bytes of the state. */
  save() {
    quietSave = true;
    saved = null;
    worker.postMessage({ type: "save" });
  },
  saved: () => saved?.bytes,
  open: (bytes) => worker.postMessage({ type: "open", bytes: bytes.slice().buffer }),
  send: (message) => worker.postMessage(message),
  /** Steps without frames. */
  run: (steps) =>
    new Promise((resolve) => {
      waitingRuns.push(resolve);
      worker.postMessage({ type: "run", steps });
    }),
};

worker.postMessage({ type: "init", url: new URL("testbed.wasm", import.meta.url).href });
requestAnimationFrame(tick);
