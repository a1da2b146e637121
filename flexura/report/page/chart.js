'use strict';
// A small line chart with a readout under the pointer and a marker that follows the slider.
class Chart {
  // options: title, xTitle, log, xLog (logarithmic scales), onSeek(x), empty (what to say where
  // there is nothing to draw), noise (a number or a function: a chart whose values are all smaller
  // is drawn as zero), xRange, yRange and yTicks (what the scales cover, and where they are named),
  // free (a curve that may turn back: no readout under the pointer; `xNoise` is then noise in x),
  // smooth (a curve through the points instead of straight lines), equal (of a free chart: both
  // scales alike where that shows anything), xTicks, under(group, chart) (draws what lies under the
  // lines), format(value) (how the readout writes a value).
  constructor(host, options) {
    this.options = options;
    this.lines = [];
    this.marker = null;
    this.places = [];
    const figure = d3.select(host).append('figure').attr('class', 'chart');
    this.caption = figure.append('figcaption').text(options.title);
    this.frame = figure.append('div').attr('class', 'chart-frame');
    this.svg = this.frame.append('svg').attr('role', 'img').attr('aria-label', options.title);
    this.tip = this.frame.append('div').attr('class', 'chart-tip').attr('hidden', true);
    this.margin = { left: 58, right: 18, top: 8, bottom: 34 };
    this.connectPointer();
    new ResizeObserver(() => this.draw()).observe(this.frame.node());
  }

  // lines: [{label, colour, points: [{x, y, unstable, apart}], marks: [{x, y, title}],
  // isReference}]; a point that is `apart` is not joined to the one before.
  show(lines, title) {
    const usable = (p) => Numbers.isNumber(p.y) && (!this.options.log || p.y > 0);
    this.lines = lines.map((line) => ({ ...line, points: line.points.filter(usable) }))
      .filter((line) => line.points.length > 0);
    if (title) {
      this.caption.text(title);
      this.svg.attr('aria-label', title);
    }
    this.draw();
  }

  mark(x) {
    this.marker = x;
    this.drawMarker();
  }

  xScale(points) {
    const { xLog, xRange, free, xNoise } = this.options;
    let [low, high] = xRange || d3.extent(points, (p) => p.x);
    if (free && high - low <= (xNoise || 0)) [low, high] = [-1, 1];
    const room = free ? 0.05 * (high - low) : 0; // for the places that are marked
    return (xLog ? d3.scaleLog() : d3.scaleLinear()).domain([low - room, high + room])
      .range([this.margin.left, this.width - this.margin.right]);
  }

  scales() {
    const points = this.lines.flatMap((line) => [...line.points, ...(line.marks || [])]);
    this.x = this.xScale(points);
    const range = [this.height - this.margin.bottom, this.margin.top];
    let [low, high] = d3.extent(points, (p) => p.y);
    if (this.options.log) {
      // Rounding of the embedded data makes anything below a ten-millionth meaningless.
      low = Math.max(low, high * 1e-9);
      if (high / low < 10) [low, high] = [low / 3, high * 3];
      this.y = d3.scaleLog().domain([low / 1.4, high * 1.4]).range(range).clamp(true);
      return;
    }
    if (this.options.yRange) {
      this.y = d3.scaleLinear().domain(this.options.yRange).range(range);
      this.makeEqual();
      return;
    }
    low = Math.min(low, 0);
    high = Math.max(high, 0);
    const { noise } = this.options;
    const least = (typeof noise === 'function' ? noise() : noise) || 0;
    if (high - low <= least) [low, high] = [-Math.max(1, least), Math.max(1, least)];
    this.y = d3.scaleLinear().domain([low, high]).nice(4).range(range);
    this.makeEqual();
  }

  // The finer scale takes the coarser one's step, about its own middle; what is nearly straight along
  // an axis would then be a line, and keeps its scales.
  makeEqual() {
    if (!this.options.equal) return;
    const both = [this.x, this.y].map((scale) => {
      const [[a, b], [p, q]] = [scale.domain(), scale.range()];
      return { scale, middle: 0.5 * (a + b), pixels: Math.abs(q - p), span: b - a };
    });
    const ratio = both[0].span / both[1].span;
    if (ratio > 12 || ratio < 1 / 12) return;
    const step = d3.max(both, ({ span, pixels }) => span / pixels);
    for (const { scale, middle, pixels } of both) {
      scale.domain([middle - 0.5 * step * pixels, middle + 0.5 * step * pixels]);
    }
  }

  draw() {
    this.width = this.frame.node().clientWidth;
    this.height = this.frame.node().clientHeight;
    this.svg.selectAll('*').remove();
    if (!this.width) return;
    if (this.lines.length === 0) {
      this.svg.append('text').attr('class', 'chart-empty').attr('text-anchor', 'middle')
        .attr('x', this.width / 2).attr('y', this.height / 2).text(this.options.empty || 'No data');
      return;
    }
    this.scales();
    this.fitMargin();
    this.scales();
    this.drawAxes();
    if (this.options.under) this.options.under(this.svg.append('g'), this);
    const area = this.svg.append('g').attr('class', 'chart-lines');
    // The reference lies broad under what is compared with it, so that neither hides the other.
    const under = this.lines.filter((line) => line.isReference);
    const over = this.lines.filter((line) => !line.isReference);
    for (const line of [...under, ...over]) this.drawLine(area, line);
    this.hover = this.svg.append('line').attr('class', 'chart-hover');
    this.markerGroup = this.svg.append('g').attr('class', 'chart-marker');
    this.drawMarker();
  }

  yLabel(value) {
    return this.options.log && value < 1e-3
      ? Numbers.powerOfTen(Math.round(Math.log10(value))) : Numbers.short(value);
  }

  // Room on the left for the widest label, in whatever font the reader has.
  fitMargin() {
    const probe = this.svg.append('g').attr('class', 'chart-axis').append('text');
    const widths = this.yTicks().map((tick) => (
      probe.text(this.yLabel(tick)).node().getComputedTextLength()));
    this.margin.left = Math.max(58, Math.ceil(d3.max(widths) || 0) + 12);
    this.svg.selectAll('*').remove();
  }

  // Of a logarithmic scale decades or, where there is room, 1, 2 and 5 of each.
  xTicks() {
    if (this.options.xTicks) return this.options.xTicks;
    if (!this.options.xLog) {
      // One in the very corner would lie on that of the other axis.
      const inCorner = (t) => this.options.free && this.x(t) < this.margin.left + 16;
      const apart = (ticks) => ticks.length < 2 || this.x(ticks[1]) - this.x(ticks[0])
        > 8 + 6.2 * d3.max(ticks, (t) => Numbers.short(t).length);
      const choices = [5, 4, 3, 2].map((count) => this.x.ticks(count));
      return (choices.find(apart) || choices[3]).filter((t) => !inCorner(t));
    }
    const [low, high] = this.x.domain();
    const [from, to] = [low, high].map(Math.log10);
    const room = (this.width - this.margin.left) / (to - from); // of a decade
    const decades = d3.range(Math.floor(from), Math.ceil(to) + 1, Math.max(1, Math.ceil(36 / room)));
    const ticks = decades.flatMap((e) => (room > 110 ? [1, 2, 5] : [1]).map((k) => k * 10 ** e))
      .filter((t) => t >= low * (1 - 1e-6) && t <= high * (1 + 1e-6));
    return ticks.length > 1 ? ticks : this.x.ticks(3);
  }

  yTicks() {
    if (this.options.yTicks) return this.options.yTicks;
    if (!this.options.log) return this.y.ticks(4);
    const [low, high] = this.y.domain().map(Math.log10);
    const step = Math.max(1, Math.ceil((high - low) / 4));
    return d3.range(Math.ceil(low), Math.floor(high) + 1, step).map((e) => 10 ** e);
  }

  drawAxes() {
    const { left, bottom } = this.margin;
    const floor = this.height - bottom;
    const ticks = this.yTicks();
    const right = this.width - this.margin.right;
    const grid = this.svg.append('g').attr('class', 'chart-grid');
    grid.selectAll('line').data(ticks).enter().append('line')
      .attr('x1', left).attr('x2', right).attr('y1', this.y).attr('y2', this.y)
      .classed('is-zero', (t) => t === 0);
    this.svg.append('g').attr('class', 'chart-axis').attr('transform', `translate(${left},0)`)
      .call(d3.axisLeft(this.y).tickValues(ticks).tickFormat((v) => this.yLabel(v)).tickSize(0)
        .tickPadding(7));
    this.svg.append('g').attr('class', 'chart-axis').attr('transform', `translate(0,${floor})`)
      .call(d3.axisBottom(this.x).tickValues(this.xTicks()).tickFormat((v) => Numbers.short(v))
        .tickSize(4));
    this.svg.append('text').attr('class', 'chart-x-title').attr('text-anchor', 'end')
      .attr('x', right).attr('y', this.height - 3).text(this.options.xTitle);
  }

  drawLine(area, line) {
    const group = area.append('g').style('--colour', line.colour)
      .classed('is-reference', line.isReference === true);
    let piece = [];
    for (const point of line.points) {
      if (point.apart) {
        this.drawPiece(group, piece);
        piece = [];
      }
      piece.push(point);
    }
    this.drawPiece(group, piece);
    const diamond = d3.symbol().type(d3.symbolDiamond).size(48);
    for (const mark of line.marks || []) {
      group.append('path').attr('class', 'chart-event').attr('d', diamond())
        .attr('transform', `translate(${this.x(mark.x)},${this.y(mark.y)})`)
        .append('title').text(mark.title);
    }
  }

  // Runs of stable and unstable states, each a path of its own; unstable ones are dashed.
  drawPiece(group, points) {
    const path = d3.line().x((p) => this.x(p.x)).y((p) => this.y(p.y))
      .curve(this.options.smooth ? d3.curveCatmullRom : d3.curveLinear);
    let begin = 0;
    const segment = (i) => points[i].unstable || points[i + 1].unstable;
    for (let i = 1; i < points.length; ++i) {
      const last = i === points.length - 1;
      if (!last && segment(i) === segment(i - 1)) continue;
      group.append('path').attr('d', path(points.slice(begin, i + 1)))
        .attr('class', segment(i - 1) ? 'chart-line is-unstable' : 'chart-line');
      begin = i;
    }
  }

  // The value of a line at x, linear between its points; null beyond its ends.
  valueAt(line, x) {
    const i = d3.bisector((p) => p.x).left(line.points, x - 1e-9);
    if (i >= line.points.length) return null;
    const b = line.points[i];
    if (i === 0) return Math.abs(b.x - x) < 1e-9 ? b.y : null;
    const a = line.points[i - 1];
    if (b.apart) return x - a.x < b.x - x ? a.y : b.y;
    return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
  }

  // Marks places of a free curve.
  markAt(places) {
    this.places = places;
    this.drawMarker();
  }

  drawPlaces() {
    if (!this.markerGroup) return;
    this.markerGroup.selectAll('*').remove();
    for (const { x, y, colour } of this.places) {
      this.markerGroup.append('circle').attr('cx', this.x(x)).attr('cy', this.y(y)).attr('r', 4)
        .style('--colour', colour);
    }
  }

  drawMarker() {
    if (this.options.free) {
      this.drawPlaces();
      return;
    }
    if (!this.markerGroup || this.marker === null || this.lines.length === 0) return;
    const at = this.x(this.marker);
    this.markerGroup.selectAll('*').remove();
    this.markerGroup.append('line').attr('x1', at).attr('x2', at)
      .attr('y1', this.margin.top).attr('y2', this.height - this.margin.bottom);
    for (const line of this.lines) {
      const value = this.valueAt(line, this.marker);
      if (value === null) continue;
      this.markerGroup.append('circle').attr('cx', at).attr('cy', this.y(value)).attr('r', 3)
        .style('--colour', line.colour);
    }
  }

  connectPointer() {
    const node = this.frame.node();
    const xOf = (event) => {
      const [a, b] = this.x.domain();
      const x = this.x.invert(event.clientX - node.getBoundingClientRect().left);
      return Math.min(Math.max(x, a), b);
    };
    const seek = (event) => this.options.onSeek && this.options.onSeek(xOf(event));
    node.addEventListener('pointermove', (event) => {
      if (this.lines.length === 0 || this.options.free) return;
      if (event.buttons & 1) seek(event);
      this.showTip(xOf(event), event.clientY - node.getBoundingClientRect().top);
    });
    node.addEventListener('pointerdown', (event) => this.lines.length && seek(event));
    node.addEventListener('pointerleave', () => {
      this.tip.attr('hidden', true);
      if (this.hover) this.hover.classed('is-on', false);
    });
    if (this.options.onSeek) this.frame.classed('can-seek', true);
  }

  // What the lines read at x; of many lines only those closest to y on the screen.
  readings(x, y) {
    const most = 10;
    const all = this.lines.map((line) => ({ line, value: this.valueAt(line, x) }))
      .filter(({ value }) => value !== null);
    if (all.length <= most) return all;
    const far = ({ value }) => Math.abs(this.y(value) - y);
    const nearest = new Set([...all].sort((a, b) => far(a) - far(b)).slice(0, most));
    return all.filter((reading) => nearest.has(reading));
  }

  format(value) {
    return this.options.format ? this.options.format(value) : Numbers.format(value, 5);
  }

  showTip(x, y) {
    const at = this.x(x);
    this.hover.classed('is-on', true).attr('x1', at).attr('x2', at)
      .attr('y1', this.margin.top).attr('y2', this.height - this.margin.bottom);
    this.tip.attr('hidden', null).html('');
    this.tip.append('div').attr('class', 'chart-tip-x')
      .text(`${this.options.xTitle.split(',')[0]} ${Numbers.short(x, 3)}`);
    for (const { line, value } of this.readings(x, y)) {
      const row = this.tip.append('div').style('--colour', line.colour);
      row.append('span').attr('class', 'swatch');
      row.append('span').attr('class', 'chart-tip-label').text(line.label);
      row.append('span').attr('class', 'chart-tip-value').text(this.format(value));
    }
    const width = this.tip.node().offsetWidth;
    const left = at + 12 + width > this.width ? at - 12 - width : at + 12;
    this.tip.style('left', `${Math.max(0, left)}px`);
  }
}
