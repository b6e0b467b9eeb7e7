"use strict";
/* The teeth in contact of the report: the JSON element #scene in a TeethView, with its controls. */
(function () {
  const source = document.getElementById("scene");
  if (!source) return;
  const scene = JSON.parse(source.textContent);
  const box = (name) => document.getElementById(`view-${name}`);
  const slider = box("angle"), readout = box("readout"), play = box("play");

  for (const body of scene.bodies) {
    body.matrices = decoded(body.matrices, Float32Array);
    const [points, normals, across, far] = ["points", "normals", "across", "far"].map((key) => decoded(body.tooth[key], Float32Array));
    body.tooth = closedTooth({ points, normals }, { points: turnedAboutAxis(points, across), normals: far }, across, decoded(body.tooth.triangles, Uint32Array));
  }

  function fixed(value, digits) {
    if (value === null) return "–";
    const rounded = Number(value.toFixed(digits)) || 0; // no minus before a zero
    return rounded.toFixed(digits).replace("-", "−");
  }

  function drawn(pairs) {
    const position = Number(slider.value), contact = scene.contacts[position];
    readout.textContent =
      `pinion ${fixed(scene.angles_deg[position], 2)}°, wheel ${fixed(scene.wheel_deg[position], 4)}°, ` +
      `transmission error ${fixed(scene.error_arcsec[position], 4)}″ of this pair ` +
      `(${fixed(scene.relative_error_arcsec[position], 4)}″ relative to that at the reference angle); ` +
      `${pairs.length} ${pairs.length === 1 ? "pair" : "pairs"} inside the window` +
      (contact && contact.flagged ? `; ${contact.flagged}` : "");
  }

  const view = new TeethView(document.getElementById("view"), scene, {
    position: () => Number(slider.value),
    shown: (name) => box(name).checked,
    open: () => box("cut").checked,
    seeThrough: () => box("see-through").checked,
    drawn,
  });
  box("reset").addEventListener("click", () => view.reset());
  slider.addEventListener("input", () => view.redraw());
  for (const input of document.querySelectorAll("#view-controls input[type=checkbox]")) input.addEventListener("change", () => view.redraw());

  let timer = null;
  play.addEventListener("click", () => {
    if (timer) {
      clearInterval(timer);
      timer = null;
    } else
      timer = setInterval(() => {
        slider.value = (Number(slider.value) + 1) % scene.angles_deg.length;
        view.redraw();
      }, 90);
    play.textContent = timer ? "Pause" : "Play";
  });

  view.draw();
})();
