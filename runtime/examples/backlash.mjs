/* The least backlash of a drive over a pitch, arcseconds: node backlash.mjs PACKAGE TEETH, a folder that `meshwright export
 * DESIGN --npm PACKAGE` wrote and the number of the pinion's teeth. */
import { pathToFileURL } from "node:url";
import { resolve } from "node:path";

const [folder, teeth] = process.argv.slice(2);
const { load } = await import(pathToFileURL(resolve(folder, "index.js")));
const mesh = await load();
const pitch = (2 * Math.PI) / Number(teeth);
let least = Infinity;
for (let k = 0; k < 64; k++) least = Math.min(least, mesh.cycle((k / 64) * pitch).backlash);
console.log(((least * 648000) / Math.PI).toFixed(9));
