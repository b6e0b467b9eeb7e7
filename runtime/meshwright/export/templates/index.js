/* Tooth contact of one gear drive, in Node and in browsers. Made by meshwright.  SPDX-License-Identifier: MIT-0 */

const WORDS = { @words@ };
const place = new URL("mesh.wasm", import.meta.url);

async function bytes() {
  if (typeof process !== "undefined" && process.versions?.node) {
    const { readFile } = await import("node:fs/promises");
    return readFile(place);
  }
  const answer = await fetch(place);
  if (!answer.ok) throw new Error(`${place}: ${answer.status} ${answer.statusText}; serve mesh.wasm beside index.js`);
  return answer.arrayBuffer();
}

function side(row) {
  return {
    pair: row[0], error: row[1], ratio: row[2], status: WORDS[row[3]], pairs: row[4], edge: row[5] !== 0,
  };
}

function angle(phi) {
  if (typeof phi !== "number") throw new TypeError(`phi = ${phi}: no number; give a pinion angle, rad`);
  return phi;
}

export async function load() {
  const { instance } = await WebAssembly.instantiate(await bytes());
  const { memory, mesh_begin, mesh_follow, mesh_cycle, mesh_memory, mesh_result } = instance.exports;
  const state = mesh_memory(), result = mesh_result();
  if (mesh_begin(state) !== 0) throw new Error("the design does not pass its guards");
  const row = (count) => new Float64Array(memory.buffer, result, count);
  return {
    follow(phi) {
      mesh_follow(state, angle(phi), result);
      const [pair, own, error, status] = row(4);
      return { pair, angle: own, error, status: WORDS[status] };
    },
    cycle(phi) {
      mesh_cycle(state, angle(phi), result);
      const found = row(15);
      return {
        pair: found[0], angle: found[1], backlash: found[2],
        drive: side(found.subarray(3, 9)), coast: side(found.subarray(9, 15)),
      };
    },
  };
}
