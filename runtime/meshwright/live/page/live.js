/* The page: keys to the left, what the solver makes of them to the right. */

const data = JSON.parse(document.getElementById("data").textContent);
const ARCSEC = Math.PI / 648000, DEGREE = Math.PI / 180, DIGITS = 9;
const element = id => document.getElementById(id);
const made = (tag, attributes = {}, text = "") => Object.assign(document.createElement(tag), attributes, { textContent: text });
const shown = v => Number.isFinite(v) ? Number(v.toPrecision(DIGITS)).toString() : "–";

/* Half of a slider's way: a fifth of the value, or this much about 0. */
const WAY = { mm: 0.5, deg: 0.5 }, STEPS = 200;

let solver, fields, state, solids = null, shownState = null, pending = false;

function bytes(base64) { return Uint8Array.from(atob(base64.trim()), c => c.charCodeAt(0)); }

function allowed(key, value) {
  if (!Number.isFinite(value)) return "is not a number; write one";
  const b = key.bounds;
  if ("gt" in b && !(value > b.gt)) return `must be greater than ${shown(b.gt)}; choose a larger value`;
  if ("ge" in b && !(value >= b.ge)) return `must not be less than ${shown(b.ge)}; choose a larger value`;
  if ("lt" in b && !(value < b.lt)) return `must be less than ${shown(b.lt)}; choose a smaller value`;
  if ("le" in b && !(value <= b.le)) return `must not be greater than ${shown(b.le)}; choose a smaller value`;
  return null;
}

function field(key) {
  const way = key.value !== 0 ? 0.2 * Math.abs(key.value) : WAY[key.unit] ?? 1;
  const box = made("div", { className: "key" }), id = `key-${key.place}`;
  const number = made("input", { type: "number", step: "any", id, value: shown(key.value) });
  const slider = made("input", { type: "range", min: -STEPS, max: STEPS, step: 1, value: 0, id: `slide-${key.place}` });
  slider.setAttribute("aria-label", key.key);
  box.append(made("label", { htmlFor: id }, key.key.replaceAll("_", "_\u200b")), number, made("span", { className: "unit" }, key.unit.replaceAll("_", "_\u200b")), slider,
             made("span", { className: "meaning" }, `[${key.table}] ${key.meaning}`));
  const it = { key, box, number, slider, value: key.value };
  slider.addEventListener("input", () => {
    const at = Number(slider.value);
    const value = at === 0 ? key.value : Number((key.value + way * at / STEPS).toPrecision(DIGITS));
    number.value = shown(value);
    changed(it, value);
  });
  number.addEventListener("input", () => {
    slider.value = Math.round((Number(number.value) - key.value) / way * STEPS);
    changed(it, number.value === "" ? NaN : Number(number.value));
  });
  return it;
}

/* The value of a key, all its digits; its box shows those that there is room for. */
function changed(it, value) {
  it.value = value;
  ask();
}

function ask() {
  if (pending) return;
  pending = true;
  requestAnimationFrame(() => { pending = false; solve(); draw(); });
}

/* Solve one mesh cycle of the keys as they stand. */
function solve() {
  const faults = [], given = data.given.map(v => v === null ? NaN : v);
  for (const it of fields) {
    const wrong = allowed(it.key, it.value);
    it.box.classList.toggle("wrong", wrong !== null);
    if (wrong) faults.push(`${it.key.place} = ${it.number.value}: ${wrong}`);
    if (Number.isFinite(data.given[it.key.index] ?? NaN) || it.value !== 0) given[it.key.index] = it.value * it.key.factor;
  }
  if (faults.length) { state = { faults }; return; }
  for (const [a, b] of data.above)
    if (given[a] <= given[b]) {
      const place = k => fields.find(it => it.key.index === k)?.key.place ?? `parameter ${k}`;
      state = { faults: [`${place(a)}: must be greater than ${place(b)}; choose a larger value`] };
      return;
    }
  const begun = performance.now(), done = solver.complete(given);
  if (done.fault) { state = { faults: [`${done.fault}; change ${done.keys.join(" or ")}`] }; return; }
  const zero = data.reference < 0 ? 0 : done.parameters[data.reference], n = data.positions, angles = new Float64Array(n + 1);
  const middle = zero + data.from_reference;
  for (let k = 0; k < n; k++) angles[k] = middle + (k / (n - 1) - 0.5) * data.pitch;
  angles[n] = zero;
  const rows = solver.rows(angles), time = performance.now() - begun, reference = rows.pop();
  state = { faults: [], given, parameters: done.parameters, sizes: done.sizes, rows, reference, time, separation: done.parameters[data.separation] };
}

/* What is shown of a row, in the units of the page and the design's hand. */
function numbersOf(row) {
  const [major, minor] = semiAxes(row, state.separation), sign = data.mirror, flip = [1, sign, 1];
  const wheel = row.pointlike ? onWheel(row, data).point : [NaN, NaN, NaN];
  const point = i => row.pointlike ? flip[i] * row.row[HEAD.point + i] : NaN, only = v => row.pointlike ? v : NaN;
  const listed = [
    ["pinion-angle", "pinion angle", sign * row.angle / DEGREE, "deg"],
    ["wheel-angle", "wheel angle", sign * row.wheelAngle / DEGREE, "deg"],
    ["transmission-error", "transmission error", sign * row.error / ARCSEC, "arcsec"],
    ["relative-error", "transmission error, relative", sign * (row.error - state.reference.error) / ARCSEC, "arcsec"],
    ["instantaneous-ratio", "instantaneous ratio", only(row.row[HEAD.ratio]), ""],
    ["contact-point", "contact point x", point(0), "mm"], ["contact-point", "contact point y", point(1), "mm"],
    ["contact-point", "contact point z", point(2), "mm"],
    ["wheel-place", "radius on the wheel", Math.hypot(wheel[0], wheel[1]), "mm"],
    ["wheel-place", "axial position on the wheel", wheel[2], "mm"],
    ["semi-axes", "semi-major axis", major, "mm"], ["semi-axes", "semi-minor axis", minor, "mm"],
    ["curvatures", "relative curvature, smaller", only(row.row[HEAD.least]), "1/mm"],
    ["curvatures", "relative curvature, larger", only(row.row[HEAD.most]), "1/mm"],
    ["residual", "distance of the flanks' points", only(row.row[HEAD.distance]), "mm"],
    ["iterations", "steps of the last solution", row.iterations, ""],
  ];
  data.unknowns.forEach((u, k) => {
    if (k === data.error) return;
    const angle = u.unit === "rad";
    listed.push([`unknown-${u.name}`, u.name, only(data.factors[k] * row.x[k] / (angle ? DEGREE : 1)), angle ? "deg" : u.unit]);
  });
  return listed;
}

const WHAT = [
  ["pinion-angle", "pinion angle", "The input angle of the drive; the cycle runs over one pitch of the pinion, about the reference angle or, where the flanks as written touch elsewhere only, about the middle of their contact."],
  ["wheel-angle", "wheel angle", "The angle of the wheel at which its flank touches the pinion's: pinion angle times ratio, and the transmission error."],
  ["transmission-error", "transmission error", "Wheel angle less pinion angle over gear ratio, raw."],
  ["relative-error", "transmission error, relative", "The same less its value at the reference angle."],
  ["instantaneous-ratio", "instantaneous ratio", "d(wheel angle)/d(pinion angle): lever arm of the pinion over that of the wheel, of the common normal."],
  ["contact-point", "contact point", "Where both flanks have the same place and opposed normals; fixed frame."],
  ["wheel-place", "place on the wheel", "The contact point in the wheel's own frame, whose z axis is the wheel's axis."],
  ["semi-axes", "semi-axes", "Of the ellipse on which the gap between the flanks is the separation δ of the design: sqrt(2 δ / relative curvature)."],
  ["curvatures", "relative curvatures", "Principal curvatures of the gap between the flanks; positive without interference."],
  ["residual", "distance of the flanks' points", "What is left of the contact equations: how far the points found on both flanks are apart."],
  ["iterations", "steps", "Newton steps of the last solution at this angle."],
  ["peak-to-peak", "transmission error, peak to peak", "Largest less smallest transmission error of this pair over the cycle."],
  ["size", "derived sizes", "What follows from the keys by the drive's rules."],
  ["contact", "contact equations", "Both flanks have one place and one normal."],
];

/* What the contact equations are solved for, unknowns apart. */
const SOLVED = ["transmission-error", "wheel-angle", "contact-point"];

function table(id, listed) {
  const body = element(id).tBodies[0];
  body.replaceChildren(...listed.map(([what, name, value, unit]) => {
    const row = made("tr"), first = made("td"), number = made("td", { className: "number" }, shown(value));
    number.dataset.name = name;
    first.append(made("a", { href: `#what-${what}` }, name.replaceAll("_", "_\u200b")));
    row.append(first, number, made("td", {}, unit));
    return row;
  }));
}

/* What the page does not look for, where it finds no tangency. */
const EDGES = "; this page looks for tangencies alone: an edge or a corner may touch, which meshwright tca and report tell";

/* Status and flags of the cycle and of one row, in words: [kind, sentence]. */
function sentences(row) {
  const { rows } = state, n = rows.length, found = [], by = new Map(), flags = new Map();
  for (const r of rows) {
    by.set(r.status, (by.get(r.status) ?? 0) + 1);
    if (r.pointlike) for (const name of flagsOf(r)) flags.set(name, (flags.get(name) ?? 0) + 1);
  }
  for (const [code, count] of by) {
    const it = data.status[code];
    found.push([code >= 0 ? code === 2 ? "note" : "good" : "warn", `${count} of ${n} positions: ${it.word.replaceAll("_", " ")} – ${it.words}${code < 0 ? EDGES : ""}`]);
  }
  for (const [name, count] of flags) {
    const it = data.flags.find(f => f.name === name);
    found.push([it.impossible ? "warn" : "note", `${name} at ${count} of ${n} positions: ${it.words}`]);
  }
  const here = data.status[row.status], marks = row.pointlike ? flagsOf(row) : [];
  found.push(["note", `at this position: ${here.word.replaceAll("_", " ")}${marks.length ? ", " + marks.join(", ") : ""}`]);
  return found;
}

function flagsOf(row) { return [...new Set(data.flags.filter((f, bit) => (row.flags >>> bit) & 1).map(f => f.name))]; }

function draw() {
  const wrong = state.faults.length > 0;
  element("results").classList.toggle("wrong", wrong);
  document.body.dataset.solved = wrong ? "no" : "yes";
  if (wrong) {
    element("state").replaceChildren(...state.faults.map(text => made("p", { className: "warn" }, text)));
    element("timing").textContent = "nothing is solved; plots and numbers are empty until the keys are right";
    for (const id of ["numbers", "totals"]) element(id).tBodies[0].replaceChildren();
    for (const id of ["plot-error", "plot-axes", "plot-path"]) element(id).replaceChildren();
    return;
  }
  const { rows, separation } = state, row = rows[Number(element("position").value)];
  element("state").replaceChildren(...sentences(row).map(([kind, text]) => made("p", { className: kind }, text)));
  element("timing").textContent = `${rows.length} positions solved in ${state.time.toFixed(1)} ms`;
  table("numbers", numbersOf(row));
  const errors = rows.map(r => r.error / ARCSEC).filter(Number.isFinite);
  table("totals", [["peak-to-peak", "transmission error, peak to peak", errors.length ? Math.max(...errors) - Math.min(...errors) : NaN, "arcsec"],
    ...data.sizes.map((s, k) => ["size", s.name, state.sizes[k] / s.factor, s.factor === 1 ? s.unit : "deg"])]);
  pictures(row, separation);
  teeth();
}

function pictures(row, separation) {
  const { rows } = state, sign = data.mirror, x = r => sign * r.angle / DEGREE, xs = range(rows.map(x));
  const error = rows.map(r => [x(r), sign * (r.error - state.reference.error) / ARCSEC]);
  /* a scale on which round-off is a straight line */
  const least = 10 * data.round_off / ARCSEC;
  plots.error.begin(xs, range([-least, least, ...error.map(p => p[1])]));
  plots.error.line(error, "first");
  plots.error.vertical(x(row));
  plots.error.end();
  const axes = rows.map(r => semiAxes(r, separation));
  plots.axes.begin(xs, axes.flat().some(Number.isFinite) ? range([0, ...axes.flat()]) : [0, 1]);
  if (!axes.flat().some(Number.isFinite)) plots.axes.note("no contact ellipse at any position");
  plots.axes.line(rows.map((r, k) => [x(r), axes[k][0]]), "first");
  plots.axes.line(rows.map((r, k) => [x(r), axes[k][1]]), "second");
  plots.axes.vertical(x(row));
  plots.axes.end();
  path(row, separation);
}

/* The teeth, where they can be seen; new flanks only for new keys. */
function teeth() {
  const place = element("view").getBoundingClientRect();
  if (!solids || state.faults.length || place.bottom < 0 || place.top > window.innerHeight) return;
  if (shownState !== state) { shownState = state; solids.show(state); }
  else solids.view?.redraw();
}

function outline(row, separation) {
  const { point, major, minor } = onWheel(row, data), [a, b] = semiAxes(row, separation), points = [];
  for (let k = 0; k <= 48; k++) {
    const t = 2 * Math.PI * k / 48, u = a * Math.cos(t), v = b * Math.sin(t);
    points.push(flat(point.map((c, i) => c + u * major[i] + v * minor[i]), data));
  }
  return points;
}

/* Range of what must be seen, and of what else is near: an ellipse close to line contact is longer than any flank. */
function within(must, other) {
  const [low, high] = range(must.some(Number.isFinite) ? must : other), reach = 0.6 * (high - low);
  return range([low, high, ...other.filter(v => v > low - reach && v < high + reach)]);
}

function path(row, separation) {
  const { rows } = state, known = rows.filter(r => r.pointlike), line = rows.map(r => r.pointlike ? flat(onWheel(r, data).point, data) : [NaN, NaN]);
  const every = Math.max(1, Math.floor(known.length / 10)), ellipses = known.filter((r, k) => k % every === 0).map(r => outline(r, separation));
  if (row.pointlike) ellipses.push(outline(row, separation));
  const [xs, ys] = [0, 1].map(i => within([...data.border.flat(), ...line].map(p => p[i]), ellipses.flat().map(p => p[i])));
  plots.path.begin(xs, ys, true);
  plots.path.segments(data.border, "border");
  ellipses.forEach((e, k) => plots.path.line(e, row.pointlike && k === ellipses.length - 1 ? "ellipse chosen" : "ellipse"));
  plots.path.line(line, "second");
  plots.path.end();
}

function explain() {
  const listed = [...WHAT, ...data.unknowns.filter((u, k) => k !== data.error).map(u => [`unknown-${u.name}`, u.name, `${u.meaning}; an unknown.`])];
  for (const [what, name, words] of listed) {
    const proved = { size: data.equations.derive, contact: data.equations.eval }[what] ?? [], says = made("dd", {}, words);
    if (proved.length) says.append(` Statements of the audit record: ${proved.join(", ")}.`);
    if (what.startsWith("unknown") || SOLVED.includes(what)) says.append(" Solved from the ", made("a", { href: "#what-contact" }, "contact equations"), ".");
    element("what").append(made("dt", { id: `what-${what}` }, name), says);
  }
  for (const s of data.sources) element("sources").append(made("li", {}, [s.author, s.title, s.year, s.where].filter(part => part !== null).join(", ")));
}

const axis = data.end_on ? ["x on the wheel, mm", "y on the wheel, mm"] : ["axial position on the wheel, mm", "radius on the wheel, mm"];
const plots = {
  error: new Plot("plot-error", ["pinion angle, deg", "relative error, arcsec"]),
  axes: new Plot("plot-axes", ["pinion angle, deg", "semi-axes, mm"]),
  path: new Plot("plot-path", axis),
};

function begin(module) {
  solver = new Solver(module, data);
  fields = data.keys.map(field);
  element("keys").append(...fields.map(it => it.box));
  element("label").textContent = data.label;
  for (const f of data.fixed) element("fixed").append(made("li", {}, `${f.place} = ${f.value}`));
  const position = element("position");
  position.max = data.positions - 1;
  position.value = Math.floor(data.positions / 2);
  position.addEventListener("input", draw);
  element("reset").addEventListener("click", () => {
    for (const it of fields) { it.number.value = shown(it.key.value); it.slider.value = 0; it.value = it.key.value; }
    ask();
  });
  window.addEventListener("resize", () => draw());
  window.addEventListener("scroll", () => { if (shownState !== state) teeth(); }, { passive: true });
  if (data.teeth) {
    element("teeth").hidden = false;
    element("view-apart").hidden = data.teeth.bodies.every(body => body.far);
    const ticked = name => element(`view-${name}`).checked;
    solids = new Solids(solver, data, element("view"), {
      position: () => Number(position.value), shown: ticked, open: () => ticked("cut"), seeThrough: () => ticked("see-through"), drawn: () => {},
    });
    element("view-reset").addEventListener("click", () => { solids.view?.reset(); });
    for (const box of element("view-controls").querySelectorAll("input")) box.addEventListener("change", () => solids.view?.redraw());
  }
  explain();
  solve();
  draw();
}

WebAssembly.compile(bytes(element("module").textContent)).then(begin).catch(error => {
  element("state").replaceChildren(made("p", { className: "warn" }, `this browser cannot run the page: ${error.message}`));
});
