'use strict';
// A study of kind response: amplitude and phase of a place over the frequency, and the peaks.
const ResponseStudy = (() => {
  const { length } = State.units;
  const cycles = Numbers.cycles(State.units.time);
  const unitOf = (place) => (place.rotation ? 'rad' : length);

  // Frequencies that grow by equal factors rather than by equal steps.
  function isLogarithmic({ modelings }) {
    const f = d3.max(modelings, (m) => m.frequencies.length) > 2
      ? modelings.find((m) => m.frequencies.length > 2).frequencies : [0];
    const n = f.length - 1;
    return f[0] > 0 && Math.abs(f[1] / f[0] - f[n] / f[n - 1]) < 0.01 * (f[1] / f[0] - 1);
  }

  // The displacement that goes furthest, by the reference.
  function firstChoice({ places, modelings, reference }) {
    const rows = modelings.length > 0 ? modelings[reference].amplitudes : [];
    const largest = places.map((place, p) => (place.rotation ? -1 : d3.max(rows[p] || []) || 0));
    return Math.max(0, largest.indexOf(d3.max(largest)));
  }

  function chooser(host, places) {
    const label = d3.select(host).append('label').attr('class', 'chooser');
    label.append('span').text('Place');
    const select = label.append('select').attr('id', 'place')
      .on('change', function changed() { State.set({ place: Number(this.value) }); });
    for (const [title, rotation] of [['Displacements', false], ['Rotations', true]]) {
      const of = places.map((place, i) => ({ ...place, i })).filter((p) => p.rotation === rotation);
      if (of.length === 0) continue;
      select.append('optgroup').attr('label', title).selectAll('option').data(of).enter()
        .append('option').attr('value', (p) => p.i).text((p) => p.name);
    }
    select.property('value', State.chosen.place);
  }

  function lines(response, pointsOf, marksOf) {
    return response.modelings.filter((m) => !State.chosen.hidden.has(m.label)).map((m) => ({
      label: m.label,
      colour: State.colour(m.label),
      points: pointsOf(m),
      marks: marksOf(m),
      isReference: m === response.modelings[response.reference],
    }));
  }

  const degrees = (radians) => radians * 180 / Math.PI;

  // A phase that passes half a turn goes on at the other end.
  function phasePoints(m, place) {
    return m.phases[place].map((phase, i) => ({
      x: m.frequencies[i],
      y: degrees(phase),
      apart: i > 0 && Math.abs(phase - m.phases[place][i - 1]) > Math.PI,
    }));
  }

  function makeCharts(host, response) {
    const grid = d3.select(host).append('div').attr('class', 'charts response').node();
    const logarithmic = isLogarithmic(response);
    const all = response.modelings.flatMap((m) => m.frequencies);
    const common = { xTitle: `frequency, ${cycles}`, xLog: logarithmic, xRange: d3.extent(all) };
    const amplitude = new Chart(grid, {
      ...common, title: 'Amplitude', log: logarithmic, empty: 'It does not move',
    });
    const phase = new Chart(grid, {
      ...common,
      title: 'Phase, degrees ahead of the loads',
      yRange: [-180, 180],
      yTicks: [-180, -90, 0, 90, 180],
    });
    State.follow(['place', 'hidden'], () => {
      const p = State.chosen.place;
      const place = response.places[p];
      const peaks = (m, y) => m.peaks[p].map((peak) => ({
        x: peak.frequency,
        y: y(peak),
        title: `${m.label}: ${Numbers.short(peak.amplitude)} ${unitOf(place)} at `
          + `${Numbers.short(peak.frequency)} ${cycles}`,
      }));
      amplitude.show(lines(response, (m) => m.amplitudes[p].map(
        (a, i) => ({ x: m.frequencies[i], y: a })), (m) => peaks(m, (peak) => peak.amplitude)),
      `Amplitude of ${place.name}, ${unitOf(place)}`);
      phase.show(lines(response, (m) => phasePoints(m, p),
        (m) => peaks(m, (peak) => degrees(peak.phase))));
    });
  }

  function drawFigure(view, study) {
    Mechanism.drawStill(view);
    const { name } = study.response.places[State.chosen.place];
    const on = Mechanism.find(name.slice(0, name.lastIndexOf('.')));
    view.paths('chosen', on ? [
      { d: Shapes.circle(view.project(on.place), 4.5), class: 'loaded-point' }] : []);
    const loads = study.loads.map((load) => ({ load, on: Mechanism.find(load.on) }))
      .filter((entry) => entry.on).map((entry) => Mechanism.loadItems(
        view, entry.on.place, entry.load.force, entry.load.moment, 1));
    view.paths('loads', loads.flatMap((l) => l.items));
    view.texts('load-names', loads.flatMap((l) => l.texts));
  }

  function peakTable(host, response) {
    const panel = d3.select(host).append('section').attr('class', 'panel');
    const heading = panel.append('h2');
    const node = panel.append('div').attr('id', 'peaks').node();
    State.follow(['place'], () => {
      const p = State.chosen.place;
      const place = response.places[p];
      const rows = response.modelings.flatMap((m) => m.peaks[p].map((peak) => ({ ...peak, m })));
      heading.text(`Peaks of ${place.name}`);
      node.textContent = '';
      if (rows.length === 0) {
        d3.select(node).append('p').attr('class', 'faint')
          .text('None between the first and the last frequency.');
        return;
      }
      Tables.make(node, [
        {
          title: 'Modeling',
          left: true,
          fill: (cell, row) => Tables.modelingColumn.fill(cell, row.m),
        },
        { title: 'Frequency', unit: cycles, text: (row) => Numbers.format(row.frequency, 5) },
        {
          title: 'Amplitude',
          unit: unitOf(place),
          text: (row) => Numbers.format(row.amplitude, 5),
        },
        { title: 'Phase', unit: 'degrees', text: (row) => Numbers.format(degrees(row.phase), 4) },
      ], rows).style('--colour', (row) => State.colour(row.m.label));
    });
  }

  function comparison(host, response) {
    const panel = d3.select(host).append('section').attr('class', 'panel');
    panel.append('h2').text('Comparison');
    const reference = response.modelings[response.reference];
    const columns = [
      Tables.modelingColumn,
      {
        title: 'Status',
        left: true,
        text: (m) => (m.converged ? 'converged' : 'stopped'),
        class: (m) => (m.converged ? '' : 'is-stopped'),
      },
      { title: 'Unknowns', text: (m) => m.unknowns },
      { title: 'Time', text: (m) => Numbers.duration(m.seconds) },
      { title: 'Error estimate', text: (m) => Numbers.percent(m.error_estimate, 2) },
      {
        title: 'Largest difference',
        unit: reference ? `from ${reference.label}` : '',
        text: (m) => (m === reference ? 'reference' : Numbers.percent(m.difference)),
        class: (m) => (m === reference ? 'faint' : 'is-key'),
      },
    ];
    Tables.make(panel.append('div').attr('id', 'comparison').node(), columns, response.modelings)
      .style('--colour', (m) => State.colour(m.label))
      .attr('class', 'is-modeling')
      .each(function notes(m) { Tables.addNotes(this, { events: [], ...m }, columns.length); });
  }

  function make(host, study) {
    const { response } = study;
    State.set({ place: firstChoice(response) });
    const stage = d3.select(host).append('div').attr('class', 'stage is-plots-first');
    const left = stage.append('section').attr('class', 'panel plots').node();
    Figure.legend(left, response.modelings);
    chooser(left, response.places);
    makeCharts(left, response);
    const right = stage.append('section').attr('class', 'panel mechanism').node();
    const view = new View(right, Mechanism.undeformedBox, `The mechanism of study ${study.name}`,
      (v) => drawFigure(v, study));
    d3.select(right).append('p').attr('class', 'hint').text('As drawn, with the loads at their '
      + 'amplitudes; the ring is the place whose motion is shown.');
    State.follow(['place'], () => view.redraw());
    peakTable(host, response);
    comparison(host, response);
  }

  return { make };
})();
