"use strict";
/* The WebAssembly module behind plain functions. Inner units (mm, rad), the drive in the hand of its equations. */

const HEAD = { status: 0, iterations: 1, line: 2, flags: 3, point: 4, normal: 7, least: 10, most: 11, major: 12,
               distance: 15, misfit: 16, leverPinion: 17, leverWheel: 18, ratio: 19, unknowns: 21 };

class Solver {
  constructor(module, data) {
    this.data = data;
    this.c = new WebAssembly.Instance(module, {}).exports;
    this.length = this.c.live_row_length();
    this.most = this.c.live_most_angles();
  }
  _view(address, count) { return new Float64Array(this.c.memory.buffer, address, count); }

  /* Complete parameters from those given (NaN: open): {fault: null or words, keys, parameters, sizes}. */
  complete(given) {
    const parameters = this._view(this.c.live_parameters(), given.length);
    parameters.set(given);
    const result = this.c.live_complete();
    const wrong = result > 0 ? this.data.systems[result - 1] : result < 0 ? this.data.guards[-result - 1] : null;
    return { fault: wrong ? wrong.message : null, keys: wrong ? wrong.keys : [], parameters: Float64Array.from(parameters),
             sizes: Array.from(this._view(this.c.live_sizes(), this.data.sizes.length)) };
  }

  /* Rows at the angles, of the design completed last. */
  rows(angles) {
    this._view(this.c.live_angles(), angles.length).set(angles);
    this.c.live_cycle(angles.length);
    const all = this._view(this.c.live_rows(), angles.length * this.length).slice(), rows = [];
    for (let k = 0; k < angles.length; k++) rows.push(this._row(angles[k], all.subarray(k * this.length, (k + 1) * this.length)));
    return rows;
  }

  /* Points and normals of the flank of a member of the design completed last, at places. */
  flank(member, places) {
    this._view(this.c.live_places(), places.length).set(places);
    const count = places.length / this.data.coordinates[member];
    if (this.c.live_flank(member, count) < 0) return { points: new Float64Array(3 * count).fill(NaN), normals: new Float64Array(3 * count) };
    const shape = this._view(this.c.live_shape(), 6 * count), points = new Float64Array(3 * count), normals = new Float64Array(3 * count);
    for (let i = 0; i < count; i++) for (let j = 0; j < 3; j++) { points[3 * i + j] = shape[6 * i + j]; normals[3 * i + j] = shape[6 * i + 3 + j]; }
    return { points, normals };
  }

  _row(angle, row) {
    const n = this.data.counts, x = HEAD.unknowns, o = x + n.unknowns, place = o + n.observation;
    return { angle, row, x: row.subarray(x, o), o: row.subarray(o, place), place: row.subarray(place),
             status: row[HEAD.status], iterations: row[HEAD.iterations], line: row[HEAD.line] === 1, flags: row[HEAD.flags],
             touches: row[HEAD.status] >= 0, pointlike: row[HEAD.status] >= 0 && row[HEAD.line] === 0,
             error: row[x + this.data.error], wheelAngle: row[o + this.data.wheel_angle] };
  }
}

/* Semi-axes of the contact ellipse at a separation, larger first: sqrt(2 δ / curvature), mm. */
function semiAxes(row, separation) {
  if (!row.pointlike) return [NaN, NaN];
  return [Math.sqrt(2 * separation / row.row[HEAD.least]), Math.sqrt(2 * separation / row.row[HEAD.most])];
}

/* Contact in the wheel's frame: point, and the directions of both axes of the ellipse, of the design's hand. */
function onWheel(row, data) {
  const at = data.wheel_point, m = row.place, p = data.placement.placement_wheel, flip = [1, data.mirror, 1];
  const turned = d => [0, 1, 2].map(j => flip[j] * [0, 1, 2].reduce((sum, i) => sum + m[p + 4 * i + j] * d[i], 0));
  const a = Array.from(row.row.subarray(HEAD.major, HEAD.major + 3)), n = row.row.subarray(HEAD.normal, HEAD.normal + 3);
  const b = [n[1] * a[2] - n[2] * a[1], n[2] * a[0] - n[0] * a[2], n[0] * a[1] - n[1] * a[0]];
  return { point: [0, 1, 2].map(i => flip[i] * row.o[at + i]), major: turned(a), minor: turned(b) };
}

/* A point of the wheel in the picture of its flank: seen along the axis, or axial position and radius, mm. */
function flat(point, data) {
  return data.end_on ? [point[0], point[1]] : [point[2], Math.hypot(point[0], point[1])];
}
