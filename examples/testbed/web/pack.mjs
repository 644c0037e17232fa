// SPDX-License-Identifier: MIT
// Lets the scenes in space settle and writes their states, from which the page begins:
//
//   node pack.mjs testbed.wasm FOLDER [scene-shape...]
//
// Concave grains are left out: a state of 300 has 16 MB.
// Each state is one file, which only the testbed.wasm that wrote it can load.
import fs from "node:fs";
import path from "node:path";
import { Program } from "./program.js";

const [wasm, folder, ...only] = process.argv.slice(2);
const bytes = fs.readFileSync(wasm);
fs.mkdirSync(folder, { recursive: true });

/** When a scene has settled, by its stage and its time [s]. */
const settled = {
  box: (stage) => stage === "the wall is free",
  column: (_, time) => time >= 0.65, // the gate opens at 0.7 s
  drum: (_, time) => time >= 1,
};
const { scenes, shapes, settings, inSpace } = (await Program.from(bytes)).tables;
for (const { key: scene } of scenes)
  for (const { key: shape, dimension } of shapes) {
    const name = `${scene}-${shape}`;
    if (dimension !== 3 || shape === "concave_polyhedron" || !settled[scene] || (only.length > 0 && !only.includes(name))) continue;
    const program = await Program.from(bytes), values = {};
    settings.forEach(({ key, value }, k) => {
      values[key] = inSpace.find((entry) => entry.key === key)?.value ?? value;
      program.call("set", k, values[key]);
    });
    program.call("load", program.indexOf("scenes", scene), program.indexOf("shapes", shape));
    const start = performance.now();
    let steps = 0, done = false;
    while (!done && steps < 20000) {
      for (let k = 0; k < 20; ++k, ++steps) program.call("step");
      program.get("clear_samples");
      program.call("frame");
      done = settled[scene](program.text(program.get("stage")), program.get("time"));
    }
    const state = await program.save({ scene, shape, values });
    fs.writeFileSync(path.join(folder, `${name}.state`), state);
    const seconds = (performance.now() - start) / 1000;
    console.log(`${name}: ${steps} steps in ${seconds.toFixed(0)} s, ${(state.length / 1e3).toFixed(0)} kB${done ? "" : ", not settled"}`);
  }
