/* Plots as SVG, drawn at the size that they have on the screen. */

function ticks(low, high, most) {
  const raw = (high - low) / most, power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find(m => m * power >= raw * 0.999), found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) found.push(k * step);
  const places = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return found.map(v => [v, Math.abs(v) < 1e-9 * step ? "0" : places > 6 || Math.abs(v) >= 1e7 ? v.toExponential(1) : v.toFixed(places)]);
}

function range(values) {
  const finite = values.filter(Number.isFinite);
  if (!finite.length) return [0, 1];
  let low = Math.min(...finite), high = Math.max(...finite);
  const pad = high - low > 1e-12 * Math.max(Math.abs(low), Math.abs(high)) && high > low ? 0.06 * (high - low) : Math.max(1e-6, 0.01 * Math.abs(high));
  return [low - pad, high + pad];
}

class Plot {
  constructor(id, labels) { this.svg = document.getElementById(id); this.labels = labels; }

  /* Axes over the ranges; equal: one scale for both, so that lengths and angles are true. */
  begin(xs, ys, equal) {
    const w = this.width = Math.max(260, this.svg.clientWidth), h = this.height = this.svg.clientHeight || 260;
    this.box = { left: 80, right: w - 14, top: 10, bottom: h - 40 };
    let [x0, x1] = xs, [y0, y1] = ys;
    const bw = this.box.right - this.box.left, bh = this.box.bottom - this.box.top;
    if (equal) {
      const unit = Math.max((x1 - x0) / bw, (y1 - y0) / bh), cx = (x0 + x1) / 2, cy = (y0 + y1) / 2;
      [x0, x1, y0, y1] = [cx - unit * bw / 2, cx + unit * bw / 2, cy - unit * bh / 2, cy + unit * bh / 2];
    }
    this.x = v => this.box.left + (v - x0) / (x1 - x0) * bw;
    this.y = v => this.box.bottom - (v - y0) / (y1 - y0) * bh;
    this.scale = [bw / (x1 - x0), bh / (y1 - y0)];
    this.svg.setAttribute("viewBox", `0 0 ${w} ${h}`);
    const { left, right, top, bottom } = this.box, out = [];
    for (const [v, name] of ticks(x0, x1, Math.max(2, bw / 80)))
      out.push(`<line class="grid" x1="${this.x(v)}" x2="${this.x(v)}" y1="${top}" y2="${bottom}"/><text text-anchor="middle" x="${this.x(v)}" y="${bottom + 15}">${name}</text>`);
    for (const [v, name] of ticks(y0, y1, Math.max(2, bh / 45)))
      out.push(`<line class="grid" x1="${left}" x2="${right}" y1="${this.y(v)}" y2="${this.y(v)}"/><text text-anchor="end" x="${left - 5}" y="${this.y(v) + 4}">${name}</text>`);
    out.push(`<rect class="frame" x="${left}" y="${top}" width="${bw}" height="${bh}"/>`);
    out.push(`<text text-anchor="middle" x="${(left + right) / 2}" y="${h - 6}">${this.labels[0]}</text>`);
    out.push(`<text text-anchor="middle" transform="translate(13 ${(top + bottom) / 2}) rotate(-90)">${this.labels[1]}</text>`);
    out.push(`<clipPath id="clip-${this.svg.id}"><rect x="${left}" y="${top}" width="${bw}" height="${bh}"/></clipPath><g clip-path="url(#clip-${this.svg.id})">`);
    this.out = out;
  }

  /* A line through points; what is not a number breaks it. */
  line(points, name) {
    let path = "", open = false;
    for (const [a, b] of points) {
      if (Number.isFinite(a) && Number.isFinite(b)) path += `${open ? "L" : "M"}${this.x(a).toFixed(2)} ${this.y(b).toFixed(2)}`;
      open = Number.isFinite(a) && Number.isFinite(b);
    }
    if (path) this.out.push(`<path class="${name}" d="${path}"/>`);
  }
  segments(pairs, name) {
    const path = pairs.map(([[a, b], [c, d]]) => `M${this.x(a).toFixed(2)} ${this.y(b).toFixed(2)}L${this.x(c).toFixed(2)} ${this.y(d).toFixed(2)}`).join("");
    if (path) this.out.push(`<path class="${name}" d="${path}"/>`);
  }
  vertical(x) { if (Number.isFinite(x)) this.out.push(`<line class="mark" x1="${this.x(x)}" x2="${this.x(x)}" y1="${this.box.top}" y2="${this.box.bottom}"/>`); }
  note(words) { this.out.push(`<text text-anchor="middle" x="${(this.box.left + this.box.right) / 2}" y="${this.box.top + 24}">${words}</text>`); }
  end() { this.svg.innerHTML = this.out.join("") + "</g>"; }
}
