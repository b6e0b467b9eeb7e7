"use strict";
/* Teeth as solids: a small software renderer with a depth buffer, so that the view needs no graphics driver.
 * Lengths in mm, all frames right-handed unless the design is left-handed. A scene has
 *   centre, radius, view (rows right, up, near), cut {normal, offset}, steps_per_pitch, breaks,
 *   bodies [{name, colour, copies, matrices: 12 numbers a position, patches [toothPatch …]}],
 *   contacts by position: null or {point, line, axes, flagged}. */

function decoded(text, Kind) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Kind(bytes.buffer);
}

/* The closed surface of a tooth: the flank in contact, the far flank, and the circles about z from border to border.
 * near, far: {points, normals}; across: the angle of each far point from its near one. Where there is no far point
 * (NaN), the tooth is as wide as at the nearest place that has one. */
function toothPatch(near, far, across, triangles) {
  [far, across] = widened(near, far, across);
  const count = near.points.length / 3, points = Array.from(near.points), normals = Array.from(near.normals);
  for (const c of far.points) points.push(c);
  for (const c of far.normals) normals.push(c);
  const corners = Array.from(triangles), sheets = corners.length;
  for (let k = 0; k < sheets; k += 3) corners.push(corners[k] + count, corners[k + 2] + count, corners[k + 1] + count);
  const edges = new Map();
  for (let k = 0; k < sheets; k += 3)
    for (let e = 0; e < 3; e++) {
      const a = corners[k + e], b = corners[k + ((e + 1) % 3)], c = corners[k + ((e + 2) % 3)];
      const key = Math.min(a, b) * count + Math.max(a, b);
      if (edges.has(key)) edges.delete(key);
      else edges.set(key, [a, b, c]);
    }
  const widest = across.reduce((most, angle) => (Math.abs(angle) > most ? Math.abs(angle) : most), 0);
  const steps = Math.min(24, Math.max(1, Math.ceil(widest / 0.14)));
  for (const [a, b, c] of edges.values()) rim(a, b, c);
  return { points: Float64Array.from(points), normals: Float64Array.from(normals), triangles: Uint32Array.from(corners), active: 3 * count };

  /* from the border edge a–b of a triangle with the third corner c to its image: `steps` quadrangles */
  function rim(a, b, c) {
    const first = points.length / 3;
    for (let k = 0; k <= steps; k++) for (const i of [a, b]) points.push(...between(i, k / steps));
    for (let k = 0; k <= steps; k++) {
      const here = first + 2 * k, there = first + 2 * (k < steps ? k + 1 : k - 1), sign = k < steps ? 1 : -1;
      const along = [0, 1, 2].map((i) => points[3 * here + 3 + i] - points[3 * here + i]);
      const round = [0, 1, 2].map((i) => sign * (points[3 * there + i] - points[3 * here + i]));
      let n = crossed(along, round);
      if (k === 0) {
        const out = [0, 1, 2].map((i) => points[3 * first + i] - points[3 * c + i]);
        rim.sign = n[0] * out[0] + n[1] * out[1] + n[2] * out[2] < 0 ? -1 : 1;
      }
      const length = rim.sign * (Math.hypot(...n) || 1);
      n = n.map((v) => v / length);
      normals.push(...n, ...n);
      if (k < steps) corners.push(here, here + 1, here + 2, here + 1, here + 3, here + 2);
    }
  }

  /* a point of the circle, or screw, from a near point to its far one */
  function between(i, share) {
    const p = near.points.subarray(3 * i, 3 * i + 3), q = far.points.subarray(3 * i, 3 * i + 3);
    const radius = Math.hypot(p[0], p[1]) * (1 - share) + Math.hypot(q[0], q[1]) * share;
    const angle = Math.atan2(p[1], p[0]) + share * across[i];
    return [radius * Math.cos(angle), radius * Math.sin(angle), p[2] * (1 - share) + q[2] * share];
  }
}

function widened(near, far, across) {
  const known = [...across.keys()].filter((i) => Number.isFinite(across[i]));
  if (known.length === across.length || !known.length) return [far, across];
  const filled = Float64Array.from(across), points = Float64Array.from(far.points), normals = Float64Array.from(far.normals);
  const apart = (i, k) => [0, 1, 2].reduce((sum, c) => sum + (near.points[3 * i + c] - near.points[3 * k + c]) ** 2, 0);
  for (let i = 0; i < across.length; i++) {
    if (Number.isFinite(across[i])) continue;
    filled[i] = across[known.reduce((best, k) => (apart(i, k) < apart(i, best) ? k : best))];
    const turned = (values) => turnedAboutAxis(values.subarray(3 * i, 3 * i + 3), [filled[i]]);
    points.set(turned(near.points), 3 * i);
    normals.set(turned(near.normals).map((v) => -v), 3 * i);
  }
  return [{ points, normals }, filled];
}

/* Points turned about z, each by its own angle. */
function turnedAboutAxis(points, across) {
  const turned = new Float64Array(points.length);
  for (let i = 0; i < across.length; i++) {
    const c = Math.cos(across[i]), s = Math.sin(across[i]), x = points[3 * i], y = points[3 * i + 1];
    turned.set([c * x - s * y, s * x + c * y, points[3 * i + 2]], 3 * i);
  }
  return turned;
}

function crossed(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function normalised(v) {
  const length = Math.hypot(...v);
  return v.map((c) => c / length);
}

/* The view on a canvas. `asks` says what to show: position(), shown(name), open(), seeThrough(); `drawn(pairs)` is told
 * the positions of the pairs in contact after each drawing. */
class TeethView {
  constructor(canvas, scene, asks) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.asks = asks;
    this.light = normalised([-0.35, 0.45, 0.82]);
    this.paper = [247, 249, 251];
    this.layers = [];
    this.waiting = false;
    this.scene = scene;
    this.reset();
    this._listen();
  }

  reset() {
    this.camera = { rows: this.scene.view.map((row) => row.slice()), zoom: 1, pan: [0, 0] };
  }

  /* ---- geometry ------------------------------------------------------------------------------------------- */

  /* Body to screen: the placement at a position, after a turn of the copy about the body's own axis. */
  placed(body, position, turn) {
    const m = body.matrices.subarray(12 * position, 12 * position + 12);
    const c = Math.cos(turn), s = Math.sin(turn), out = new Float64Array(12);
    for (let row = 0; row < 3; row++) {
      const [a, b, z, t] = m.subarray(4 * row, 4 * row + 4);
      out.set([a * c + b * s, b * c - a * s, z, t], 4 * row);
    }
    return out;
  }

  scale() {
    return (0.52 * Math.min(this.canvas.width / 1.5, this.canvas.height) / this.scene.radius) * this.camera.zoom;
  }

  projected(p) {
    const d = [p[0] - this.scene.centre[0], p[1] - this.scene.centre[1], p[2] - this.scene.centre[2]];
    const k = this.scale();
    const [right, up, near] = this.camera.rows.map((row) => row[0] * d[0] + row[1] * d[1] + row[2] * d[2]);
    return [this.canvas.width / 2 + this.camera.pan[0] + k * right, this.canvas.height / 2 + this.camera.pan[1] - k * up, near];
  }

  /* ---- renderer ------------------------------------------------------------------------------------------- */

  resized() {
    const canvas = this.canvas, ratio = Math.min(window.devicePixelRatio || 1, 1.5);
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width === width && canvas.height === height && this.layers.length) return;
    canvas.width = width;
    canvas.height = height;
    const size = width * height;
    this.layers = this.scene.bodies.map(() => ({ depth: new Float32Array(size), shade: new Float32Array(size), inside: new Uint8Array(size) }));
  }

  /* Values of a vertex on the screen: place (2), depth, shade, how far inside the cut it lies, and whether its normal
   * points to the viewer. */
  drawPatch(layer, patch, matrix, cut) {
    const { points, normals, triangles } = patch, m = matrix, width = 6, light = this.light;
    const count = points.length / 3, screen = new Float64Array(width * count), k = this.scale(), rows = this.camera.rows;
    const [cx, cy, cz] = this.scene.centre, left = this.canvas.width / 2 + this.camera.pan[0], top = this.canvas.height / 2 + this.camera.pan[1];
    for (let i = 0, at = 0; i < 3 * count; i += 3, at += width) {
      const x = points[i], y = points[i + 1], z = points[i + 2];
      const px = m[0] * x + m[1] * y + m[2] * z + m[3], py = m[4] * x + m[5] * y + m[6] * z + m[7], pz = m[8] * x + m[9] * y + m[10] * z + m[11];
      const dx = px - cx, dy = py - cy, dz = pz - cz;
      screen[at] = left + k * (rows[0][0] * dx + rows[0][1] * dy + rows[0][2] * dz);
      screen[at + 1] = top - k * (rows[1][0] * dx + rows[1][1] * dy + rows[1][2] * dz);
      screen[at + 2] = rows[2][0] * dx + rows[2][1] * dy + rows[2][2] * dz;
      const a = normals[i], b = normals[i + 1], c = normals[i + 2];
      const nx = m[0] * a + m[1] * b + m[2] * c, ny = m[4] * a + m[5] * b + m[6] * c, nz = m[8] * a + m[9] * b + m[10] * c;
      const right = rows[0][0] * nx + rows[0][1] * ny + rows[0][2] * nz, up = rows[1][0] * nx + rows[1][1] * ny + rows[1][2] * nz;
      const near = rows[2][0] * nx + rows[2][1] * ny + rows[2][2] * nz, side = near >= 0 ? 1 : -1;
      const lit = side * (right * light[0] + up * light[1] + near * light[2]);
      screen[at + 3] = (0.78 + 0.5 * lit) * (side > 0 ? 1 : 0.9) * (i < patch.active ? 1 : 0.86);
      screen[at + 4] = cut ? cut.offset - cut.normal[0] * px - cut.normal[1] * py - cut.normal[2] * pz : 1;
      screen[at + 5] = near;
    }
    for (let t = 0; t < triangles.length; t += 3)
      this.drawTriangle(layer, screen, width * triangles[t], width * triangles[t + 1], width * triangles[t + 2]);
  }

  drawTriangle(layer, s, a, b, c) {
    const ax = s[a], ay = s[a + 1], bx = s[b], by = s[b + 1], cx = s[c], cy = s[c + 1];
    const area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
    if (!(Math.abs(area) > 1e-9)) return; /* degenerate, or a point that does not exist (NaN) */
    const wide = this.canvas.width, inside = s[a + 5] + s[b + 5] + s[c + 5] < 0 ? 1 : 0;
    const left = Math.max(0, Math.ceil(Math.min(ax, bx, cx))), right = Math.min(wide - 1, Math.floor(Math.max(ax, bx, cx)));
    const top = Math.max(0, Math.ceil(Math.min(ay, by, cy))), low = Math.min(this.canvas.height - 1, Math.floor(Math.max(ay, by, cy)));
    for (let y = top; y <= low; y++)
      for (let x = left; x <= right; x++) {
        const wa = ((bx - x) * (cy - y) - (cx - x) * (by - y)) / area;
        const wb = ((cx - x) * (ay - y) - (ax - x) * (cy - y)) / area;
        const wc = 1 - wa - wb;
        if (wa < 0 || wb < 0 || wc < 0) continue;
        const near = wa * s[a + 2] + wb * s[b + 2] + wc * s[c + 2], at = y * wide + x;
        if (near > layer.depth[at] && wa * s[a + 4] + wb * s[b + 4] + wc * s[c + 4] > 0) {
          layer.depth[at] = near;
          layer.shade[at] = wa * s[a + 3] + wb * s[b + 3] + wc * s[c + 3];
          layer.inside[at] = inside;
        }
      }
  }

  /* Where the nearest surface behind the cut is seen from within, the cut goes through material: its plane is seen. */
  capped(layer, cut) {
    const [right, up, near] = this.camera.rows, n = cut.normal, { width, height } = this.canvas, k = this.scale();
    const dot = (row) => n[0] * row[0] + n[1] * row[1] + n[2] * row[2], facing = dot(near);
    if (!(facing > 1e-3)) return;
    const shade = 0.62 + 0.3 * facing, offset = cut.offset - dot(this.scene.centre);
    for (let y = 0, at = 0; y < height; y++)
      for (let x = 0; x < width; x++, at++) {
        if (!layer.inside[at] || layer.depth[at] === -Infinity) continue;
        const u = (x - width / 2 - this.camera.pan[0]) / k, v = (height / 2 + this.camera.pan[1] - y) / k;
        layer.depth[at] = (offset - u * dot(right) - v * dot(up)) / facing;
        layer.shade[at] = shade;
      }
  }

  blend(data, to, body, layer, at, cover, fresh) {
    const there = layer.depth[at] !== -Infinity, colour = this.scene.bodies[body].colour;
    for (let i = 0; i < 3; i++) {
      const under = fresh ? this.paper[i] : data[to + i];
      data[to + i] = there ? under * (1 - cover) + cover * colour[i] * layer.shade[at] : under;
    }
    data[to + 3] = 255;
  }

  drawBodies(position) {
    const open = this.asks.open(), { bodies, cut } = this.scene;
    bodies.forEach((body, k) => {
      const layer = this.layers[k], opened = body.name === "pinion" && open ? cut : null;
      layer.depth.fill(-Infinity);
      if (!this.asks.shown(body.name)) return;
      for (const turn of body.copies) {
        const matrix = this.placed(body, position, turn);
        for (const patch of body.patches) this.drawPatch(layer, patch, matrix, opened);
      }
      if (opened) this.capped(layer, opened);
    });
    const image = this.context.createImageData(this.canvas.width, this.canvas.height);
    const see = this.asks.seeThrough() ? 0.4 : 1;
    const [first, second] = this.layers;
    for (let at = 0, to = 0; at < first.depth.length; at++, to += 4) {
      const behind = first.depth[at] <= second.depth[at] ? 0 : 1;
      const veiled = this.layers[behind].depth[at] !== -Infinity && bodies[1 - behind].name === "wheel";
      this.blend(image.data, to, behind, this.layers[behind], at, 1, true);
      this.blend(image.data, to, 1 - behind, this.layers[1 - behind], at, veiled ? see : 1, false);
    }
    this.context.putImageData(image, 0, 0);
  }

  /* ---- contacts, axes, scale ------------------------------------------------------------------------------ */

  drawLine(points, colour, width, dash) {
    this.context.beginPath();
    points.forEach((p, i) => {
      const [u, v] = this.projected(p);
      if (i) this.context.lineTo(u, v);
      else this.context.moveTo(u, v);
    });
    this.context.strokeStyle = colour;
    this.context.lineWidth = width;
    this.context.setLineDash(dash || []);
    this.context.stroke();
  }

  /* the path of contact, one stroke for each branch */
  strokes() {
    const found = [[]];
    this.scene.contacts.forEach((contact, position) => {
      if (!contact || this.scene.breaks.includes(position)) found.push([]);
      if (contact) found[found.length - 1].push(contact.point);
    });
    return found;
  }

  outlined(contact) {
    if (contact.line) return contact.line;
    if (!contact.axes) return [];
    const [major, minor] = contact.axes;
    return Array.from({ length: 49 }, (_, i) => {
      const c = Math.cos((i * Math.PI) / 24), s = Math.sin((i * Math.PI) / 24);
      return contact.point.map((p, axis) => p + c * major[axis] + s * minor[axis]);
    });
  }

  drawContacts(position) {
    const pairs = [];
    const steps = this.scene.steps_per_pitch, last = this.scene.contacts.length;
    for (let at = position % steps; at < last; at += steps) if (this.scene.contacts[at]) pairs.push(at);
    if (!this.scene.contacts.some((contact) => contact && contact.line)) for (const stroke of this.strokes()) this.drawLine(stroke, "#6b7885", 1.2, [4, 4]);
    for (const at of pairs) {
      const contact = this.scene.contacts[at], followed = at === position;
      const outline = this.outlined(contact);
      this.drawLine(outline, "#ffffff", followed ? 4.5 : 3.5);
      this.drawLine(outline, contact.flagged ? "#c0273d" : "#10202e", followed ? 2.4 : 1.4);
      if (contact.line) continue;
      const [u, v] = this.projected(contact.point);
      this.context.beginPath();
      this.context.arc(u, v, followed ? 4.5 : 3, 0, 2 * Math.PI);
      this.context.fillStyle = contact.flagged ? "#c0273d" : followed ? "#ffd23f" : "#ffffff";
      this.context.setLineDash([]);
      this.context.fill();
      this.context.strokeStyle = "#10202e";
      this.context.lineWidth = 1;
      this.context.stroke();
    }
    return pairs;
  }

  drawScale() {
    const k = this.scale();
    const raw = 120 / k, power = 10 ** Math.floor(Math.log10(raw));
    const length = power * (raw / power >= 5 ? 5 : raw / power >= 2 ? 2 : 1);
    const x = 18, y = this.canvas.height - 20;
    this.context.setLineDash([]);
    this.context.strokeStyle = this.context.fillStyle = "#1c2733";
    this.context.lineWidth = 2;
    this.context.strokeRect(x, y, length * k, 0);
    this.context.font = "13px system-ui, sans-serif";
    this.context.fillText(`${Number(length.toPrecision(3))} mm`, x, y - 7);
    const corner = [this.canvas.width - 52, this.canvas.height - 48];
    ["x", "y", "z"].forEach((name, axis) => {
      const u = corner[0] + 32 * this.camera.rows[0][axis], v = corner[1] - 32 * this.camera.rows[1][axis];
      this.context.beginPath();
      this.context.moveTo(...corner);
      this.context.lineTo(u, v);
      this.context.stroke();
      this.context.fillText(name, u + 4 * Math.sign(u - corner[0]) - 3, v + 4);
    });
  }

  draw() {
    const position = this.asks.position();
    this.resized();
    this.drawBodies(position);
    const pairs = this.drawContacts(position);
    this.drawScale();
    this.asks.drawn(pairs);
  }

  redraw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  /* ---- hand on mouse, finger and keys --------------------------------------------------------------------- */

  orbit(dx, dy) {
    const turn = (p, q, angle) => {
      const c = Math.cos(angle), s = Math.sin(angle);
      const [a, b] = [this.camera.rows[p], this.camera.rows[q]];
      this.camera.rows[p] = a.map((v, i) => c * v + s * b[i]);
      this.camera.rows[q] = b.map((v, i) => c * v - s * a[i]);
    };
    turn(2, 0, -dx);
    turn(2, 1, dy);
  }

  _listen() {
    let held = null;
    this.canvas.addEventListener("pointerdown", (event) => {
      held = [event.clientX, event.clientY];
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (!held) return;
      const dx = event.clientX - held[0], dy = event.clientY - held[1];
      held = [event.clientX, event.clientY];
      if (event.shiftKey || event.buttons === 2) {
        const ratio = this.canvas.width / this.canvas.clientWidth;
        this.camera.pan = [this.camera.pan[0] + ratio * dx, this.camera.pan[1] + ratio * dy];
      } else this.orbit(0.008 * dx, 0.008 * dy);
      this.redraw();
    });
    this.canvas.addEventListener("pointerup", () => (held = null));
    this.canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    this.canvas.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        this.camera.zoom = Math.min(200, Math.max(0.1, this.camera.zoom * Math.exp(-0.0015 * event.deltaY)));
        this.redraw();
      },
      { passive: false },
    );
    this.canvas.addEventListener("keydown", (event) => {
      const turns = { ArrowLeft: [-0.08, 0], ArrowRight: [0.08, 0], ArrowUp: [0, -0.08], ArrowDown: [0, 0.08] };
      if (turns[event.key]) this.orbit(...turns[event.key]);
      else if (event.key === "+") this.camera.zoom *= 1.15;
      else if (event.key === "-") this.camera.zoom /= 1.15;
      else return;
      event.preventDefault();
      this.redraw();
    });
    window.addEventListener("resize", () => this.redraw());
  }
}
