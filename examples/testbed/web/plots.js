// SPDX-License-Identifier: MIT
// The live plots. A scene says which channels they show (PlotSpec in view.hpp). The last `span` seconds
// of simulated time are shown, as means over equal numbers of steps; the buffers have a fixed size.
import uPlot from "uplot";

const capacity = 1500; // points of a plot
const blue = "#1f5fa8", orange = "#c2410c", green = "#15803d";
const font = "11px system-ui, sans-serif";

/** The means of all channels, in arrays of twice the capacity: the last points are a subarray. */
class History {
  constructor(width) {
    this.width = width;
    this.columns = Array.from({ length: width }, () => new Float64Array(2 * capacity));
    this.sums = new Float64Array(width);
    this.clear();
  }
  clear() {
    this.end = this.added = 0;
    this.sums.fill(0);
  }
  /** @param stride steps of which a point is the mean */
  add(rows, count, stride) {
    for (let k = 0; k + this.width <= count; k += this.width) {
      for (let c = 0; c < this.width; ++c) this.sums[c] += rows[k + c];
      if (++this.added < stride) continue;
      if (this.end === 2 * capacity) {
        for (const column of this.columns) column.copyWithin(0, capacity);
        this.end = capacity;
      }
      for (let c = 0; c < this.width; ++c) this.columns[c][this.end] = this.sums[c] / this.added;
      ++this.end;
      this.added = 0;
      this.sums.fill(0);
    }
  }
  /** @param from time of the first point; column 0 is the time */
  column(c, from = -Infinity) {
    let begin = Math.max(0, this.end - capacity);
    while (begin < this.end && this.columns[0][begin] < from) ++begin;
    return this.columns[c].subarray(begin, this.end);
  }
  get length() {
    return Math.min(capacity, this.end);
  }
}

const label = ({ label: text, unit }) => (unit === "-" || unit === "" ? text : `${text} [${unit}]`);

/** Texts of ticks with as many digits as their distance needs; large values with a prefix or an exponent. */
function ticks(splits, step, unit) {
  const most = Math.max(...splits.map((v) => Math.abs(v ?? 0)));
  if (most >= 1e4) {
    // mm has a prefix already.
    const [factor, prefix] = unit === "mm" || most >= 1e10 ? [1, ""] : most >= 1e9 ? [1e-9, "G"] : most >= 1e6 ? [1e-6, "M"] : [1e-3, "k"];
    if (prefix === "") return splits.map((v) => (v ? Number(v.toPrecision(3)).toExponential() : "0"));
    return splits.map((v) => (v ? `${Number((v * factor).toPrecision(4))} ${prefix}` : "0"));
  }
  let digits = 0;
  while (digits < 6 && Math.abs(step * 10 ** digits - Math.round(step * 10 ** digits)) > 1e-6 * step * 10 ** digits) ++digits;
  return splits.map((v) => (v === null ? null : v.toFixed(digits).replace(/^-(0(?:\.0*)?)$/, "$1")));
}

export class Plots {
  constructor(element) {
    this.element = element;
    this.plots = [];
    this.span = 3; // [s]
    this.pathsFrom = 0; // time from which on a path is drawn [s]
    this.note = document.createElement("p");
    this.note.className = "span";
    new ResizeObserver(() => this.resize()).observe(element);
  }

  load(description) {
    for (const { plot } of this.plots) plot.destroy();
    this.element.replaceChildren(this.note);
    this.setSpan(this.span);
    this.channels = description.channels;
    this.history = new History(this.channels.length);
    this.plots = description.plots.map((spec, k) => this.make(spec, k));
    this.draw();
  }
  setSpan(span) {
    this.span = span;
    this.note.textContent = `The last ${Number(span.toPrecision(3))} s of simulated time`;
  }
  add(rows, count, step) {
    this.history?.add(rows, count, Math.max(1, Math.ceil(this.span / (step * capacity))));
  }
  last(key) {
    const c = this.channels?.findIndex((channel) => channel.key === key) ?? -1;
    return c < 0 || this.history.length === 0 ? null : this.history.column(c).at(-1);
  }

  make(spec, k) {
    const holder = document.createElement("figure");
    const title = document.createElement("figcaption");
    title.textContent = spec.title;
    const [first, second] = [spec.y, spec.y2].map((c) => this.channels[c]);
    if (second?.unit === first.unit)
      for (const [channel, colour] of [[first, blue], [second, orange]]) {
        const name = document.createElement("span");
        name.textContent = ` — ${channel.label}`;
        name.style.color = colour;
        title.append(name);
      }
    const canvas = document.createElement("div");
    holder.append(title, canvas);
    this.element.append(holder);
    const plot = new uPlot(this.options(spec, canvas), this.data(spec, k), canvas);
    return { spec, plot, holder };
  }
  size() {
    const columns = getComputedStyle(this.element).gridTemplateColumns.split(" ").length;
    const width = Math.max(220, Math.floor(this.element.clientWidth / columns) - 14);
    let height = Math.max(120, Math.min(190, Math.round(width * 0.48)));
    // Beside the picture all plots fit into the height of the window, if they stay legible.
    const besides = getComputedStyle(this.element).overflowY === "auto" && columns === 1 && window.innerWidth > 1120;
    if (besides) height = Math.max(130, Math.min(height, Math.floor((this.element.clientHeight - 40) / 4) - 28));
    return { width, height };
  }
  resize() {
    const size = this.size();
    for (const { plot } of this.plots) if (plot.width !== size.width || plot.height !== size.height) plot.setSize(size);
  }

  options(spec) {
    const { channels } = this;
    const axis = (side, scale, channel, stroke, more = {}) => ({
      side, scale, stroke, font, labelFont: font, labelSize: 16, size: side === 2 ? 26 : 46, space: side === 2 ? 50 : 24,
      gap: 3, label: label(channel), values: (u, splits, k, space, step) => ticks(splits, step, channel.unit), grid: { stroke: "#e2e5ea", width: 1 }, ticks: { size: 4, stroke: "#c8cdd5" }, ...more,
    });
    const logScale = { distr: 3, range: (u, low, high) => (low > 0 ? uPlot.rangeLog(Math.max(low, 1e-7), Math.max(high, 1e-5), 10, true) : [1e-6, 1]) };
    // Not narrower than 1e-3 of the value, nor than 0.01 units: rounding is not worth a plot.
    const linear = {
      range: (u, low, high) => {
        if (low === null || !Number.isFinite(low + high)) return [0, 1];
        const least = Math.max(0.01, 1e-2 * Math.abs(high)), middle = (low + high) / 2;
        return high - low < least ? [middle - least, middle + least] : uPlot.rangeNum(low, high, 0.08, true);
      },
    };
    const counts = { range: (u, low, high) => [0, Math.max(20, 1.1 * (high ?? 0))] };
    const options = {
      ...this.size(),
      legend: { show: false },
      cursor: { show: false },
      padding: [10, spec.y2 < 0 ? 14 : 0, 0, 0],
      scales: { x: { time: false, ...linear }, y: channels[spec.y].key === "sweeps" ? counts : spec.logarithmic && spec.y2 < 0 ? logScale : linear },
      axes: [
        axis(2, "x", channels[spec.x], "#333", { label: label(channels[spec.x]) }),
        axis(3, "y", channels[spec.y], blue),
      ],
    };
    if (spec.isPath) {
      options.mode = 2;
      options.series = [null, { paths: (u, k) => drawPath(u, k), facets: [{ scale: "x", auto: true }, { scale: "y", auto: true }] }];
      return options;
    }
    options.scales.x.range = (u, low, high) => (low === null ? [0, 1] : [low, Math.max(high, low + 1e-3)]);
    options.series = [{}, { scale: "y", stroke: blue, width: 1.5, points: { show: false } }];
    if (spec.y2 >= 0) {
      const second = spec.logarithmic ? green : orange;
      options.scales.y2 = spec.logarithmic ? logScale : linear;
      // Two quantities of one unit share the axis.
      const shared = channels[spec.y].unit === channels[spec.y2].unit;
      if (shared) options.axes[1].label = `${channels[spec.y].label}, ${channels[spec.y2].label} [${channels[spec.y].unit}]`;
      if (shared) options.scales.y = linear;
      options.padding[1] = shared ? 14 : 0;
      options.series.push({ scale: shared ? "y" : "y2", stroke: second, width: 1.2, points: { show: false } });
      if (shared) return options;
      options.axes.push(axis(1, "y2", channels[spec.y2], second, { grid: { show: false }, ...(spec.logarithmic ? { size: 50 } : {}) }));
      if (spec.logarithmic) options.axes.at(-1).ticks = { show: false };
      if (spec.logarithmic) options.axes.at(-1).values = (u, splits) => splits.map((v) => (v === null || Math.log10(v) % 1 !== 0 ? null : `1e${Math.round(Math.log10(v))}`));
    }
    return options;
  }

  /** A column of plot k in its unit. Factors other than 1 are applied to a buffer of its own. */
  values(k, c, from) {
    const column = this.history.column(c, from), { factor } = this.channels[c];
    if (factor === 1) return column;
    this.scaled ??= {};
    const scaled = (this.scaled[`${k} ${c}`] ??= new Float64Array(capacity));
    for (let i = 0; i < column.length; ++i) scaled[i] = factor * column[i];
    return scaled.subarray(0, column.length);
  }
  data(spec, k) {
    const last = this.history.length > 0 ? this.history.column(0).at(-1) : 0;
    const from = Math.max(last - this.span, spec.isPath ? this.pathsFrom : 0);
    const columns = [spec.x, spec.y, ...(spec.y2 < 0 ? [] : [spec.y2])].map((c) => this.values(k, c, from));
    return spec.isPath ? [null, columns] : columns;
  }
  draw() {
    this.plots.forEach(({ spec, plot }, k) => plot.setData(this.data(spec, k)));
  }
}

/** A curve y over x that may turn back, older parts paler, with a dot at its present end. */
function drawPath(u, series) {
  uPlot.orient(u, series, (s, dataX, dataY, scaleX, scaleY, toX, toY, left, top, width, height) => {
    const [xs, ys] = u.data[series];
    if (xs.length === 0) return;
    const { ctx } = u;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, width, height);
    ctx.clip();
    ctx.strokeStyle = ctx.fillStyle = blue;
    ctx.lineWidth = 1.2 * devicePixelRatio;
    const x = (k) => toX(xs[k], scaleX, width, left), y = (k) => toY(ys[k], scaleY, height, top);
    const parts = 4;
    for (let part = 0; part < parts; ++part) {
      const from = Math.floor((part * xs.length) / parts), to = Math.floor(((part + 1) * xs.length) / parts);
      ctx.globalAlpha = 0.2 + (0.7 * (part + 1)) / parts;
      ctx.beginPath();
      for (let k = Math.max(0, from - 1); k < to; ++k) ctx.lineTo(x(k), y(k));
      ctx.stroke();
    }
    const end = xs.length - 1;
    ctx.globalAlpha = 1;
    ctx.beginPath();
    ctx.arc(x(end), y(end), 3.5 * devicePixelRatio, 0, 2 * Math.PI);
    ctx.fill();
    ctx.restore();
  });
  return null;
}
