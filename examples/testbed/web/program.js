// SPDX-License-Identifier: MIT
// The WebAssembly program (exports.cpp) as an object: the functions that it imports, its texts and its
// buffers. Used by the worker, and by tests under Node.

const format = "state of moreau's testbed, 1";

async function through(bytes, stream) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}
/** FNV-1a over 32-bit words, twice, as text: tells one build from another. */
function digest(bytes) {
  const words = new Uint32Array(bytes.slice(0, bytes.byteLength & ~3));
  let a = 2166136261, b = 84696351;
  for (const word of words) {
    a = Math.imul(a ^ word, 16777619);
    b = Math.imul(b ^ word, 16777633) ^ (b >>> 15);
  }
  return `${bytes.byteLength}-${(a >>> 0).toString(16)}${(b >>> 0).toString(16)}`;
}

/** A program whose memory grows must not be read through an old view: views are made for each reading. */
export class Program {
  /** @param bytes of testbed.wasm */
  static async from(bytes) {
    const program = new Program();
    const { instance } = await WebAssembly.instantiate(bytes, program.imports());
    program.calls = instance.exports;
    program.memory = instance.exports.memory;
    instance.exports._initialize();
    program.id = digest(bytes instanceof ArrayBuffer ? bytes : bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
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
  /** Triangles of the wall that the scene shows as it is. */
  ground() {
    return this.floats(this.get("ground"), this.get("ground_size")).slice();
  }
  /** The state of the scene as the bytes of a file: the memory of the program with all that it knows, compressed.
   *  @param header what else is to be kept: scene, shape and values of the settings */
  async save(header) {
    this.call("frame");
    const all = new Uint8Array(this.memory.buffer);
    let end = all.length;
    while (end > 0 && all[end - 1] === 0) --end;
    const text = new TextEncoder().encode(JSON.stringify({
      format, program: this.id, time: this.get("time"), hash: this.text(this.get("hash")), ...header,
    }));
    const bytes = new Uint8Array(4 + text.length + end);
    new DataView(bytes.buffer).setUint32(0, text.length, true);
    bytes.set(text, 4);
    bytes.set(all.subarray(0, end), 4 + text.length);
    return through(bytes, new CompressionStream("gzip"));
  }
  /** Restores what save() wrote. Throws, and leaves everything as it is, if the bytes are not of this program.
   *  @returns the header */
  async restore(packed) {
    let bytes, header;
    try {
      bytes = await through(packed, new DecompressionStream("gzip"));
      const length = new DataView(bytes.buffer).getUint32(0, true);
      header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
      bytes = bytes.subarray(4 + length);
    } catch {
      throw new Error("this is no state of the testbed, or not all of it");
    }
    if (header.format !== format) throw new Error("this is no state of the testbed");
    if (header.program !== this.id) throw new Error("this state is of another build of the testbed; only the build that saved it can load it");
    const before = new Uint8Array(this.memory.buffer).slice();
    const missing = bytes.length - before.length;
    if (missing > 0) this.memory.grow(Math.ceil(missing / 65536));
    this.put(bytes);
    this.call("frame");
    if (this.text(this.get("hash")) !== header.hash) {
      this.put(before);
      throw new Error("the hash of this state is not the one that was saved with it");
    }
    return header;
  }
  put(bytes) {
    const all = new Uint8Array(this.memory.buffer);
    all.set(bytes);
    all.fill(0, bytes.length);
  }
  indexOf(table, key) {
    return this.tables[table].findIndex((entry) => entry.key === key);
  }
}
