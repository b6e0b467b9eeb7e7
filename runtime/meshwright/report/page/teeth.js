"use strict";
/* Teeth as solids, drawn by three.js (THREE). Lengths in mm, all frames right-handed unless the design is left-handed.
 * A scene has
 *   centre, radius, view (rows right, up, near), cut {normal, offset}, steps_per_pitch, breaks,
 *   bodies [{name, colour, copies, matrices: 12 numbers a position, tooth: closedTooth(…)}],
 *   contacts by position: null or {point, line, axes, flagged}. */

function decoded(text, Kind) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Kind(bytes.buffer);
}

/* The closed surface of a tooth: the flank in contact, the far flank, and the circles about z from border to border.
 * near, far: {points, normals}; across: the angle of each far point from its near one. Where there is no far point
 * (NaN), the tooth is as wide as at the nearest place that has one. Triangles run anticlockwise seen from outside. */
function closedTooth(near, far, across, triangles) {
  [far, across] = widened(near, far, across);
  const count = near.points.length / 3, points = [...near.points, ...far.points], corners = [], edges = new Map();
  for (let k = 0; k < triangles.length; k += 3) {
    const [a, b, c] = outward(near, triangles.subarray(k, k + 3));
    corners.push(a, b, c, a + count, c + count, b + count);
    for (const [from, to] of [[a, b], [b, c], [c, a]]) {
      const key = Math.min(from, to) * count + Math.max(from, to);
      if (edges.has(key)) edges.delete(key);
      else edges.set(key, [from, to]);
    }
  }
  const widest = across.reduce((most, angle) => (Math.abs(angle) > most ? Math.abs(angle) : most), 0);
  const steps = Math.min(24, Math.max(1, Math.ceil(widest / 0.14)));
  /* the borders of both flanks joined; vertices are shared along a border, but not at its corners */
  const ring = (v) => {
    for (let k = 0; k <= steps; k++) points.push(...between(v, k / steps));
    return points.length / 3 - steps - 1;
  };
  const next = new Map(edges.values()), rings = new Map([...next.keys()].map((v) => [v, ring(v)]));
  const along = (a, b) => normalised([0, 1, 2].map((i) => near.points[3 * b + i] - near.points[3 * a + i]));
  for (const [a, b] of edges.values()) {
    const before = along(a, b), after = along(b, next.get(b)), turned = before.reduce((sum, v, i) => sum + v * after[i], 0);
    const at = rings.get(a), to = turned < 0.8 ? ring(b) : rings.get(b);
    for (let k = 0; k < steps; k++) corners.push(to + k, at + k, at + k + 1, to + k, at + k + 1, to + k + 1);
  }
  const there = corners.map((k) => Number.isFinite(points[3 * k] + points[3 * k + 1] + points[3 * k + 2]));
  const tooth = new THREE.BufferGeometry();
  tooth.setIndex(corners.filter((_, k) => [0, 1, 2].every((i) => there[k - (k % 3) + i])));
  tooth.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(points, (v) => (Number.isFinite(v) ? v : 0)), 3));
  tooth.computeVertexNormals();
  tooth.attributes.normal.array.set(near.normals);
  tooth.attributes.normal.array.set(far.normals, 3 * count);
  tooth.setAttribute("color", new THREE.BufferAttribute(new Float32Array(points.length).fill(0.86).fill(1, 0, 3 * count), 3));
  return tooth;

  /* a point of the circle, or screw, from a near point to its far one */
  function between(i, share) {
    const p = near.points.subarray(3 * i, 3 * i + 3), q = far.points.subarray(3 * i, 3 * i + 3);
    if (share === 0 || share === 1) return share ? q : p;
    const radius = Math.hypot(p[0], p[1]) * (1 - share) + Math.hypot(q[0], q[1]) * share;
    const angle = Math.atan2(p[1], p[0]) + share * across[i];
    return [radius * Math.cos(angle), radius * Math.sin(angle), p[2] * (1 - share) + q[2] * share];
  }
}

/* The corners of a triangle of a flank in the order that is anticlockwise against the flank's normals. */
function outward({ points, normals }, [a, b, c]) {
  const side = (k) => [0, 1, 2].map((i) => points[3 * k + i] - points[3 * a + i]);
  const facing = crossed(side(b), side(c)).reduce((sum, v, i) => sum + v * (normals[3 * a + i] + normals[3 * b + i] + normals[3 * c + i]), 0);
  return facing < 0 ? [a, c, b] : [a, b, c];
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

/* The view in an element. `asks` says what to show: position(), shown(name), open(), seeThrough(); `drawn(pairs)` is
 * told the positions of the pairs in contact after each drawing. Marks, scale and axes are on a canvas of their own in
 * front of the teeth. */
class TeethView {
  constructor(holder, scene, asks) {
    this.holder = holder;
    this.asks = asks;
    this.waiting = false;
    [this.canvas, this.marks] = ["teeth", "marks"].map((name) => holder.appendChild(Object.assign(document.createElement("canvas"), { className: name })));
    this.context = this.marks.getContext("2d");
    this.missing = holder.appendChild(document.createElement("p"));
    this.missing.textContent = "The teeth are not drawn: this browser offers no WebGL here. Turn on its graphics acceleration or open the page in another browser. Contacts, scale and axes are as they should be.";
    THREE.ColorManagement.enabled = false; /* colours as the page's, not as light adds */
    this.renderer = this._renderer();
    this.world = new THREE.Scene();
    /* from 0.28 away from the light to 1.28 towards it, on either side of a surface */
    this.light = new THREE.HemisphereLight(new THREE.Color(1.28, 1.28, 1.28), new THREE.Color(0.28, 0.28, 0.28), Math.PI);
    this.cut = new THREE.Plane();
    this.world.add(this.light);
    this.bodies = scene.bodies.map((body) => (body.name === "wheel" ? this._veiled(body) : this._opened(body)));
    this.camera = new THREE.OrthographicCamera();
    this.camera.up.fromArray(scene.view[1]);
    this.controls = new THREE.OrbitControls(this.camera, this.marks);
    Object.assign(this.controls, { minZoom: 0.1, maxZoom: 200, rotateSpeed: 0.66 });
    this.show(scene);
    this.controls.target.fromArray(scene.centre);
    this.camera.position.fromArray(scene.view[2]).add(this.controls.target);
    this.controls.update();
    this.controls.saveState();
    this._listen();
  }

  reset() {
    this.controls.reset();
  }

  _renderer() {
    const context = this.canvas.getContext("webgl2", { antialias: false, stencil: true });
    this.missing.hidden = context !== null;
    if (!context) return null;
    const renderer = new THREE.WebGLRenderer({ canvas: this.canvas, context });
    Object.assign(renderer, { localClippingEnabled: true, sortObjects: false, outputColorSpace: THREE.LinearSRGBColorSpace });
    renderer.setClearColor(0xf7f9fb);
    return renderer;
  }

  /* ---- teeth ---------------------------------------------------------------------------------------------- */

  _mesh(body, material) {
    const mesh = new THREE.InstancedMesh(body.tooth, material, body.copies.length);
    body.copies.forEach((turn, k) => mesh.setMatrixAt(k, new THREE.Matrix4().makeRotationZ(turn)));
    Object.assign(mesh, { frustumCulled: false, matrixAutoUpdate: false });
    this.world.add(mesh);
    return mesh;
  }

  _paint(body, options) {
    return new THREE.MeshLambertMaterial({ color: coloured(body), vertexColors: true, stencilWrite: true, ...options });
  }

  /* A body that may be cut open. The stencil is 2 where its outside is seen, 3 where its inside is: there the cut goes
   * through material, and its plane is seen. */
  _opened(body) {
    const marked = { stencilZPass: THREE.ReplaceStencilOp, clippingPlanes: [this.cut] };
    const meshes = [this._mesh(body, this._paint(body, { ...marked, stencilRef: 2 })), this._mesh(body, this._paint(body, { ...marked, stencilRef: 3, side: THREE.BackSide }))];
    const material = new THREE.MeshBasicMaterial({ stencilWrite: true, stencilFunc: THREE.EqualStencilFunc, stencilRef: 3 });
    const cap = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), material);
    cap.frustumCulled = false;
    this.world.add(cap);
    return { meshes, cap };
  }

  /* A body that may be seen through, where the other one is behind it. Its depths come first: only its nearest surface
   * is seen. */
  _veiled(body) {
    const meshes = [{ colorWrite: false }, { stencilFunc: THREE.EqualStencilFunc }, { stencilFunc: THREE.NotEqualStencilFunc, transparent: true }];
    return { meshes: meshes.map((options) => this._mesh(body, this._paint(body, options))) };
  }

  /* Take new teeth, placements and contacts; the camera stays. */
  show(scene) {
    this.scene = scene;
    const centre = new THREE.Vector3(...scene.centre), normal = new THREE.Vector3(...scene.cut.normal);
    this.reach = 0;
    scene.bodies.forEach(({ tooth, matrices }, k) => {
      const { meshes } = this.bodies[k], points = tooth.attributes.position.array;
      if (meshes[0].geometry !== tooth) meshes[0].geometry.dispose();
      for (const mesh of meshes) mesh.geometry = tooth;
      let furthest = 0;
      for (let i = 0; i < points.length; i += 3) furthest = Math.max(furthest, Math.hypot(points[i], points[i + 1], points[i + 2]));
      this.reach = Math.max(this.reach, furthest + centre.distanceTo(new THREE.Vector3(matrices[3], matrices[7], matrices[11])));
    });
    for (const { cap } of this.bodies.filter((body) => body.cap)) {
      cap.position.copy(centre).addScaledVector(normal, scene.cut.offset - normal.dot(centre));
      cap.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), normal);
      cap.scale.setScalar(4 * this.reach);
    }
  }

  _placed(position) {
    const open = this.asks.open(), { cut, bodies } = this.scene, away = this.camera.getWorldDirection(new THREE.Vector3());
    this.cut.normal.fromArray(cut.normal).negate();
    this.cut.constant = open ? cut.offset : 1e6;
    bodies.forEach((body, k) => {
      const { meshes, cap } = this.bodies[k], shown = this.asks.shown(body.name);
      for (const mesh of meshes) {
        mesh.visible = shown;
        mesh.matrix.set(...body.matrices.subarray(12 * position, 12 * position + 12), 0, 0, 0, 1);
        mesh.matrixWorldNeedsUpdate = true;
        if (mesh.material.transparent) mesh.material.opacity = this.asks.seeThrough() ? 0.4 : 1;
        if (mesh.material.side === THREE.BackSide) mesh.visible = shown && open;
      }
      if (!cap) return;
      cap.visible = shown && open;
      cap.material.color.copy(coloured(body)).multiplyScalar(0.62 + 0.3 * away.dot(this.cut.normal));
    });
    this.light.position.set(-0.35, 0.45, 0.82).applyQuaternion(this.camera.quaternion);
  }

  /* ---- contacts, axes, scale ------------------------------------------------------------------------------ */

  /* CSS pixels of a millimetre */
  scale() {
    return (0.52 * Math.min(this.holder.clientWidth / 1.5, this.holder.clientHeight) / this.scene.radius) * this.camera.zoom;
  }

  projected(p) {
    const { x, y } = new THREE.Vector3(...p).project(this.camera);
    return [(0.5 + 0.5 * x) * this.holder.clientWidth, (0.5 - 0.5 * y) * this.holder.clientHeight];
  }

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
    const x = 18, y = this.holder.clientHeight - 20;
    this.context.setLineDash([]);
    this.context.strokeStyle = this.context.fillStyle = "#1c2733";
    this.context.lineWidth = 2;
    this.context.strokeRect(x, y, length * k, 0);
    this.context.font = "13px system-ui, sans-serif";
    this.context.fillText(`${Number(length.toPrecision(3))} mm`, x, y - 7);
    const turn = this.camera.matrixWorldInverse.elements, corner = [this.holder.clientWidth - 52, this.holder.clientHeight - 48];
    ["x", "y", "z"].forEach((name, axis) => {
      const u = corner[0] + 32 * turn[4 * axis], v = corner[1] - 32 * turn[4 * axis + 1];
      this.context.beginPath();
      this.context.moveTo(...corner);
      this.context.lineTo(u, v);
      this.context.stroke();
      this.context.fillText(name, u + 4 * Math.sign(u - corner[0]) - 3, v + 4);
    });
  }

  /* ---- drawing -------------------------------------------------------------------------------------------- */

  /* Teeth in `sharpness` pixels of the canvas a CSS pixel: the cut of slender triangles allows no other smoothing. */
  resized(sharpness) {
    const { clientWidth: width, clientHeight: height } = this.holder;
    const fit = (canvas, ratio, set) => {
      const [wide, high] = [width, height].map((v) => Math.max(1, Math.round(v * ratio)));
      if (canvas.width !== wide || canvas.height !== high) set(wide, high);
    };
    fit(this.canvas, sharpness, (wide, high) => this.renderer?.setSize(wide, high, false));
    fit(this.marks, 2, (wide, high) => Object.assign(this.marks, { width: wide, height: high }));
    this.context.setTransform(2, 0, 0, 2, 0, 0);
    this.context.clearRect(0, 0, width, height);
    const k = (2 * this.scale()) / this.camera.zoom;
    Object.assign(this.camera, { left: -width / k, right: width / k, top: height / k, bottom: -height / k, near: -1.1 * this.reach, far: 1.1 * this.reach });
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }

  draw(sharpness = 2) {
    const position = this.asks.position();
    this.resized(sharpness);
    this._placed(position);
    this.renderer?.render(this.world, this.camera);
    const pairs = this.drawContacts(position);
    this.drawScale();
    this.asks.drawn(pairs);
  }

  /* Quickly while it moves, sharply when it rests. */
  redraw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw(1);
      clearTimeout(this.rest);
      this.rest = setTimeout(() => this.draw(), 200);
    });
  }

  /* Mouse and fingers are the controls' own; keys turn and zoom. */
  _listen() {
    const turn = 0.08, keys = {
      ArrowLeft: () => this.controls.rotateLeft(-turn), ArrowRight: () => this.controls.rotateLeft(turn),
      ArrowUp: () => this.controls.rotateUp(-turn), ArrowDown: () => this.controls.rotateUp(turn),
      "+": () => this.controls.dollyOut(1.15), "-": () => this.controls.dollyIn(1.15),
    };
    this.holder.addEventListener("keydown", (event) => {
      if (!keys[event.key]) return;
      keys[event.key]();
      event.preventDefault();
    });
    this.controls.addEventListener("change", () => this.redraw());
    window.addEventListener("resize", () => this.redraw());
    for (const [name, lost] of [["webglcontextlost", true], ["webglcontextrestored", false]])
      this.canvas.addEventListener(name, () => {
        this.missing.hidden = !lost;
        this.redraw();
      });
  }
}

function coloured(body) {
  return new THREE.Color(...body.colour.map((c) => c / 255));
}
