'use strict';
// The diagram of a section force on the mechanism: ordinates across the axis of every flexure at
// the last state of each modeling.
const Diagrams = (() => {
  // The largest ordinate, in sizes of the mechanism.
  const height = 0.15;
  const line = d3.line();

  function chooser(host) {
    const options = [
      { key: '', sign: 'none', name: 'No diagram' }, ...SectionForces.quantities];
    const bar = d3.select(host).append('div').attr('class', 'diagram-bar');
    const group = bar.append('div').attr('class', 'switch').attr('role', 'radiogroup')
      .attr('aria-label', 'Diagram on the mechanism');
    group.append('span').text('Diagram');
    const labels = group.selectAll('label').data(options).enter().append('label')
      .attr('title', (option) => option.name);
    labels.append('input').attr('type', 'radio').attr('name', 'diagram')
      .attr('value', (option) => option.key).attr('aria-label', (option) => option.name)
      .on('change', (option) => State.set({ diagram: option.key }));
    labels.append('span').text((option) => option.sign);
    const caption = bar.append('p').attr('class', 'faint').attr('id', 'diagram-caption');
    State.follow(['diagram'], () => {
      labels.select('input').property('checked', (option) => option.key === State.chosen.diagram);
    });
    return caption;
  }

  // Unit vectors across an axis through `places`, to its left.
  function normals(places) {
    return places.map((_, k) => {
      const [ax, ay] = places[Math.max(0, k - 1)];
      const [bx, by] = places[Math.min(places.length - 1, k + 1)];
      const size = Math.hypot(bx - ax, by - ay) || 1;
      return [(ay - by) / size, (bx - ax) / size];
    });
  }

  // The diagram of one modeling; `scale` is length per value.
  function ordinates(modeling, quantity, scale) {
    return modeling.members.map((rows) => {
      const places = rows.map(SectionForces.place);
      const across = normals(places);
      const tips = places.map(([x, y], k) => {
        const ordinate = quantity.side * scale * rows[k][quantity.column];
        return [x + ordinate * across[k][0], y + ordinate * across[k][1]];
      });
      return { places, tips };
    });
  }

  // Fills that lie on one another would add up: only the first one is firm.
  function items(view, modeling, drawn, isFirst) {
    const look = { modeling: modeling.label, colour: State.colour(modeling.label) };
    return drawn.flatMap(({ places, tips }, f) => {
      const axis = places.map((p) => view.project(p));
      const outline = tips.map((p) => view.project(p));
      const key = `${modeling.label} ${f}`;
      const bars = axis.filter((_, k) => k % 2 === 0).map((p, k) => line([p, outline[2 * k]]));
      return [
        {
          ...look,
          d: `${line([...axis, ...[...outline].reverse()])}Z`,
          class: isFirst ? 'diagram-fill is-first' : 'diagram-fill',
          key: `${key} fill`,
        },
        { ...look, d: bars.join(''), class: 'diagram-bars', key: `${key} bars` },
        { ...look, d: line(outline), class: 'diagram-line', key: `${key} line` },
      ];
    });
  }

  // A label beyond the end of an ordinate, away from the axis.
  function label(view, quantity, { place, tip, value }) {
    const [p, q] = [view.project(place), view.project(tip)];
    const size = Math.hypot(q[0] - p[0], q[1] - p[1]) || 1;
    const [ex, ey] = [(q[0] - p[0]) / size, (q[1] - p[1]) / size];
    const anchor = Math.abs(ex) < 0.4 ? 'middle' : (ex > 0 && 'start') || 'end';
    return {
      at: [q[0] + 8 * ex, q[1] + 12 * ey + 4],
      anchor,
      text: `${quantity.letter} = ${Numbers.short(value)} ${quantity.unit}`,
    };
  }

  // Modelings that agree have their extremes in one place: the first one's label is enough.
  function withoutOverlaps(texts) {
    const kept = [];
    for (const text of texts) {
      const hides = (other) => Math.abs(other.at[0] - text.at[0]) < 110
        && Math.abs(other.at[1] - text.at[1]) < 15;
      if (!kept.some(hides)) kept.push(text);
    }
    return kept;
  }

  function captionOf(quantity, found) {
    if (!quantity) return '';
    if (found.length === 0) return 'Of the last state: at the end of the slider.';
    if (found.every(({ extreme }) => extreme.value === 0)) return `${quantity.name}: none.`;
    const sides = { bending_moment: ', on the side in tension', stress: '' };
    const side = sides[quantity.key];
    return `${quantity.name} at the last state${
      side === undefined ? ', positive to the left of the axis' : side}.`;
  }

  // shown: [{modeling, isLast}], those to be labelled first ahead. Draws nothing below the
  // flexures where none is chosen.
  function draw(view, shown) {
    const quantity = SectionForces.named(State.chosen.diagram);
    const found = quantity ? shown.filter(({ isLast }) => isLast).map(({ modeling }) => (
      { modeling, extreme: SectionForces.extreme(modeling, quantity) }))
      .filter(({ extreme }) => extreme !== null) : [];
    const largest = d3.max(found, ({ extreme }) => Math.abs(extreme.value)) || 0;
    const scale = largest > 0 ? height * Mechanism.extent / largest : 0;
    const drawn = found.filter(({ extreme }) => extreme.value !== 0).map((one) => (
      { ...one, axes: ordinates(one.modeling, quantity, scale) }));
    view.paths('diagrams', drawn.flatMap(({ modeling, axes }, i) => (
      items(view, modeling, axes, i === 0))));
    const peaks = drawn.map(({ modeling, extreme, axes }) => ({
      modeling,
      value: extreme.value,
      place: axes[extreme.flexure].places[extreme.station],
      tip: axes[extreme.flexure].tips[extreme.station],
    }));
    return { quantity, peaks, caption: captionOf(quantity, found) };
  }

  // The extremes, above everything else.
  function drawPeaks(view, { quantity, peaks }) {
    view.paths('diagram-peaks', peaks.map(({ modeling, tip }) => ({
      d: Shapes.circle(view.project(tip), 3),
      modeling: modeling.label,
      colour: State.colour(modeling.label),
      key: modeling.label,
    })));
    const isInView = ({ tip }) => {
      const [x, y] = view.project(tip);
      return x > 0 && x < view.width && y > 0 && y < view.height;
    };
    view.texts('diagram-names', withoutOverlaps(
      peaks.filter(isInView).map((peak) => label(view, quantity, peak))));
  }

  return { chooser, draw, drawPeaks };
})();
