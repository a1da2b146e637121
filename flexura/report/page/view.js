'use strict';
// A drawing to scale that can be panned and zoomed: world coordinates in, screen out.
class View {
  // `box` is what must be visible: [[x0, y0], [x1, y1]]. `draw(view)` is called whenever the
  // scale, the size or the place of the drawing has changed.
  constructor(host, box, label, draw) {
    this.box = box;
    this.draw = draw;
    this.transform = d3.zoomIdentity;
    const frame = d3.select(host).append('div').attr('class', 'view');
    this.svg = frame.append('svg').attr('class', 'view-svg').attr('role', 'img')
      .attr('aria-label', label);
    this.root = this.svg.append('g');
    this.layers = new Map();
    this.scaleBar = this.svg.append('g').attr('class', 'scale-bar');
    this.makeZoom(frame);
    new ResizeObserver(() => this.resize()).observe(frame.node());
    this.resize();
  }

  makeZoom(frame) {
    // The wheel alone scrolls the page, and one finger too.
    const wanted = () => {
      const event = d3.event;
      if (event.type === 'wheel') return event.ctrlKey || event.metaKey;
      if (event.touches) return event.touches.length > 1;
      return !event.button;
    };
    this.zoom = d3.zoom().filter(wanted).scaleExtent([0.2, 200]).on('zoom', () => {
      this.transform = d3.event.transform;
      this.redraw();
    });
    this.svg.call(this.zoom);
    const buttons = frame.append('div').attr('class', 'view-buttons');
    const button = (text, label, action) => buttons.append('button').attr('type', 'button')
      .attr('aria-label', label).attr('title', label).text(text).on('click', action);
    button('+', 'Zoom in', () => this.svg.call(this.zoom.scaleBy, 1.5));
    button('−', 'Zoom out', () => this.svg.call(this.zoom.scaleBy, 1 / 1.5));
    button('Fit', 'Show everything', () => this.svg.call(this.zoom.transform, d3.zoomIdentity));
  }

  resize() {
    const node = this.svg.node();
    const [width, height] = [node.clientWidth, node.clientHeight];
    if (width === 0 || (width === this.width && height === this.height)) return;
    this.width = width;
    this.height = height;
    const [[x0, y0], [x1, y1]] = this.box;
    const margin = Math.min(66, 0.18 * Math.min(width, height));
    const spanX = Math.max(x1 - x0, 1e-12);
    const spanY = Math.max(y1 - y0, 1e-12);
    this.fitScale = Math.min((width - 2 * margin) / spanX, (height - 2 * margin) / spanY);
    this.middle = [(x0 + x1) / 2, (y0 + y1) / 2];
    this.zoom.extent([[0, 0], [width, height]]);
    this.redraw();
  }

  // A cleared canvas under the drawing, for what has more parts than SVG bears: its context, in
  // screen coordinates.
  canvas() {
    if (!this.sheet) {
      this.sheet = d3.select(this.svg.node().parentNode).insert('canvas', 'svg')
        .attr('class', 'view-canvas').attr('aria-hidden', 'true').node();
    }
    const density = window.devicePixelRatio || 1;
    this.sheet.width = Math.round(density * this.width);
    this.sheet.height = Math.round(density * this.height);
    const context = this.sheet.getContext('2d');
    context.scale(density, density);
    return context;
  }

  redraw() {
    if (!this.width) return;
    this.drawScaleBar();
    this.draw(this);
  }

  // Screen pixels per unit of length.
  get scale() {
    return this.fitScale * this.transform.k;
  }

  project([x, y]) {
    return this.transform.apply([
      this.width / 2 + this.fitScale * (x - this.middle[0]),
      this.height / 2 - this.fitScale * (y - this.middle[1]),
    ]);
  }

  // A group of its own for one kind of thing, stacked in the order of first use.
  layer(name) {
    if (!this.layers.has(name)) this.layers.set(name, this.root.append('g').attr('class', name));
    return this.layers.get(name);
  }

  // One path per item; `item` has d and may have class, colour, width, opacity, title and key.
  paths(name, items) {
    const joined = this.layer(name).selectAll('path').data(items, (item, i) => item.key || i);
    joined.exit().remove();
    const all = joined.enter().append('path').merge(joined);
    all.attr('d', (item) => item.d)
      .attr('class', (item) => item.class || null)
      .attr('data-modeling', (item) => item.modeling || null)
      .style('--colour', (item) => item.colour || null)
      .style('stroke-width', (item) => (item.width ? `${item.width}px` : null))
      .style('opacity', (item) => (item.opacity === undefined ? null : item.opacity));
    return all;
  }

  // One text per item, at [x, y] on the screen.
  texts(name, items) {
    const joined = this.layer(name).selectAll('text').data(items);
    joined.exit().remove();
    joined.enter().append('text').merge(joined).text((item) => item.text)
      .attr('class', (item) => item.class || null)
      .attr('text-anchor', (item) => item.anchor || 'start')
      .attr('x', (item) => item.at[0]).attr('y', (item) => item.at[1])
      .each((item, i, nodes) => this.keepInside(nodes[i], item.at));
  }

  // Shifts a text whose place is in view, or nearly so, so that nothing is cut off at the sides.
  keepInside(node, [x, y]) {
    const near = 60;
    if (x < -near || x > this.width + near || y < 0 || y > this.height) return;
    const { left, right } = node.getBoundingClientRect();
    const frame = this.svg.node().getBoundingClientRect();
    const shift = Math.max(0, frame.left - left) - Math.max(0, right - frame.right);
    if (shift !== 0) d3.select(node).attr('x', x + shift).attr('y', y - 14);
  }

  drawScaleBar() {
    const aim = 110 / this.scale;
    const power = 10 ** Math.floor(Math.log10(aim));
    const length = power * [5, 2, 1].find((step) => step * power <= aim);
    const width = length * this.scale;
    const y = this.height - 16;
    this.scaleBar.selectAll('*').remove();
    this.scaleBar.append('path').attr('d', `M16,${y - 5}v5h${width}v-5`);
    this.scaleBar.append('text').attr('x', 16 + width / 2).attr('y', y - 6)
      .attr('text-anchor', 'middle').text(`${Numbers.short(length)} ${State.units.length}`);
  }
}
