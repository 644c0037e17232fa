// SPDX-License-Identifier: MIT
// The WebAssembly program (exports.cpp) as an object: the functions that it imports, its texts and its
// buffers. Used by the worker, and by tests under Node.

/** A program whose memory grows must not be read through an old view: views are made for each reading. */
export class Program {
  /** @param bytes of testbed.wasm */
  static async from(bytes) {
    const program = new Program();
    const { instance } = await WebAssembly.instantiate(bytes, program.imports());
    program.calls = instance.exports;
    program.memory = instance.exports.memory;
    instance.exports._initialize();
    program.tables = JSON.parse(program.text(program.calls.testbed_describe()));
    return program;
  }

  imports() {
    const none = () => 0;
    return {
      env: { emscripten_notify_memory_growth: none },
      wasi_snapshot_preview1: {
        // Nanoseconds into 64 bits at `to`.
        clock_time_get: (clock, precision, to) => {
          const now = BigInt(Math.round(performance.now() * 1e6));
          new DataView(this.memory.buffer).setBigUint64(to, now, true);
          return 0;
        },
        environ_sizes_get: (count, size) => {
          const view = new DataView(this.memory.buffer);
          view.setUint32(count, 0, true);
          view.setUint32(size, 0, true);
          return 0;
        },
        environ_get: none,
        proc_exit: (code) => {
          throw new Error(`the program ended with status ${code}`);
        },
      },
    };
  }

  /** The text at a pointer. */
  text(at) {
    const bytes = new Uint8Array(this.memory.buffer);
    let end = at;
    while (bytes[end] !== 0) ++end;
    return new TextDecoder().decode(bytes.slice(at, end));
  }
  floats(at, count) {
    return new Float32Array(this.memory.buffer, at, count);
  }
  /** Calls a function that returns 1 if it fails; throws the text of the C++ exception. */
  call(name, ...values) {
    if (this.calls[`testbed_${name}`](...values) !== 0)
      throw new Error(this.text(this.calls.testbed_error()));
  }
  get(name, ...values) {
    return this.calls[`testbed_${name}`](...values);
  }

  /** The rows of the steps since the last call, as one array; they are removed. */
  takeSamples() {
    const rows = new Float64Array(this.memory.buffer, this.get("samples"), this.get("samples_size")).slice();
    this.get("clear_samples");
    return rows;
  }
  /** Meshes and placements of the grains. */
  shapes() {
    const meshes = [];
    for (let k = 0; k < this.get("mesh_count"); ++k)
      meshes.push({
        isRound: this.get("mesh_is_round", k) !== 0,
        triangles: this.floats(this.get("triangles", k), this.get("triangles_size", k)).slice(),
        outline: this.floats(this.get("outline", k), this.get("outline_size", k)).slice(),
      });
    const count = this.get("grain_count"), at = this.get("placements");
    const mesh = new Uint32Array(count), scale = new Float32Array(count);
    const view = new DataView(this.memory.buffer);
    for (let k = 0; k < count; ++k) {
      mesh[k] = view.getUint32(at + 8 * k, true);
      scale[k] = view.getFloat32(at + 8 * k + 4, true);
    }
    return { meshes, mesh, scale };
  }
  indexOf(table, key) {
    return this.tables[table].findIndex((entry) => entry.key === key);
  }
}
