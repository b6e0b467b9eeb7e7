"use strict";
/* The teeth in contact: a small software renderer with a depth buffer, so that the view needs no graphics driver.
 * Input: the JSON element #scene. Lengths in mm, all frames right-handed unless the design is left-handed. */
(function () {
  const source = document.getElementById("scene");
  if (!source) return;
  const scene = JSON.parse(source.textContent);
  const canvas = document.getElementById("view");
  const slider = document.getElementById("view-angle");
  const readout = document.getElementById("view-readout");
  const play = document.getElementById("view-play");
  const context = canvas.getContext("2d");
  const light = normalised([-0.35, 0.45, 0.82]);
  const camera = { rows: scene.view.map((row) => row.slice()), zoom: 1, pan: [0, 0] };
  let layers = [];

  function decoded(text, Kind) {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    return new Kind(bytes.buffer);
  }

  function normalised(v) {
    const length = Math.hypot(...v);
    return v.map((c) => c / length);
  }

  const bodies = scene.bodies.map((body) => ({
    name: body.name,
    colour: body.colour,
    copies: body.copies,
    matrices: decoded(body.matrices, Float32Array),
    patches: body.patches.map((patch) => ({
      active: patch.active,
      points: decoded(patch.points, Float32Array),
      normals: decoded(patch.normals, Float32Array),
      triangles: decoded(patch.triangles, Uint32Array),
    })),
  }));

  /* ---- geometry ------------------------------------------------------------------------------------------- */

  /* Body to screen: the placement at a position, after a turn of the copy about the body's own axis. */
  function placed(body, position, turn) {
    const m = body.matrices.subarray(12 * position, 12 * position + 12);
    const c = Math.cos(turn), s = Math.sin(turn), out = new Float64Array(12);
    for (let row = 0; row < 3; row++) {
      const [a, b, z, t] = m.subarray(4 * row, 4 * row + 4);
      out.set([a * c + b * s, b * c - a * s, z, t], 4 * row);
    }
    return out;
  }

  function scale() {
    return (0.52 * Math.min(canvas.width / 1.5, canvas.height) / scene.radius) * camera.zoom;
  }

  function projected(p) {
    const d = [p[0] - scene.centre[0], p[1] - scene.centre[1], p[2] - scene.centre[2]];
    const k = scale();
    const [right, up, near] = camera.rows.map((row) => row[0] * d[0] + row[1] * d[1] + row[2] * d[2]);
    return [canvas.width / 2 + camera.pan[0] + k * right, canvas.height / 2 + camera.pan[1] - k * up, near];
  }

  /* ---- renderer ------------------------------------------------------------------------------------------- */

  function resized() {
    const ratio = Math.min(window.devicePixelRatio || 1, 1.5);
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width === width && canvas.height === height && layers.length) return;
    canvas.width = width;
    canvas.height = height;
    layers = bodies.map(() => ({ depth: new Float32Array(width * height), shade: new Float32Array(width * height) }));
  }

  /* Values of a vertex on the screen: place (2), depth, shade, and how far inside the cut it lies. */
  const VALUES = 5;

  function drawPatch(layer, patch, matrix, cut) {
    const { points, normals, triangles } = patch;
    const vertices = points.length / 3, screen = new Float64Array(VALUES * vertices);
    for (let i = 0; i < vertices; i++) {
      const x = points[3 * i], y = points[3 * i + 1], z = points[3 * i + 2];
      const p = [0, 4, 8].map((r) => matrix[r] * x + matrix[r + 1] * y + matrix[r + 2] * z + matrix[r + 3]);
      const [u, v, near] = projected(p);
      const kept = cut ? cut.offset - cut.normal[0] * p[0] - cut.normal[1] * p[1] - cut.normal[2] * p[2] : 1;
      const nx = normals[3 * i], ny = normals[3 * i + 1], nz = normals[3 * i + 2];
      const n = [0, 4, 8].map((r) => matrix[r] * nx + matrix[r + 1] * ny + matrix[r + 2] * nz);
      const seen = camera.rows.map((row) => row[0] * n[0] + row[1] * n[1] + row[2] * n[2]);
      const side = seen[2] >= 0 ? 1 : -1;
      const lit = side * (seen[0] * light[0] + seen[1] * light[1] + seen[2] * light[2]);
      const shade = (0.78 + 0.5 * lit) * (side > 0 ? 1 : 0.9) * (patch.active ? 1 : 0.82);
      screen.set([u, v, near, shade, kept], VALUES * i);
    }
    for (let k = 0; k < triangles.length; k += 3)
      drawTriangle(layer, screen, VALUES * triangles[k], VALUES * triangles[k + 1], VALUES * triangles[k + 2]);
  }

  function drawTriangle(layer, s, a, b, c) {
    const ax = s[a], ay = s[a + 1], bx = s[b], by = s[b + 1], cx = s[c], cy = s[c + 1];
    const area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
    if (!(Math.abs(area) > 1e-9)) return; /* degenerate, or a point that does not exist (NaN) */
    const left = Math.max(0, Math.ceil(Math.min(ax, bx, cx))), right = Math.min(canvas.width - 1, Math.floor(Math.max(ax, bx, cx)));
    const top = Math.max(0, Math.ceil(Math.min(ay, by, cy))), low = Math.min(canvas.height - 1, Math.floor(Math.max(ay, by, cy)));
    for (let y = top; y <= low; y++)
      for (let x = left; x <= right; x++) {
        const wa = ((bx - x) * (cy - y) - (cx - x) * (by - y)) / area;
        const wb = ((cx - x) * (ay - y) - (ax - x) * (cy - y)) / area;
        const wc = 1 - wa - wb;
        if (wa < 0 || wb < 0 || wc < 0) continue;
        const near = wa * s[a + 2] + wb * s[b + 2] + wc * s[c + 2], at = y * canvas.width + x;
        if (near > layer.depth[at] && wa * s[a + 4] + wb * s[b + 4] + wc * s[c + 4] > 0) {
          layer.depth[at] = near;
          layer.shade[at] = (wa * s[a + 3] + wb * s[b + 3] + wc * s[c + 3]);
        }
      }
  }

  const paper = [247, 249, 251];

  function blend(data, to, body, layer, at, cover, fresh) {
    const there = layer.depth[at] !== -Infinity, colour = bodies[body].colour;
    for (let i = 0; i < 3; i++) {
      const under = fresh ? paper[i] : data[to + i];
      data[to + i] = there ? under * (1 - cover) + cover * colour[i] * layer.shade[at] : under;
    }
    data[to + 3] = 255;
  }

  function drawBodies(position) {
    const open = document.getElementById("view-cut").checked;
    bodies.forEach((body, k) => {
      layers[k].depth.fill(-Infinity);
      if (!document.getElementById(`view-${body.name}`).checked) return;
      for (const turn of body.copies) {
        const matrix = placed(body, position, turn);
        for (const patch of body.patches) drawPatch(layers[k], patch, matrix, body.name === "pinion" && open ? scene.cut : null);
      }
    });
    const image = context.createImageData(canvas.width, canvas.height);
    const see = document.getElementById("view-see-through").checked ? 0.4 : 1;
    const [first, second] = layers;
    for (let at = 0, to = 0; at < first.depth.length; at++, to += 4) {
      const behind = first.depth[at] <= second.depth[at] ? 0 : 1;
      const veiled = layers[behind].depth[at] !== -Infinity && bodies[1 - behind].name === "wheel";
      blend(image.data, to, behind, layers[behind], at, 1, true);
      blend(image.data, to, 1 - behind, layers[1 - behind], at, veiled ? see : 1, false);
    }
    context.putImageData(image, 0, 0);
  }

  /* ---- contacts, axes, scale ------------------------------------------------------------------------------ */

  function drawLine(points, colour, width, dash) {
    context.beginPath();
    points.forEach((p, i) => {
      const [u, v] = projected(p);
      if (i) context.lineTo(u, v);
      else context.moveTo(u, v);
    });
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.setLineDash(dash || []);
    context.stroke();
  }

  /* the path of contact, one stroke for each branch */
  function strokes() {
    const found = [[]];
    scene.contacts.forEach((contact, position) => {
      if (!contact || scene.breaks.includes(position)) found.push([]);
      if (contact) found[found.length - 1].push(contact.point);
    });
    return found;
  }

  function outlined(contact) {
    if (contact.line) return contact.line;
    if (!contact.axes) return [];
    const [major, minor] = contact.axes;
    return Array.from({ length: 49 }, (_, i) => {
      const c = Math.cos((i * Math.PI) / 24), s = Math.sin((i * Math.PI) / 24);
      return contact.point.map((p, axis) => p + c * major[axis] + s * minor[axis]);
    });
  }

  function drawContacts(position) {
    const pairs = [];
    const steps = scene.steps_per_pitch, last = scene.contacts.length;
    for (let at = position % steps; at < last; at += steps) if (scene.contacts[at]) pairs.push(at);
    if (!scene.contacts.some((contact) => contact && contact.line)) for (const stroke of strokes()) drawLine(stroke, "#6b7885", 1.2, [4, 4]);
    for (const at of pairs) {
      const contact = scene.contacts[at], followed = at === position;
      const outline = outlined(contact);
      drawLine(outline, "#ffffff", followed ? 4.5 : 3.5);
      drawLine(outline, contact.flagged ? "#c0273d" : "#10202e", followed ? 2.4 : 1.4);
      if (contact.line) continue;
      const [u, v] = projected(contact.point);
      context.beginPath();
      context.arc(u, v, followed ? 4.5 : 3, 0, 2 * Math.PI);
      context.fillStyle = contact.flagged ? "#c0273d" : followed ? "#ffd23f" : "#ffffff";
      context.setLineDash([]);
      context.fill();
      context.strokeStyle = "#10202e";
      context.lineWidth = 1;
      context.stroke();
    }
    return pairs;
  }

  function drawScale() {
    const k = scale();
    const raw = 120 / k, power = 10 ** Math.floor(Math.log10(raw));
    const length = power * (raw / power >= 5 ? 5 : raw / power >= 2 ? 2 : 1);
    const x = 18, y = canvas.height - 20;
    context.setLineDash([]);
    context.strokeStyle = context.fillStyle = "#1c2733";
    context.lineWidth = 2;
    context.strokeRect(x, y, length * k, 0);
    context.font = "13px system-ui, sans-serif";
    context.fillText(`${Number(length.toPrecision(3))} mm`, x, y - 7);
    const corner = [canvas.width - 52, canvas.height - 48];
    ["x", "y", "z"].forEach((name, axis) => {
      const u = corner[0] + 32 * camera.rows[0][axis], v = corner[1] - 32 * camera.rows[1][axis];
      context.beginPath();
      context.moveTo(...corner);
      context.lineTo(u, v);
      context.stroke();
      context.fillText(name, u + 4 * Math.sign(u - corner[0]) - 3, v + 4);
    });
  }

  function fixed(value, digits) {
    if (value === null) return "–";
    const rounded = Number(value.toFixed(digits)) || 0; // no minus before a zero
    return rounded.toFixed(digits).replace("-", "−");
  }

  function draw() {
    const position = Number(slider.value);
    resized();
    drawBodies(position);
    const pairs = drawContacts(position);
    drawScale();
    const contact = scene.contacts[position];
    readout.textContent =
      `pinion ${fixed(scene.angles_deg[position], 2)}°, wheel ${fixed(scene.wheel_deg[position], 4)}°, ` +
      `transmission error ${fixed(scene.error_arcsec[position], 4)}″ of this pair; ` +
      `${pairs.length} ${pairs.length === 1 ? "pair" : "pairs"} inside the window` +
      (contact && contact.flagged ? `; ${contact.flagged}` : "");
  }

  let waiting = false;
  function redraw() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      draw();
    });
  }

  /* ---- hand on mouse, finger and keys --------------------------------------------------------------------- */

  function orbit(dx, dy) {
    const turn = (p, q, angle) => {
      const c = Math.cos(angle), s = Math.sin(angle);
      const [a, b] = [camera.rows[p], camera.rows[q]];
      camera.rows[p] = a.map((v, i) => c * v + s * b[i]);
      camera.rows[q] = b.map((v, i) => c * v - s * a[i]);
    };
    turn(2, 0, -dx);
    turn(2, 1, dy);
  }

  let held = null;
  canvas.addEventListener("pointerdown", (event) => {
    held = [event.clientX, event.clientY];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    const dx = event.clientX - held[0], dy = event.clientY - held[1];
    held = [event.clientX, event.clientY];
    if (event.shiftKey || event.buttons === 2) {
      const ratio = canvas.width / canvas.clientWidth;
      camera.pan = [camera.pan[0] + ratio * dx, camera.pan[1] + ratio * dy];
    } else orbit(0.008 * dx, 0.008 * dy);
    redraw();
  });
  canvas.addEventListener("pointerup", () => (held = null));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      camera.zoom = Math.min(200, Math.max(0.1, camera.zoom * Math.exp(-0.0015 * event.deltaY)));
      redraw();
    },
    { passive: false },
  );
  canvas.addEventListener("keydown", (event) => {
    const turns = { ArrowLeft: [-0.08, 0], ArrowRight: [0.08, 0], ArrowUp: [0, -0.08], ArrowDown: [0, 0.08] };
    if (turns[event.key]) orbit(...turns[event.key]);
    else if (event.key === "+") camera.zoom *= 1.15;
    else if (event.key === "-") camera.zoom /= 1.15;
    else return;
    event.preventDefault();
    redraw();
  });
  document.getElementById("view-reset").addEventListener("click", () => {
    camera.rows = scene.view.map((row) => row.slice());
    camera.zoom = 1;
    camera.pan = [0, 0];
    redraw();
  });
  slider.addEventListener("input", redraw);
  for (const box of document.querySelectorAll("#view-controls input[type=checkbox]")) box.addEventListener("change", redraw);
  window.addEventListener("resize", redraw);

  let timer = null;
  play.addEventListener("click", () => {
    if (timer) {
      clearInterval(timer);
      timer = null;
    } else
      timer = setInterval(() => {
        slider.value = (Number(slider.value) + 1) % scene.angles_deg.length;
        redraw();
      }, 90);
    play.textContent = timer ? "Pause" : "Play";
  });

  draw();
})();
