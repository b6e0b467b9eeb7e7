"use strict";
/* The teeth of the keys as they stand: both flanks of a tooth from the solver, placed at every position of the cycle. */

class Solids {
  constructor(solver, data, holder, asks) {
    this.solver = solver;
    this.data = data;
    this.bodies = data.teeth.bodies.map(body => ({
      ...body, places: decoded(body.places, Float64Array), far: body.far && decoded(body.far, Float64Array),
      triangles: decoded(body.triangles, Uint32Array), across: decoded(body.across, Float64Array).map(v => data.mirror * v),
    }));
    this.holder = holder;
    this.asks = asks;
    this.view = null;
  }

  /* Draw the cycle `state` (given keys, rows, separation). The first one sets the camera. */
  show(state) {
    const known = state.rows.filter(r => r.touches && Number.isFinite(r.row[HEAD.point]));
    if (!known.length) return;
    const scene = this._scene(state, known);
    if (this.view) {
      const { centre, radius } = this.view.scene;
      this.view.show({ ...scene, centre, radius });
      this.view.redraw();
    } else {
      this.view = new TeethView(this.holder, scene, this.asks);
      this.view.draw();
    }
  }

  _scene(state, known) {
    const { mirror, placement } = this.data, flip = [1, mirror, 1], point = r => flip.map((f, i) => f * r.row[HEAD.point + i]);
    const points = known.map(point), middle = known[Math.floor(known.length / 2)], at = point(middle);
    const centre = [0, 1, 2].map(i => points.reduce((sum, p) => sum + p[i], 0) / points.length);
    const reach = Math.max(...known.map(r => semiAxes(r, state.separation)[0]).filter(Number.isFinite), 0);
    const colour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    const light = hex => [1, 3, 5].map(k => { const c = parseInt(hex.slice(k, k + 2), 16); return Math.round(c + 0.22 * (255 - c)); });
    const bodies = this._teeth(state.given).map((tooth, k) => {
      const matrices = new Float64Array(12 * state.rows.length), from = placement[`placement_${this.bodies[k].name}`];
      state.rows.forEach((r, n) => { for (let i = 0; i < 12; i++) matrices[12 * n + i] = flip[Math.floor(i / 4)] * (i % 4 === 1 ? mirror : 1) * r.place[from + i]; });
      return { name: this.bodies[k].name, colour: light(colour(k === 0 ? "--first" : "--second")), copies: this.bodies[k].copies, matrices, tooth };
    });
    /* straight from the contact to the pinion's axis */
    const m = bodies[0].matrices.subarray(12 * state.rows.indexOf(middle)), axis = [m[2], m[6], m[10]], arm = [m[3], m[7], m[11]].map((v, i) => v - at[i]);
    const along = arm.reduce((sum, v, i) => sum + v * axis[i], 0), inward = normalised(arm.map((v, i) => v - along * axis[i]));
    const normal = flip.map((f, i) => f * middle.row[HEAD.normal + i]), side = normalised(crossed(normal, inward));
    const near = normalised(normal.map((v, i) => 0.5 * v + 0.35 * side[i] + 0.8 * inward[i]));
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const up = normalised(inward.map((v, i) => v - near[i] * dot(inward, near)));
    const heights = points.map(p => dot(p, inward)), spans = [0, 1, 2].map(i => Math.max(...points.map(p => p[i])) - Math.min(...points.map(p => p[i])));
    return {
      bodies, centre, radius: 1.4 * (Math.max(...points.map(p => Math.hypot(...p.map((v, i) => v - centre[i])))) + reach),
      view: [crossed(up, near), up, near], cut: { normal: inward, offset: Math.max(...heights) + 0.08 * Math.hypot(...spans) },
      steps_per_pitch: state.rows.length, breaks: [], contacts: state.rows.map(r => this._contact(r, state.separation, flip)),
    };
  }

  _contact(row, separation, flip) {
    if (!row.pointlike) return null;
    const n = flip.map((f, i) => f * row.row[HEAD.normal + i]), major = flip.map((f, i) => f * row.row[HEAD.major + i]), minor = crossed(n, major);
    const [a, b] = semiAxes(row, separation);
    const axes = Number.isFinite(a + b) ? [major.map(v => a * v), minor.map(v => b * v)] : null;
    return { point: flip.map((f, i) => f * row.row[HEAD.point + i]), line: null, axes, flagged: flagsOf(row).join(", ") };
  }

  /* Of each member a tooth. The far flank is that of the same keys with the other side asked for. */
  _teeth(given) {
    const { mirror, teeth } = this.data, flipped = given.slice();
    const near = this.bodies.map((body, k) => this.solver.flank(k, body.places));
    flipped[teeth.side] = -given[teeth.side];
    const apart = this.bodies.some(body => !body.far) || this.solver.complete(flipped).fault !== null;
    const far = this.bodies.map((body, k) => apart ? null : this.solver.flank(k, body.far));
    this.solver.complete(given);
    for (const flank of [...near, ...far]) if (flank) for (let i = 1; i < flank.points.length; i += 3) { flank.points[i] *= mirror; flank.normals[i] *= mirror; }
    return this.bodies.map((body, k) => {
      if (!far[k]) {
        const turned = turnedAboutAxis(near[k].normals, body.across).map(v => -v);
        return closedTooth(near[k], { points: turnedAboutAxis(near[k].points, body.across), normals: turned }, body.across, body.triangles);
      }
      return this._between(near[k], far[k], body);
    });
  }

  /* The far flank turned to the tooth of the near one, which is where it was for the keys as written, nearly. */
  _between(near, far, body) {
    const turns = new Float64Array(body.across.length), across = body.across.map((written, i) => {
      const there = Math.atan2(far.points[3 * i + 1], far.points[3 * i]), here = Math.atan2(near.points[3 * i + 1], near.points[3 * i]);
      const pitch = body.copies.length > 1 ? body.copies[1] - body.copies[0] : 2 * Math.PI;
      const off = there - here - written, angle = written + off - pitch * Math.round(off / pitch);
      turns[i] = here + angle - there;
      return angle;
    });
    return closedTooth(near, { points: turnedAboutAxis(far.points, turns), normals: turnedAboutAxis(far.normals, turns) }, across, body.triangles);
  }
}
