'use strict';
// A study of kind linear: ellipses of elasticity over the mechanism, and their numbers.
const LinearStudy = (() => {
  const { length, force } = State.units;
  const groups = [['flexure', 'Flexures'], ['body', 'Bodies'], ['point', 'Points']];

  function boxOf({ records, poles }) {
    const [[ax, ay], [bx, by]] = Mechanism.undeformedBox;
    const near = ([x, y]) => Math.abs(x - (ax + bx) / 2) < 1.2 * Mechanism.extent
      && Math.abs(y - (ay + by) / 2) < 1.2 * Mechanism.extent;
    const corners = records.filter((r) => r.ellipse).flatMap(({ ellipse: e }) => {
      const c = Math.cos(e.orientation);
      const s = Math.sin(e.orientation);
      const dx = Math.hypot(e.major * c, e.minor * s);
      const dy = Math.hypot(e.major * s, e.minor * c);
      return [[e.centre[0] - dx, e.centre[1] - dy], [e.centre[0] + dx, e.centre[1] + dy]];
    });
    const known = poles.filter((p) => p.pole).map((p) => p.pole);
    const places = [[ax, ay], [bx, by], ...corners, ...known].filter(near);
    const [x0, x1] = d3.extent(places, (p) => p[0]);
    const [y0, y1] = d3.extent(places, (p) => p[1]);
    return [[x0, y0], [x1, y1]];
  }

  function toggles(host, records) {
    const present = groups.filter(([of]) => records.some((r) => r.of === of));
    const items = d3.select(host).append('div').attr('class', 'legend').selectAll('label')
      .data(present).enter().append('label').attr('class', ([of]) => `of-${of}`);
    items.append('input').attr('type', 'checkbox').attr('data-toggle', ([of]) => of)
      .property('checked', ([of]) => State.chosen.groups.has(of))
      .on('change', ([of]) => State.set({ groups: State.toggled(State.chosen.groups, of) }));
    items.append('span').attr('class', 'swatch');
    items.append('span').text(([, title]) => `Ellipses of ${title.toLowerCase()}`);
  }

  function drawFigure(view, study) {
    const { records, poles } = study.linear;
    const chosen = records[State.chosen.record];
    Mechanism.drawStill(view);
    const shown = records.filter((r) => r === chosen || State.chosen.groups.has(r.of));
    Ellipses.drawAll(view, shown, chosen);
    if (chosen) Ellipses.drawChosen(view, chosen);
    Ellipses.drawPoles(view, poles);
    // Several loads often share a point: numbers, explained in the table, keep them apart.
    const loads = study.loads
      .map((load, k) => ({ load, label: `${k + 1}`, on: Mechanism.find(load.on) }))
      .filter(({ on }) => on).map(({ load, label, on }) => (
        Mechanism.loadItems(view, on.place, load.force, load.moment, 1, label)));
    view.paths('loads', loads.flatMap((l) => l.items));
    view.texts('load-names', loads.flatMap((l) => l.texts));
  }

  function matrix(host, record) {
    const card = d3.select(host).append('div').attr('class', `matrix of-${record.of}`);
    card.append('h3').text(record.name);
    const at = record.at.map((v) => Numbers.short(v, 5)).join(', ');
    card.append('p').attr('class', 'faint').text(`at (${at}) ${length}`);
    const names = [['displacement x', length], ['displacement y', length], ['rotation', 'rad']];
    const per = [['force x', force], ['force y', force], ['moment', `${force}·${length}`]];
    const columns = [
      { title: '', left: true, fill: (cell, row) => {
        cell.append('span').text(names[row][0]);
        cell.append('span').attr('class', 'unit').text(names[row][1]);
      } },
      ...per.map(([title, unit], j) => ({
        title: `per ${title}`, unit, text: (row) => Numbers.format(record.compliance[row][j], 5),
      })),
    ];
    Tables.make(card.node(), columns, [0, 1, 2]);
  }

  // Everything about the chosen record that its matrix does not say outright.
  function facts(host, record) {
    const point = (p) => `(${p.map((v) => Numbers.format(v, 5)).join(', ')}) ${length}`;
    const along = ([x, y]) => `along ${Numbers.degrees(Math.atan(y / x))}`;
    const list = [];
    if (record.ellipse) {
      const { weight, centre, major, minor, orientation } = record.ellipse;
      list.push(
        ['Elastic weight', `${Numbers.format(weight, 5)} rad/(${force}·${length})`],
        ['Elastic centre', point(centre)],
        ['Semi-axes a, b', `${Numbers.format(major, 5)}, ${Numbers.format(minor, 5)} ${length}`],
        ['Direction of a', Numbers.degrees(orientation)],
      );
    } else {
      list.push(['Elastic weight', '0: no moment turns it, and it has no ellipse']);
    }
    ['Greater', 'Lesser'].forEach((name, i) => list.push([
      `${name} compliance`,
      `${Numbers.format(record.principal_compliances[i], 5)} ${length}/${force} `
        + along(record.principal_directions[i])]));
    if (record.antipolar) {
      list.push(['Antipolar',
        `through ${point(record.antipolar.point)} ${along(record.antipolar.direction)}`]);
    }
    const rows = d3.select(host).append('dl').attr('class', 'record-facts').selectAll('div')
      .data(list).enter().append('div');
    rows.append('dt').text(([name]) => name);
    rows.append('dd').text(([, value]) => value);
  }

  // What the lines in the figure mean.
  const key = [
    ['key-ellipse', 'ellipse of elasticity, its centre and semi-axes a and b'],
    ['key-cross', 'principal compliances at the point: arms in proportion, the longer one to fit'],
    ['key-antipolar', 'antipolar of the point: the poles of all forces through it'],
    ['key-pole', 'pole of a load of this study: the body turns about it'],
  ];

  function makeKey(host) {
    const items = d3.select(host).append('ul').attr('class', 'key').selectAll('li').data(key)
      .enter().append('li');
    items.append('span').attr('class', ([name]) => `key-sign ${name}`);
    items.append('span').text(([, text]) => text);
  }

  function recordTable(host, records) {
    const ellipse = (value) => (r) => (r.ellipse ? value(r.ellipse) : '–');
    const angle = ([x, y]) => Numbers.degrees(Math.atan(y / x));
    const columns = [
      {
        title: 'Of', left: true, fill: (cell, r) => {
          cell.append('button').attr('type', 'button').attr('class', 'row-button').text(r.name)
            .on('click', () => State.set({ record: records.indexOf(r) }));
          cell.append('span').attr('class', 'faint').text(r.of);
        },
      },
      {
        title: 'Elastic weight',
        unit: `rad/(${force}·${length})`,
        text: (r) => Numbers.format(r.ellipse ? r.ellipse.weight : 0, 5),
      },
      { title: 'Centre x', unit: length, text: ellipse((e) => Numbers.format(e.centre[0], 5)) },
      { title: 'Centre y', unit: length, text: ellipse((e) => Numbers.format(e.centre[1], 5)) },
      { title: 'Semi-axis a', unit: length, text: ellipse((e) => Numbers.format(e.major, 5)) },
      { title: 'Semi-axis b', unit: length, text: ellipse((e) => Numbers.format(e.minor, 5)) },
      { title: 'Direction of a', text: ellipse((e) => Numbers.degrees(e.orientation)) },
      {
        title: 'Greater compliance',
        unit: `${length}/${force}`,
        text: (r) => Numbers.format(r.principal_compliances[0], 5),
      },
      { title: 'Its direction', text: (r) => angle(r.principal_directions[0]) },
      {
        title: 'Lesser compliance',
        unit: `${length}/${force}`,
        text: (r) => Numbers.format(r.principal_compliances[1], 5),
      },
    ];
    const rows = Tables.make(host, columns, records).attr('class', (r) => `is-record of-${r.of}`)
      .on('click', (r) => State.set({ record: records.indexOf(r) }));
    State.follow(['record'], () => rows.classed('is-chosen', (_, i) => i === State.chosen.record));
  }

  function poleTable(host, poles) {
    if (poles.length === 0) return;
    const section = d3.select(host).append('section').attr('class', 'panel');
    section.append('h2').text('Poles of the loads');
    const vector = (v) => `(${v.map((x) => Numbers.short(x, 5)).join(', ')})`;
    Tables.make(section.node(), [
      { title: 'Load on', left: true, text: (p) => `${poles.indexOf(p) + 1}: ${p.load}` },
      { title: 'Force', unit: force, text: (p) => vector(p.force) },
      { title: 'Moment', unit: `${force}·${length}`, text: (p) => Numbers.short(p.moment) },
      { title: 'Displacement', unit: length, text: (p) => vector(p.displacement) },
      { title: 'Rotation', unit: 'rad', text: (p) => Numbers.format(p.rotation, 5) },
      { title: 'Pole', unit: length, text: (p) => (p.pole ? vector(p.pole) : 'translation') },
    ], poles);
  }

  function make(host, study) {
    const { records, poles } = study.linear;
    // Points are what a reader asks about first.
    State.set({ record: Math.max(0, records.findIndex((r) => r.of === 'point')) });
    const stage = d3.select(host).append('div').attr('class', 'stage');
    const left = stage.append('section').attr('class', 'panel mechanism').node();
    toggles(left, records);
    const label = `Ellipses of elasticity in study ${study.name}`;
    const view = new View(left, boxOf(study.linear), label, (v) => drawFigure(v, study));
    d3.select(left).append('p').attr('class', 'hint').text(
      'Drawn to scale. Choose a row of the table below to see its ellipse. '
      + 'Drag to pan, Ctrl and wheel to zoom.');
    const right = stage.append('section').attr('class', 'panel plots').node();
    const card = d3.select(right).append('div').node();
    State.follow(['record'], () => {
      card.textContent = '';
      const record = records[State.chosen.record];
      if (!record) return;
      matrix(card, record);
      facts(card, record);
    });
    makeKey(right);
    State.follow(['record', 'groups'], () => view.redraw());
    const table = d3.select(host).append('section').attr('class', 'panel');
    table.append('h2').text('Ellipses of elasticity');
    recordTable(table.node(), records);
    poleTable(host, poles);
    const all = d3.select(host).append('section').attr('class', 'panel');
    all.append('h2').text('Compliance matrices');
    const grid = all.append('div').attr('class', 'matrices').node();
    for (const record of records) matrix(grid, record);
  }

  return { make };
})();
