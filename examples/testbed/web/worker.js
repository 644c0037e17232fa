// SPDX-License-Identifier: MIT
// The simulation, in a thread of its own so that the page always reacts. It computes only when the page
// asks for a frame. A hidden tab asks for none, so the simulation rests and no time piles up.
import { Program } from "./program.js";

let program = null;
let generation = 0; // of the scene: the page drops frames of an earlier scene
let loaded = false;

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

function sendFrame(arrays, spent, steps) {
  if (!attempt(() => program.call("frame"))) return;
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
      post({ type: "tables", tables: program.tables });
    } catch (error) {
      post({ type: "fatal", text: `The simulation could not be loaded: ${error.message}` });
    }
  },
  load({ scene, shape }) {
    if (!attempt(() => program.call("load", scene, shape))) return;
    ++generation;
    loaded = true;
    post({
      type: "scene", scene, shape,
      shapes: program.shapes(),
      description: JSON.parse(program.text(program.get("describe_scene"))),
    });
  },
  set({ index, value, rebuild }) {
    let refused = "";
    try {
      program.call("set", index, value);
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

self.onmessage = ({ data }) => handlers[data.type](data);
