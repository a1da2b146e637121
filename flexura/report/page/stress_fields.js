'use strict';
// Stress over the flexures of a modeling that has it in the plane: coloured quadrilaterals on the
// deformed mechanism, and the bar that says what the colours mean.
const StressFields = (() => {
  const { length, force } = State.units;
  const unit = `${force}/${length}²`;
  const thinnest = 13; // on the screen: thinner flexures are drawn thicker than they are
  const mostWidened = 20;

  const hypot = (s) => Math.hypot(0.5 * (s[0] - s[1]), s[2]);
  const vonMises = ([x, y, xy, z]) => Math.sqrt(
    0.5 * ((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2) + 3 * xy * xy);
  // `of` takes the stress in x, y, xy and across the plane.
  const quantities = [
    { key: 'von_mises', sign: 'von Mises', name: 'Von Mises stress', of: vonMises },
    {
      key: 'first',
      sign: 'σ₁',
      name: 'First principal stress',
      of: (s) => 0.5 * (s[0] + s[1]) + hypot(s),
    },
    {
      key: 'second',
      sign: 'σ₂',
      name: 'Second principal stress',
      of: (s) => 0.5 * (s[0] + s[1]) - hypot(s),
    },
    { key: 'xx', sign: 'σx', name: 'Normal stress in x', of: (s) => s[0] },
    { key: 'yy', sign: 'σy', name: 'Normal stress in y', of: (s) => s[1] },
    { key: 'xy', sign: 'τ', name: 'Shear stress in x and y', of: (s) => s[2] },
  ];
  const named = (key) => quantities.find((quantity) => quantity.key === key) || null;

  const withFields = (path) => path.modelings.filter((m) => m.stress_fields);

  // Colours from the least to the largest value; about zero where there are both signs to tell.
  function scaleOf(modeling, { key }) {
    const ranges = modeling.stress_fields.states.map((state) => state.ranges[key]);
    let low = d3.min(ranges, (range) => range[0]);
    let high = d3.max(ranges, (range) => range[1]);
    if (key === 'von_mises') {
      low = 0;
      const colour = (value) => d3.interpolateViridis(high > 0 ? value / high : 0);
      return { low, high, colour };
    }
    high = Math.max(Math.abs(low), Math.abs(high));
    low = -high;
    const colour = (value) => d3.interpolateRdYlBu(high > 0 ? 0.5 - 0.5 * value / high : 0.5);
    return { low, high, colour };
  }

  function chooser(host) {
    const options = [{ key: '', sign: 'none', name: 'No stress' }, ...quantities];
    const bar = d3.select(host).append('div').attr('class', 'diagram-bar field-bar');
    const group = bar.append('div').attr('class', 'switch').attr('role', 'radiogroup')
      .attr('aria-label', 'Stress on the mechanism');
    group.append('span').text('Stress');
    const labels = group.selectAll('label').data(options).enter().append('label')
      .attr('title', (option) => option.name);
    labels.append('input').attr('type', 'radio').attr('name', 'field')
      .attr('value', (option) => option.key).attr('aria-label', (option) => option.name)
      .on('change', (option) => State.set({ field: option.key }));
    labels.append('span').text((option) => option.sign);
    State.follow(['field'], () => {
      labels.select('input').property('checked', (option) => option.key === State.chosen.field);
    });
    const legend = bar.append('div').attr('class', 'colour-bar').attr('id', 'colour-bar');
    legend.append('span').attr('class', 'colour-bar-low');
    legend.append('span').attr('class', 'colour-bar-strip');
    legend.append('span').attr('class', 'colour-bar-high');
    const caption = bar.append('p').attr('class', 'faint').attr('id', 'field-caption');
    return { legend, caption };
  }

  function showLegend(legend, scale) {
    legend.attr('hidden', scale ? null : '');
    if (!scale) return;
    const stops = d3.range(0, 11).map((k) => scale.colour(
      scale.low + k / 10 * (scale.high - scale.low)));
    legend.select('.colour-bar-low').text(Numbers.short(scale.low, 3));
    legend.select('.colour-bar-strip')
      .style('background', `linear-gradient(90deg, ${stops.join(', ')})`);
    legend.select('.colour-bar-high').text(`${Numbers.short(scale.high, 3)} ${unit}`);
  }

  // The fields at a position: those kept there, or between two of them; null where there are none.
  function fieldsAt(modeling, times, position) {
    const { states } = modeling.stress_fields;
    const at = (state) => times[state.state];
    const next = d3.bisector(at).right(states, position + 1e-9);
    const a = states[next - 1];
    const b = states[next];
    if (!a) return null;
    const share = b ? (position - at(a)) / (at(b) - at(a)) : 0;
    const same = b && a.flexures.every(
      (field, f) => field.places.length === b.flexures[f].places.length);
    if (!same || share < 1e-6) return a;
    const between = (from, to) => from.map((v, i) => v + share * (to[i] - v));
    return {
      ...a,
      flexures: a.flexures.map((field, f) => ({
        ...field,
        places: between(field.places, b.flexures[f].places),
        stresses: between(field.stresses, b.flexures[f].stresses),
      })),
    };
  }

  const nodesOf = (field) => field.places.length / 2;
  const place = (field, k) => [field.places[2 * k], field.places[2 * k + 1]];

  // Of a mesh, which is not thin, without end.
  function thicknessOf(field) {
    if (field.pieces) return Infinity;
    const columns = nodesOf(field) / field.rows;
    const all = d3.range(columns).map((c) => {
      const [x, y] = place(field, c * field.rows);
      const [u, v] = place(field, (c + 1) * field.rows - 1);
      return Math.hypot(u - x, v - y);
    });
    return d3.mean(all);
  }

  // Places on the screen, every section widened about its middle.
  function outlineOf(view, field, widened) {
    if (field.pieces) return d3.range(nodesOf(field)).map((k) => view.project(place(field, k)));
    return d3.range(nodesOf(field)).map((k) => {
      const first = k - (k % field.rows);
      const [a, b] = [place(field, first), place(field, first + field.rows - 1)];
      return view.project(place(field, k).map((v, i) => {
        const middle = 0.5 * (a[i] + b[i]);
        return middle + widened * (v - middle);
      }));
    });
  }

  // Four nodes of every piece of a mesh, or of every quadrilateral between columns and rows.
  function piecesOf({ pieces, rows, places }) {
    if (pieces) return d3.range(0, pieces.length, 4).map((k) => pieces.slice(k, k + 4));
    return d3.range(places.length / 2 - rows)
      .filter((k) => k % rows !== rows - 1)
      .map((k) => [k, k + rows, k + rows + 1, k + 1]);
  }

  function drawBorder(context, field, at) {
    context.beginPath();
    if (field.pieces) {
      d3.range(0, field.border.length, 2).forEach((k) => {
        context.moveTo(...at[field.border[k]]);
        context.lineTo(...at[field.border[k + 1]]);
      });
    } else {
      const side = (row) => d3.range(row, at.length, field.rows).map((k) => at[k]);
      [...side(0), ...side(field.rows - 1).reverse()].forEach((p) => context.lineTo(...p));
      context.closePath();
    }
    context.lineWidth = 0.8;
    context.strokeStyle = 'rgba(60, 60, 60, 0.7)';
    context.stroke();
  }

  function paint(context, view, field, values, colour, widened) {
    const at = outlineOf(view, field, widened);
    context.lineWidth = 0.7; // hides the seams
    for (const corners of piecesOf(field)) {
      context.beginPath();
      corners.forEach((corner) => context.lineTo(...at[corner]));
      context.closePath();
      context.fillStyle = colour(d3.mean(corners, (corner) => values[corner]));
      context.strokeStyle = context.fillStyle;
      context.fill();
      context.stroke();
    }
    drawBorder(context, field, at);
  }

  function valuesOf(field, { unit: step, across }, quantity) {
    const size = across ? 4 : 3;
    return d3.range(nodesOf(field)).map((k) => {
      const s = d3.range(size).map((i) => step * field.stresses[size * k + i]);
      return quantity.of(across ? s : [...s, 0]);
    });
  }

  function sentence(modeling, quantity, state, widened) {
    const { error } = modeling.stress_fields;
    const [low, high] = state.ranges[quantity.key];
    const parts = [`${quantity.name} of ${modeling.label}: ${Numbers.short(low, 3)} to ${
      Numbers.short(high, 3)} ${unit}.`];
    if (Numbers.isNumber(error)) {
      parts.push(`Error estimate at the last state, in energy: ${Numbers.percent(error, 2)}.`);
    }
    if (widened > 1.05) parts.push(`Flexures are drawn ${Numbers.short(widened, 2)}× as thick.`);
    return parts.join(' ');
  }

  // The switch, and what draws on a view: nothing where no modeling has fields.
  function make(host, path, timeline) {
    const modelings = withFields(path);
    if (modelings.length === 0) return { draw: () => {}, onlyAtEnd: false };
    const { legend, caption } = chooser(host);
    const onlyAtEnd = modelings.every((m) => m.stress_fields.states.length === 1);

    function draw(view, shown) {
      const quantity = named(State.chosen.field);
      const found = quantity && shown.find(({ modeling }) => modeling.stress_fields);
      const state = found && fieldsAt(
        found.modeling, timeline.positions(found.modeling), State.chosen.position);
      showLegend(legend, found ? scaleOf(found.modeling, quantity) : null);
      const context = view.canvas();
      // Nothing hides the colours: other modelings are lines, and the coloured one is not drawn.
      view.svg.classed('has-colours', Boolean(state));
      view.layer('flexures').selectAll('path').style(
        'visibility', (item) => (state && item.modeling === found.modeling.label ? 'hidden' : null));
      if (!state) {
        const at = 'Of the last state: at the end of the slider.';
        caption.text((quantity && (found ? at : 'Of a modeling that is hidden.')) || '');
        return;
      }
      const { colour } = scaleOf(found.modeling, quantity);
      const thin = view.scale * d3.min(state.flexures, thicknessOf);
      const widened = Math.min(mostWidened, Math.max(1, thinnest / thin));
      for (const field of state.flexures) {
        const values = valuesOf(field, found.modeling.stress_fields, quantity);
        paint(context, view, field, values, colour, widened);
      }
      caption.text(sentence(found.modeling, quantity, state, widened));
    }

    return { draw, onlyAtEnd };
  }

  return { make, named };
})();
