/* node example.mjs: pinion angles, rad, on standard input, one a line; tooth pair and transmission error, rad, a line each. */
import { createInterface } from "node:readline";
import { load } from "./index.js";

const mesh = await load();
for await (const line of createInterface({ input: process.stdin })) {
  const { pair, error } = mesh.follow(Number(line));
  console.log(`${pair} ${error}`);
}
