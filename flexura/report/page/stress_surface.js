'use strict';
// Stress of a fibre of one flexure by one method, as colours over the angle of the drive and the
// length of the flexure.
const StressSurface = (() => {
  const { length, force } = State.units;
  const unit = `${force}/${length}²`;
  const margin = { left: 58, right: 18, top: 8, bottom: 34 };

  const rowsOf = (turn) => {
    const { method, flexure, fibre } = State.chosen;
    const curves = turn.methods[method].flexures[flexure];
    return curves ? curves[`${fibre}_stress`] : [];
  };

  // The same colours for both fibres: they can be compared.
  function scaleOf(turn) {
    const curves = turn.methods[State.chosen.method].flexures[State.chosen.flexure];
    const largest = (rows) => d3.max(rows, (row) => d3.max(row, Math.abs)) || 0;
    const high = Math.max(largest(curves.upper_stress), largest(curves.lower_stress));
    const colour = (v) => d3.interpolateRdYlBu(high > 0 ? 0.5 - 0.5 * v / high : 0.5);
    return { high, colour };
  }

  // A picture with a pixel for every value, which the canvas stretches.
  function pictureOf(rows, colour) {
    const [width, height] = [rows.length, rows[0].length];
    const picture = document.createElement('canvas');
    picture.width = width;
    picture.height = height;
    const context = picture.getContext('2d');
    const pixels = context.createImageData(width, height);
    rows.forEach((row, i) => row.forEach((value, j) => {
      const { r, g, b } = d3.rgb(colour(value));
      pixels.data.set([r, g, b, 255], 4 * (i + width * (height - 1 - j)));
    }));
    context.putImageData(pixels, 0, 0);
    return picture;
  }

  class Surface {
    constructor(host, turn) {
      this.turn = turn;
      const figure = d3.select(host).append('figure').attr('class', 'chart surface');
      this.caption = figure.append('figcaption');
      this.frame = figure.append('div').attr('class', 'chart-frame can-seek');
      this.sheet = this.frame.append('canvas').attr('class', 'surface-sheet')
        .attr('aria-hidden', 'true').node();
      this.svg = this.frame.append('svg').attr('role', 'img');
      this.tip = this.frame.append('div').attr('class', 'chart-tip').attr('hidden', true);
      this.connectPointer();
      new ResizeObserver(() => this.draw()).observe(this.frame.node());
    }

    draw() {
      const node = this.frame.node();
      [this.width, this.height] = [node.clientWidth, node.clientHeight];
      this.svg.selectAll('*').remove();
      this.cursor = null;
      const rows = rowsOf(this.turn);
      this.rows = rows;
      const density = window.devicePixelRatio || 1;
      this.sheet.width = Math.round(density * this.width);
      this.sheet.height = Math.round(density * this.height);
      if (!this.width || rows.length < 2 || rows[0].length < 2) return;
      this.stations = this.turn.stations[State.chosen.flexure];
      this.x = d3.scaleLinear().domain([0, this.turn.end])
        .range([margin.left, this.width - margin.right]);
      this.y = d3.scaleLinear().domain(d3.extent(this.stations))
        .range([this.height - margin.bottom, margin.top]);
      this.paint(density);
      this.drawAxes();
      this.cursor = this.svg.append('line').attr('class', 'surface-cursor')
        .attr('y1', margin.top).attr('y2', this.height - margin.bottom);
      this.mark();
    }

    paint(density) {
      const { rows } = this;
      const picture = pictureOf(rows, scaleOf(this.turn).colour);
      const context = this.sheet.getContext('2d');
      context.scale(density, density);
      context.drawImage(picture, 0.5, 0.5, rows.length - 1, rows[0].length - 1, margin.left,
        margin.top, this.width - margin.left - margin.right,
        this.height - margin.top - margin.bottom);
    }

    drawAxes() {
      const floor = this.height - margin.bottom;
      const write = (v) => Numbers.short(v);
      this.svg.append('g').attr('class', 'chart-axis')
        .attr('transform', `translate(${margin.left},0)`)
        .call(d3.axisLeft(this.y).ticks(4).tickFormat(write).tickSize(0).tickPadding(7));
      this.svg.append('g').attr('class', 'chart-axis').attr('transform', `translate(0,${floor})`)
        .call(d3.axisBottom(this.x).tickValues(Turn.chartOptions(this.turn).xTicks)
          .tickFormat(write).tickSize(4));
      this.svg.append('text').attr('class', 'chart-x-title').attr('text-anchor', 'end')
        .attr('x', this.width - margin.right).attr('y', this.height - 3)
        .text('crank angle, degrees');
    }

    mark() {
      if (!this.cursor) return;
      const at = this.x(State.chosen.position);
      this.cursor.attr('x1', at).attr('x2', at);
    }

    // The value of the nearest station at the nearest angle that was solved.
    reading(event) {
      const box = this.frame.node().getBoundingClientRect();
      const nearest = (values, v) => d3.scan(values, (a, b) => Math.abs(a - v) - Math.abs(b - v));
      const i = nearest(this.turn.angles, this.x.invert(event.clientX - box.left));
      const j = nearest(this.stations, this.y.invert(event.clientY - box.top));
      return { angle: this.turn.angles[i], s: this.stations[j], value: this.rows[i][j] };
    }

    connectPointer() {
      const node = this.frame.node();
      const seek = (event) => this.cursor
        && State.set({ position: this.reading(event).angle });
      node.addEventListener('pointerdown', seek);
      node.addEventListener('pointermove', (event) => {
        if (!this.cursor) return;
        if (event.buttons & 1) seek(event);
        this.showTip(this.reading(event));
      });
      node.addEventListener('pointerleave', () => this.tip.attr('hidden', true));
    }

    showTip({ angle, s, value }) {
      this.tip.attr('hidden', null).html('');
      this.tip.append('div').attr('class', 'chart-tip-x').text(
        `crank angle ${Turn.inDegrees(angle)}, s ${Numbers.short(s, 3)} ${length}`);
      this.tip.append('div').append('span').attr('class', 'chart-tip-value')
        .text(`${Numbers.format(value)} ${unit}`);
      const width = this.tip.node().offsetWidth;
      const at = this.x(angle);
      const left = at + 12 + width > this.width ? at - 12 - width : at + 12;
      this.tip.style('left', `${Math.max(0, left)}px`);
    }
  }

  function bar(section) {
    const legend = section.append('div').attr('class', 'colour-bar').attr('id', 'surface-colours');
    legend.append('span').attr('class', 'colour-bar-low');
    legend.append('span').attr('class', 'colour-bar-strip');
    legend.append('span').attr('class', 'colour-bar-high');
    const stops = d3.range(0, 11).map((k) => d3.interpolateRdYlBu(1 - k / 10));
    legend.select('.colour-bar-strip')
      .style('background', `linear-gradient(90deg, ${stops.join(', ')})`);
    return (high) => {
      legend.select('.colour-bar-low').text(Numbers.short(-high, 3));
      legend.select('.colour-bar-high').text(`${Numbers.short(high, 3)} ${unit}`);
    };
  }

  // What can be shown: methods and flexures that have stresses.
  function make(host, turn) {
    const usable = turn.methods.map((m, i) => [i, m]).filter(([, m]) => (
      m.flexures.some((curves) => curves.upper_stress.length > 1)));
    if (usable.length === 0) return;
    const reference = usable.some(([i]) => i === turn.reference) ? turn.reference : usable[0][0];
    State.set({ method: reference, flexure: 0, fibre: 'upper' });
    const { section, header } = TurnPlots.panel(host, 'stress-surface', 'Stress along a flexure');
    TurnPlots.select(header, 'surface-flexure', 'Flexure',
      turn.flexures.map((name, f) => [f, name]), (value) => State.set({ flexure: Number(value) }));
    TurnPlots.select(header, 'surface-method', 'Method', usable.map(([i, m]) => [i, m.label]),
      (value) => State.set({ method: Number(value) })).property('value', reference);
    TurnPlots.radios(header, 'fibre', 'Fibre', [['upper', 'fibre on +n'], ['lower', 'on −n']],
      (fibre) => State.set({ fibre }));
    const surface = new Surface(TurnPlots.grid(section, 'one-chart'), turn);
    const showColours = bar(section);
    State.follow(['method', 'flexure', 'fibre'], () => {
      const title = `Arc length s from the base end of ${turn.flexures[State.chosen.flexure]}, ${
        length}; colour: stress, ${unit}`;
      surface.caption.text(title);
      surface.svg.attr('aria-label', title);
      showColours(scaleOf(turn).high);
      surface.draw();
    });
    State.follow(['position'], () => surface.mark());
  }

  return { make };
})();
