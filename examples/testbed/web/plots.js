// SPDX-License-Identifier: MIT
// The live plots. A scene says which channels they show (PlotSpec in view.hpp). The last `span` seconds
// of simulated time are kept, as means over equal numbers of steps; the buffers have a fixed size.
import uPlot from "uplot";

const capacity = 1500; // points of a plot
const span = 3; // [s]
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
  column(c) {
    return this.columns[c].subarray(Math.max(0, this.end - capacity), this.end);
  }
  get length() {
    return Math.min(capacity, this.end);
  }
}

const label = ({ label: text, unit }) => (unit === "-" ? text : `${text} [${unit}]`);

export class Plots {
  constructor(element) {
    this.element = element;
    this.plots = [];
    new ResizeObserver(() => this.resize()).observe(element);
  }

  load(description) {
    for (const { plot } of this.plots) plot.destroy();
    this.element.replaceChildren();
    this.channels = description.channels;
    this.history = new History(this.channels.length);
    this.plots = description.plots.map((spec) => this.make(spec));
    this.draw();
  }
  add(rows, count, step) {
    this.history?.add(rows, count, Math.max(1, Math.round(span / (step * capacity))));
  }
  last(key) {
    const c = this.channels?.findIndex((channel) => channel.key === key) ?? -1;
    return c < 0 || this.history.length === 0 ? null : this.history.column(c).at(-1);
  }

  make(spec) {
    const holder = document.createElement("figure");
    const title = document.createElement("figcaption");
    title.textContent = spec.title;
    const canvas = document.createElement("div");
    holder.append(title, canvas);
    this.element.append(holder);
    const plot = new uPlot(this.options(spec, canvas), this.data(spec), canvas);
    return { spec, plot, holder };
  }
  size() {
    const columns = getComputedStyle(this.element).gridTemplateColumns.split(" ").length;
    const width = Math.max(220, Math.floor(this.element.clientWidth / columns) - 14);
    return { width, height: Math.max(120, Math.min(190, Math.round(width * 0.48))) };
  }
  resize() {
    const size = this.size();
    for (const { plot } of this.plots) if (plot.width !== size.width || plot.height !== size.height) plot.setSize(size);
  }

  options(spec) {
    const { channels } = this;
    const axis = (side, scale, channel, stroke, more = {}) => ({
      side, scale, stroke, font, labelFont: font, labelSize: 16, size: side === 2 ? 26 : 46,
      gap: 3, label: label(channel), grid: { stroke: "#e2e5ea", width: 1 }, ticks: { size: 4, stroke: "#c8cdd5" }, ...more,
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
      padding: [4, spec.y2 < 0 ? 10 : 0, 0, 0],
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
      options.series.push({ scale: "y2", stroke: second, width: 1.2, points: { show: false } });
      options.axes.push(axis(1, "y2", channels[spec.y2], second, { grid: { show: false }, ...(spec.logarithmic ? { size: 50 } : {}) }));
      if (spec.logarithmic) options.axes.at(-1).ticks = { show: false };
      if (spec.logarithmic) options.axes.at(-1).values = (u, splits) => splits.map((v) => (v === null || Math.log10(v) % 1 !== 0 ? null : `1e${Math.round(Math.log10(v))}`));
    }
    return options;
  }

  /** The columns in the unit of the plot. Factors other than 1 are applied to a buffer of the column's own. */
  values(c) {
    const column = this.history.column(c), { factor } = this.channels[c];
    if (factor === 1) return column;
    this.scaled ??= [];
    this.scaled[c] ??= new Float64Array(capacity);
    for (let k = 0; k < column.length; ++k) this.scaled[c][k] = factor * column[k];
    return this.scaled[c].subarray(0, column.length);
  }
  data(spec) {
    const columns = [spec.x, spec.y, ...(spec.y2 < 0 ? [] : [spec.y2])].map((c) => this.values(c));
    return spec.isPath ? [null, columns] : columns;
  }
  draw() {
    for (const { spec, plot } of this.plots) plot.setData(this.data(spec));
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
