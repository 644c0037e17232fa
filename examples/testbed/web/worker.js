// SPDX-License-Identifier: MIT
// The simulation, in a thread of its own so that the page always reacts. It computes only when the page
// asks for a frame. A hidden tab asks for none, so the simulation rests and no time piles up.
import { Program } from "./program.js";

let program = null;
let generation = 0; // of the scene: the page drops frames of an earlier scene
let loaded = false;
let scene = 0, shape = 0, version = 0; // what is loaded; version of its list of grains
const values = {}; // of the settings

const post = (message, transfer = []) => self.postMessage({ generation, ...message }, transfer);
/** Answers with the text of an exception, which stops the clock. */
function attempt(action) {
  try {
    action();
    return true;
  } catch (error) {
    post({ type: "error", text: error.message });
    return false;
  }
}

/** Copies into an array that the page has sent back, or into a new one if it is too small. */
function copyInto(array, source) {
  const Type = source.constructor;
  if (!array || array.length < source.length) array = new Type(Math.ceil(source.length * 1.5) + 64);
  array.set(source);
  return array;
}

/** Says what the scene consists of. `kept`: the same scene with other grains. */
function sendScene(kept = false) {
  loaded = true;
  version = program.get("version");
  post({
    type: "scene", scene, shape, kept, values: { ...values },
    shapes: program.shapes(), ground: program.ground(),
    description: JSON.parse(program.text(program.get("describe_scene"))),
  });
}
/** In space a scene with the usual sample begins packed: the page has its state. */
async function packedState() {
  const { scenes, shapes, settings } = program.tables;
  if (shapes[shape].dimension !== 3) return null;
  if (settings.some(({ key, value, rebuilds }) => rebuilds && values[key] !== value)) return null;
  if (shapes[shape].key === "concave_polyhedron") return null; // 16 MB
  const answer = await fetch(new URL(`packed/${scenes[scene].key}-${shapes[shape].key}.state`, self.location));
  return answer.ok ? new Uint8Array(await answer.arrayBuffer()) : null;
}
function applyValues() {
  program.tables.settings.forEach(({ key, rebuilds }, k) => {
    if (!rebuilds) program.call("set", k, values[key]);
  });
}
const scenesThatSettle = ["box", "column", "drum"];

function sendFrame(arrays, spent, steps) {
  if (!attempt(() => program.call("frame"))) return;
  if (program.get("version") !== version) {
    ++generation;
    sendScene(true);
  }
  const sizes = [];
  for (let k = 0; k < 4; ++k) {
    const source = program.floats(program.get("buffer", k), program.get("buffer_size", k));
    sizes.push(source.length);
    arrays[k] = copyInto(arrays[k], source);
  }
  const rows = new Float64Array(program.memory.buffer, program.get("samples"), program.get("samples_size"));
  sizes.push(rows.length);
  arrays[4] = copyInto(arrays[4], rows);
  program.get("clear_samples");
  post(
    {
      type: "frame", arrays, sizes, spent, steps,
      status: {
        time: program.get("time"),
        points: program.get("points"),
        capped: program.get("capped"),
        hand: program.get("hand"),
        canAct: program.get("can_act") !== 0,
        stage: program.text(program.get("stage")),
        advice: program.text(program.get("advice")),
        fault: program.text(program.get("fault")),
        mass: program.get("mass"),
        hash: program.text(program.get("hash")),
        ms: program.tables.stages.map((_, k) => program.get("ms", k)),
        pathsFrom: program.get("paths_from"),
        bounds: [0, 1, 2, 3, 4, 5].map((k) => program.get("bound", k)),
        heap: program.get("heap_used"),
        memory: program.memory.buffer.byteLength,
      },
    },
    arrays.map((array) => array.buffer),
  );
}

const handlers = {
  async init({ url }) {
    try {
      const answer = await fetch(url);
      if (!answer.ok) throw new Error(`${url}: ${answer.status} ${answer.statusText}`);
      program = await Program.from(await answer.arrayBuffer());
      for (const { key, value } of program.tables.settings) values[key] = value;
      post({ type: "tables", tables: program.tables });
    } catch (error) {
      post({ type: "fatal", text: `The simulation could not be loaded: ${error.message}` });
    }
  },
  async load(wanted) {
    const before = [scene, shape];
    [scene, shape] = [wanted.scene, wanted.shape];
    const state = scenesThatSettle.includes(program.tables.scenes[scene].key) ? await packedState().catch(() => null) : null;
    let done = false;
    if (state) {
      try {
        await program.restore(state);
        applyValues();
        done = true;
      } catch {
        // It is built from nothing then.
      }
    }
    if (!done && !attempt(() => program.call("load", scene, shape))) {
      [scene, shape] = before;
      return;
    }
    ++generation;
    sendScene();
  },
  add() {
    if (loaded) attempt(() => program.call("add"));
  },
  remove({ grain }) {
    if (loaded) attempt(() => program.call("remove", grain));
  },
  throw({ x, y, z }) {
    if (loaded) attempt(() => program.call("throw", x, y, z));
  },
  async save() {
    if (!loaded) return;
    const { scenes, shapes } = program.tables;
    const bytes = await program.save({ scene: scenes[scene].key, shape: shapes[shape].key, values });
    post({ type: "saved", bytes, name: `${scenes[scene].key}-${shapes[shape].key}-${program.text(program.get("hash"))}.state` }, [bytes.buffer]);
  },
  async open({ bytes }) {
    try {
      const header = await program.restore(new Uint8Array(bytes));
      Object.assign(values, header.values);
      scene = program.indexOf("scenes", header.scene);
      shape = program.indexOf("shapes", header.shape);
      ++generation;
      sendScene();
    } catch (error) {
      post({ type: "error", text: `The state was not loaded: ${error.message}.` });
    }
  },
  set({ index, value, rebuild }) {
    let refused = "";
    try {
      program.call("set", index, value);
      values[program.tables.settings[index].key] = value;
    } catch (error) {
      refused = error.message;
    }
    post({ type: "set", index, value, refused, rebuild });
  },
  /** At most `duration` of simulated time, and at most `budget` ms of work, but one step at least. */
  frame({ arrays, duration, budget, step }) {
    if (!loaded) return;
    const start = performance.now();
    let steps = 0;
    if (duration > 0) {
      const most = Math.max(1, Math.round(duration / step));
      do {
        if (!attempt(() => program.call("step"))) break;
        ++steps;
      } while (steps < most && performance.now() - start < budget);
    }
    sendFrame(arrays, performance.now() - start, steps);
  },
  act() {
    if (loaded) attempt(() => program.call("act"));
  },
  pull({ grain, x, y, z }) {
    if (loaded) attempt(() => program.call("pull", grain, x, y, z));
  },
  release() {
    if (loaded) program.get("release");
  },
  /** Steps without frames, for tests and measurements: answers with the rows of all steps. */
  run({ steps }) {
    const start = performance.now();
    const done = attempt(() => {
      for (let k = 0; k < steps; ++k) program.call("step");
    });
    const spent = performance.now() - start;
    post({ type: "run", rows: program.takeSamples(), spent, done });
  },
};

// One after the other, although some wait for a file.
let queue = Promise.resolve();
self.onmessage = ({ data }) => (queue = queue.then(() => handlers[data.type](data)));
