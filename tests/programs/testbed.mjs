// SPDX-License-Identifier: MIT
// Drives the page of the testbed in Chromium, as its user does. testbed.sh prepares it:
//
//   node testbed.mjs PAGE CHROMIUM MINUTES [NATIVE]
//
// PAGE is the folder that build.sh wrote, NATIVE the program testbed built with libc++. Prints what fails and what
// it measures; the status is the number of failures.
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import http from "node:http";
import os from "node:os";
import path from "node:path";
import puppeteer from "puppeteer-core";

const [folder, chromium, minutes, native] = process.argv.slice(2);
let failures = 0;
const check = (good, text) => {
  if (good) return;
  ++failures;
  console.log(`FAILED: ${text}`);
};
const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };
const server = http.createServer((request, response) => {
  const file = path.join(folder, request.url === "/" ? "index.html" : path.normalize(request.url));
  if (!fs.existsSync(file)) return response.writeHead(404).end();
  response.writeHead(200, { "content-type": types[path.extname(file)] ?? "application/octet-stream" });
  response.end(fs.readFileSync(file));
});
await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
const address = `http://127.0.0.1:${server.address().port}/`;

// Software drawing: no graphics card is needed.
const browser = await puppeteer.launch({
  executablePath: chromium, headless: true, protocolTimeout: 600000,
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});

try {
  const page = await browser.newPage();
  page.on("console", (message) => check(!["error", "warn"].includes(message.type()), `console: ${message.text()}`));
  page.on("pageerror", (error) => check(false, `page: ${error.message}`));
  page.on("request", (request) =>
    check(request.url().startsWith(address) || /^(data|blob):/.test(request.url()), `asks for ${request.url()}`));
  page.on("response", (answer) => check(answer.status() < 400, `${answer.url()}: ${answer.status()}`));
  await page.setViewport({ width: 1300, height: 820 });
  await page.goto(address);
  await page.waitForFunction("window.testbed?.isReady()", { timeout: 60000 });

  // The page begins in the plane.
  check(await page.evaluate(() => testbed.state.dimension === 2), "the page does not begin in the plane");

  const bytes = fs.readdirSync(folder).reduce((sum, name) => sum + fs.statSync(path.join(folder, name)).size, 0);
  console.log(`the page has ${(bytes / 1e6).toFixed(2)} MB`);
  check(bytes < 3e6, `${bytes} bytes are more than 3 MB`);

  const tables = await page.evaluate(() => testbed.tables());
  /** Loads a scene and waits until it is there; its clock stands still. */
  async function load(scene, shape, values = {}) {
    const before = await page.evaluate(() => testbed.generation());
    await page.evaluate((...all) => {
      testbed.play(false);
      testbed.load(...all);
    }, scene, shape, values);
    await page.waitForFunction((last) => testbed.generation() > last, { timeout: 60000 }, before);
  }
  /** Steps without frames: the rows of all steps, and the time [ms]. */
  const run = (steps) =>
    page.evaluate(async (count) => {
      const { rows, spent, done } = await testbed.run(count);
      return { rows: Array.from(rows), spent, done, width: testbed.plots.channels.length, error: testbed.error() };
    }, steps);
  /** Share of the pixels of the picture that are not background, and number of colours. */
  const look = async () => {
    await sleep(400);
    return page.evaluate(() => {
      testbed.view.render();
      const copy = document.createElement("canvas");
      copy.width = 160, copy.height = 120;
      const context = copy.getContext("2d");
      context.drawImage(document.getElementById("canvas"), 0, 0, copy.width, copy.height);
      const { data } = context.getImageData(0, 0, copy.width, copy.height);
      const colours = new Map();
      for (let k = 0; k < data.length; k += 4) {
        const colour = (data[k] << 16) | (data[k + 1] << 8) | data[k + 2];
        colours.set(colour, (colours.get(colour) ?? 0) + 1);
      }
      return { share: 1 - Math.max(...colours.values()) / (data.length / 4), colours: colours.size };
    });
  };
  const error = () => page.evaluate(() => testbed.error());

  // Every scene and shape: 200 steps, numbers, no error, a picture.
  for (const { key: scene } of tables.scenes)
    for (const { key: shape } of tables.shapes) {
      await load(scene, shape, { grains: 80 });
      const { rows, done, width, error: text } = await run(200);
      check(done && text === "", `${scene} ${shape}: ${text}`);
      check(rows.length === 200 * width && rows.every(Number.isFinite), `${scene} ${shape}: ${rows.length} numbers`);
      const { share, colours } = await look();
      check(share > 0.02 && colours > 20, `${scene} ${shape}: blank picture (${share}, ${colours} colours)`);
    }
  console.log("200 steps of each scene and shape");

  // The wall's position against a native run: bits differ, because sine, cosine and power of the two mathematical
  // libraries differ in the last bit.
  if (native) {
    let worst = 0;
    for (const { key: shape } of tables.shapes) {
      const values = { packing: 0, grains: 120, seed: 3, step: 5e-4 };
      await load("box", shape, values);
      const { rows, width } = await run(100);
      const pairs = Object.entries(values).map(([key, value]) => `${key}=${value}`);
      const lines = execFileSync(native, ["box", shape, "100", ...pairs], { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] })
        .trim().split("\n").slice(1).map((line) => line.split(",").map(Number));
      let difference = 0;
      lines.forEach((line, k) => (difference = Math.max(difference, Math.abs(line[1] - rows[k * width + 1]))));
      const moved = Math.abs(lines.at(-1)[1]);
      check(moved > 1e-4, `box ${shape}: the wall moved by ${moved} m only`);
      check(lines.length === 100 && difference < 1e-6, `box ${shape}: the wall differs by ${difference} m`);
      worst = Math.max(worst, difference);
    }
    console.log(`position of the wall over 100 steps: ${worst.toExponential(1)} m from the native run at most`);
  }

  // The keys work after a click on a button.
  await page.click("#camera");
  const wasPlaying = await page.evaluate(() => testbed.state.playing);
  await page.keyboard.press("Space");
  check((await page.evaluate(() => testbed.state.playing)) !== wasPlaying, "after a click the space key does not play or pause");

  // Values that the library refuses, and what is not a number at all: the text is shown, the scene goes on.
  await load("box", "polygon", { grains: 80 });
  for (const [key, value, expected] of [
    ["friction", "-1", /Friction μ = -1 must/], ["step", "0", /Time step h = 0 must/], ["grains", "1e9", /Grains = 1e\+09 must/],
    ["fmax", "-5", /Largest force fmax = -5 must/], ["gravity", "pull", /Gravity g: »pull« is not a number/],
    ["wall_mass", "", /Wall mass \/ grains: »« is not a number/], ["seed", "1.5", /Seed = 1.5 must/],
  ]) {
    const before = await page.evaluate((name) => testbed.state.values[name], key);
    await page.evaluate((name, text) => {
      const input = document.getElementById(`setting-${name}`);
      input.value = text;
      input.dispatchEvent(new Event("change"));
    }, key, value);
    await page.waitForFunction((text) => new RegExp(text).test(testbed.error()), { timeout: 5000 }, expected.source)
      .catch(async () => check(false, `${key} = ${value}: the page says '${await error()}'`));
    check((await page.evaluate((name) => testbed.state.values[name], key)) === before, `${key}: not the old value`);
    check((await run(5)).done, `${key} = ${value}: the scene has stopped`);
    await page.evaluate(() => document.getElementById("closeError").click());
  }
  // Extremes of every slider.
  for (const { key, low, high, scenes, whole } of tables.settings)
    for (const value of [low, high]) {
      if (key === "grains" && value === high) continue;
      const scene = tables.scenes[Math.log2(scenes & -scenes)].key;
      await load(scene, "disk", { grains: 40, [key]: value });
      const { done, error: text } = await run(60);
      check(done && text === "", `${scene} disk ${key} = ${value}: ${text}`);
    }
  console.log("bad values and the ends of the sliders");

  // The default scenes in space begin packed, run at a tenth of real time or better, and say nothing about themselves.
  for (const [scene, stage] of [["box", "the wall is free"], ["column", "the grains settle behind the gate"], ["drum", "the drum turns"]])
    for (const shape of ["polyhedron", "ball"]) {
      await load(scene, shape);
      await page.evaluate(() => testbed.refresh());
      await sleep(600);
      check(await page.evaluate(() => testbed.memory().time > 0), `${scene} ${shape}: does not begin packed`);
      const text = await page.evaluate(() => testbed.memory().stage);
      check(text === stage, `${scene} ${shape}: begins with "${text}"`);
      let speed = 0;
      for (let k = 0; k < 6; ++k) speed = Math.max(speed, 50 / (await run(50)).spent);
      await page.evaluate(() => testbed.refresh());
      await sleep(500);
      const advice = await page.evaluate(() => testbed.memory().advice);
      const factor = speed * 1000 * (await page.evaluate(() => testbed.state.values.step));
      console.log(`${scene} ${shape}: ${factor.toFixed(2)} of real time${advice ? `, "${advice}"` : ""}`);
      check(advice === "", `${scene} ${shape}: ${advice}`);
      if (os.loadavg()[0] <= os.cpus().length) check(factor >= 0.1, `${scene} ${shape}: ${factor} of real time`);
    }

  // A state that is saved and loaded has its hash, and goes on with the same numbers; a damaged one is refused.
  for (const [scene, shape] of [["drum", "polygon"], ["column", "concave_polyhedron"], ["arch", "polyhedron"]]) {
    await load(scene, shape, { grains: 60 });
    await run(100);
    await page.evaluate(() => testbed.save());
    await page.waitForFunction("testbed.saved()", { timeout: 20000 });
    const first = (await run(50)).rows;
    const hashOf = async () => {
      await page.evaluate(() => {
        window.before = testbed.memory();
        testbed.refresh();
      });
      await page.waitForFunction("testbed.memory() !== window.before", { timeout: 20000 });
      return page.evaluate(() => testbed.hash());
    };
    const hash = await hashOf();
    await load("box", "disk", { grains: 30 });
    const before = await page.evaluate(() => testbed.generation());
    await page.evaluate(() => testbed.open(testbed.saved()));
    await page.waitForFunction((last) => testbed.generation() > last, { timeout: 20000 }, before);
    check(await page.evaluate((key) => testbed.tables().scenes[testbed.state.scene].key === key, scene), `${scene}: the page shows another scene`);
    check(await page.evaluate(() => testbed.state.values.grains === 60), `${scene}: the page shows other settings`);
    const again = (await run(50)).rows;
    check(first.length > 0 && first.length === again.length && first.every((x, k) => x === again[k]), `${scene} ${shape}: other numbers after loading`);
    check((await hashOf()) === hash, `${scene} ${shape}: another hash after loading`);
    await page.evaluate(() => testbed.open(testbed.saved().slice(0, 5000)));
    await page.waitForFunction(() => /was not loaded/.test(testbed.error()), { timeout: 5000 })
      .catch(() => check(false, `${scene}: half a state is not refused`));
    check((await run(5)).done, `${scene}: the scene has stopped`);
  }
  console.log("states saved and loaded");

  // Grains are added and removed, and the one that a drag lets go flies on.
  await load("plate", "polyhedron", { grains: 40 });
  const count = () => page.evaluate(() => testbed.view.count);
  const changes = async (name, by) => {
    const was = await count();
    await page.evaluate((type) => (testbed.send({ type, grain: 3 }), testbed.refresh()), name);
    await page.waitForFunction((wanted) => testbed.view.count === wanted, { timeout: 5000 }, was + by)
      .catch(async () => check(false, `${name}: ${was} grains become ${await count()}; ${await error()}`));
  };
  await changes("add", 1);
  await changes("remove", -1);
  check((await run(50)).done, "no steps after adding and removing");
  await load("arch", "polygon");
  await page.evaluate(() => (testbed.send({ type: "remove", grain: 3 }), testbed.refresh()));
  await page.waitForFunction(() => /does not need/.test(testbed.error()), { timeout: 5000 })
    .catch(() => check(false, "a block that the arch needs is removed"));
  for (const name of ["contacts", "normals", "boxes"]) await page.evaluate((id) => document.getElementById(id).click(), name);
  check((await look()).colours > 20, "blank with contacts, normals and boxes");
  check(/show=chains%2Ccontacts%2Cnormals%2Cboxes/.test(await page.evaluate(() => location.hash)), "the address does not keep what is shown");
  for (const name of ["contacts", "normals", "boxes"]) await page.evaluate((id) => document.getElementById(id).click(), name);

  // Sizes of the window.
  await load("drum", "ball", { grains: 60 });
  await page.evaluate(() => testbed.play(true));
  for (const [width, height] of [[400, 700], [160, 120], [900, 500], [1300, 820]]) {
    await page.setViewport({ width, height });
    await sleep(500);
  }
  check((await look()).colours > 20, "blank after resizing");

  // A grain that is pulled by the pointer moves. The one in front of the middle of the arch is the keystone.
  await load("arch", "polygon");
  await page.evaluate(() => testbed.play(true));
  await sleep(1500);
  const keystone = () =>
    page.evaluate(() => {
      const { view } = testbed, grain = 6, centre = view.centreOf(grain);
      const height = centre.z;
      const at = centre.project(view.camera), frame = document.getElementById("canvas").getBoundingClientRect();
      return { height, x: frame.left + ((at.x + 1) / 2) * frame.width, y: frame.top + ((1 - at.y) / 2) * frame.height };
    });
  const start = await keystone();
  await page.mouse.move(start.x, start.y);
  await page.mouse.down();
  await page.mouse.move(start.x, start.y - 80, { steps: 5 });
  await sleep(2500);
  const pulled = await keystone();
  await page.mouse.up();
  check(pulled.height > start.height + 0.02, `the keystone moved by ${pulled.height - start.height} m`);

  // In a hidden tab the simulation rests; afterwards it goes on without making up for the time.
  await load("drum", "disk", { grains: 60 });
  await page.evaluate(() => testbed.play(true));
  await sleep(1000);
  const other = await browser.newPage();
  await other.bringToFront();
  await sleep(500);
  const hidden = await page.evaluate(() => [document.visibilityState, testbed.memory().time]);
  await sleep(3000);
  const later = await page.evaluate(() => testbed.memory().time);
  await page.bringToFront();
  await sleep(500);
  const shown = await page.evaluate(() => testbed.memory().time);
  await other.close();
  if (hidden[0] === "hidden") check(later - hidden[1] < 0.1, `hidden, the clock went on by ${later - hidden[1]} s`);
  check(shown > later && shown - later < 1.2, `after 3 s hidden the clock jumped by ${shown - later} s`);
  console.log(`tab ${hidden[0]}: ${(later - hidden[1]).toFixed(2)} s passed`);

  // Speed, without drawing, after the start of the scene.
  for (const [shape, grains] of [["polyhedron", 300], ["polygon", 1000]]) {
    await load("box", shape, { grains });
    if (shape === "polygon") await run(900);
    // The best of six: others may use the machine.
    let speed = 0;
    for (let k = 0; k < 6; ++k) speed = Math.max(speed, 50000 / (await run(50)).spent);
    console.log(`${grains} ${shape === "polygon" ? "polygons" : "polyhedra"} in the box: ${speed.toFixed(0)} steps/s`);
    if (os.loadavg()[0] > os.cpus().length) console.log(`not judged: the load of the machine is ${os.loadavg()[0]}`);
    else check(speed >= 30, `${grains} ${shape}: ${speed} steps/s`);
  }

  // Memory: neither the heap of the program nor that of JavaScript grows.
  const client = await page.createCDPSession();
  const sample = async () => {
    await client.send("HeapProfiler.collectGarbage");
    const { metrics } = await client.send("Performance.getMetrics");
    const { heap, memory, time } = await page.evaluate(() => testbed.memory());
    const js = metrics.find(({ name }) => name === "JSHeapUsedSize").value;
    return { heap: heap / 1e6, memory: memory / 1e6, js: js / 1e6, time };
  };
  await client.send("Performance.enable");
  await load("drum", "polyhedron", { grains: 150, drum_speed: 20 });
  await page.evaluate(() => {
    document.getElementById("chains").click();
    document.getElementById("contacts").click();
    testbed.play(true);
  });
  await run(3000);
  await sleep(5000);
  const samples = [await sample()];
  const interval = Math.max(2000, Number(minutes) * 6000);
  for (let k = 0; k < 10; ++k) {
    await sleep(interval);
    samples.push(await sample());
  }
  const line = (s) => `program ${s.heap.toFixed(2)} of ${s.memory.toFixed(0)} MB, JavaScript ${s.js.toFixed(2)} MB`;
  console.log(`memory at t = ${samples[0].time.toFixed(1)} s: ${line(samples[0])}`);
  console.log(`memory at t = ${samples[10].time.toFixed(1)} s: ${line(samples[10])}, after ${((10 * interval) / 60000).toFixed(1)} minutes`);
  check(samples[10].memory === samples[0].memory, "the memory of the program has grown");
  check(samples[10].heap < 1.1 * samples[0].heap, "the heap of the program has grown");
  check(samples[10].js < samples[0].js + 2, "the heap of JavaScript has grown");
} catch (thrown) {
  check(false, thrown.stack);
} finally {
  await browser.close();
  server.close();
}
console.log(failures === 0 ? "all passed" : `${failures} failed`);
process.exitCode = Math.min(failures, 70);
