'use strict';
// Curves over the turn of a linkage: natural frequencies, strain, deflection and stress of every
// flexure, orbits of points and bodies, and what the drive and the frame feel of rigid links.
const TurnPlots = (() => {
  const { length, force, time } = State.units;
  const cycles = Numbers.cycles(time);
  const slotOf = (k) => `var(--colour-${1 + (k % 8)})`;

  const perCycle = () => (State.chosen.angular ? 1 : 2 * Math.PI);
  const frequencyUnit = () => (State.chosen.angular ? `rad/${time}` : cycles);

  // Both units, whichever the axis has.
  function writtenFrequency(value) {
    const omega = value * perCycle();
    return `${Numbers.format(omega / (2 * Math.PI), 4)} ${cycles} · `
      + `${Numbers.format(omega, 4)} rad/${time}`;
  }

  // A panel with its heading and, at the right of it, what is chosen there.
  function panel(host, name, title) {
    const section = d3.select(host).append('section').attr('class', `panel ${name}`);
    const header = section.append('div').attr('class', 'panel-header');
    header.append('h2').text(title);
    return { section, header };
  }

  const grid = (section, classes) => (
    section.append('div').attr('class', `charts ${classes}`).node());

  function select(header, id, name, options, changed) {
    const label = header.append('label').attr('class', 'chooser');
    label.append('span').text(name);
    const list = label.append('select').attr('id', id)
      .on('change', function choose() { changed(this.value); });
    list.selectAll('option').data(options).enter().append('option')
      .attr('value', ([value]) => value).text(([, text]) => text);
    return list;
  }

  function radios(header, name, title, options, changed) {
    const group = header.append('div').attr('class', 'switch').attr('role', 'radiogroup')
      .attr('aria-label', title);
    const labels = group.selectAll('label').data(options).enter().append('label');
    labels.append('input').attr('type', 'radio').attr('name', name)
      .attr('value', ([value]) => value).attr('aria-label', ([, text]) => text)
      .property('checked', (_, i) => i === 0)
      .on('change', ([value]) => changed(value));
    labels.append('span').text(([, text]) => text);
  }

  // What the colours of a chart's lines mean; returns what shows other names.
  function key(section, title = '') {
    const host = section.append('div').attr('class', 'legend line-key');
    return (names) => {
      host.text('');
      if (title) host.append('b').text(title);
      const items = host.selectAll('.legend-item').data(names).enter().append('span')
        .attr('class', 'legend-item').style('--colour', (_, k) => slotOf(k));
      items.append('span').attr('class', 'swatch');
      items.append('span').text((name) => name);
    };
  }

  const modeNames = () => d3.range(State.chosen.modeCount).map((mode) => `mode ${mode + 1}`);

  function makeFrequencies(host, turn) {
    const rows = turn.followed.length === turn.angles.length ? turn.followed : turn.frequencies;
    if (rows.length === 0 || rows[0].length === 0) return;
    const { section, header } = panel(host, 'frequencies', 'Natural frequencies over the turn');
    const all = rows[0].length;
    State.set({ modeCount: Math.min(3, all), angular: false });
    radios(header, 'frequency-unit', 'Unit of frequencies', [['cycles', cycles],
      ['angular', `rad/${time}`]], (value) => State.set({ angular: value === 'angular' }));
    if (all > 1) {
      select(header, 'mode-count', 'Modes', d3.range(1, all + 1).map((n) => [n, n === 1 ? 'the '
        + 'lowest' : `the lowest ${n}`]), (value) => State.set({ modeCount: Number(value) }))
        .property('value', State.chosen.modeCount);
    }
    const chart = new Chart(grid(section, 'one-chart'), {
      ...Turn.chartOptions(turn), title: 'Frequency', format: writtenFrequency,
    });
    const showNames = key(section);
    State.follow(['modeCount', 'angular'], () => {
      showNames(modeNames());
      chart.show(modeNames().map((label, mode) => ({
        label,
        colour: slotOf(mode),
        points: rows.map((row, i) => ({ x: turn.angles[i], y: row[mode] / perCycle() })),
      })), `Frequency, ${frequencyUnit()}`);
    });
    Turn.followMarks([chart]);
    speedNote(section, turn, rows.some((row) => row[0] < 0));
  }

  function speedNote(section, turn, buckles) {
    section.append('p').attr('class', 'hint').text('Of small vibrations about every angle, each '
      + `mode followed through the turn. The drive turns at ${Numbers.short(
        Turn.inTurns(turn.speed))} ${Turn.speedUnit}, ${Numbers.short(
      Math.abs(turn.speed) / (2 * Math.PI))} ${cycles}.${
      buckles ? ' Negative where a link buckles.' : ''}`);
  }

  const curves = [
    { key: 'strain', title: 'Bending strain at mid-length', unit: '' },
    { key: 'deflection', title: 'Deflection at mid-length', unit: length },
    { key: 'stress', title: 'Largest stress along it', unit: `${force}/${length}²` },
  ];
  const named = ({ title, unit }) => (unit ? `${title}, ${unit}` : title);
  const solved = (turn) => turn.methods.filter((m) => m.flexures.length > 0);

  function makeCurves(host, turn) {
    if (solved(turn).length === 0) return;
    const { section } = panel(host, 'curves', 'Flexures over the turn');
    const charts = [];
    turn.flexures.forEach((name, f) => {
      section.append('h3').text(name);
      const of = grid(section, 'charts-thirds');
      for (const curve of curves) {
        const chart = new Chart(of, { ...Turn.chartOptions(turn), title: named(curve) });
        charts.push(chart);
        State.follow(['hidden'], () => chart.show(Turn.lines(
          turn, (m) => m.flexures[f] && m.flexures[f][curve.key])));
      }
    });
    Turn.followMarks(charts);
    section.append('p').attr('class', 'hint').text('Strain is that of the fibre on the side of +n, '
      + 'to the left on the way from the base to the action end; deflection is across the line '
      + 'between the ends. Press on a chart to turn the linkage there.');
    makePeaks(host, turn);
  }

  function fillPeak(cell, peak) {
    if (!peak) {
      cell.text('–');
      return;
    }
    cell.append('span').text(Numbers.format(peak.value));
    const at = Turn.inDegrees(Turn.degrees(peak.angle));
    cell.append('span').attr('class', 'faint').text(`at ${at}`);
  }

  function makePeaks(host, turn) {
    const { section } = panel(host, 'turn-peaks', 'Peaks over the turn');
    const rows = turn.flexures.flatMap((name, f) => solved(turn).map((m, k) => ({
      name: k === 0 ? name : '', method: m, peaks: m.flexures[f].peaks, strength: turn.strengths[f],
    })));
    const factor = ({ strength, peaks }) => (
      Numbers.isNumber(strength) && peaks.stress.value ? strength / Math.abs(peaks.stress.value)
        : null);
    const columns = [
      { title: 'Flexure', left: true, text: (row) => row.name },
      {
        title: 'Method',
        left: true,
        fill: (cell, row) => Tables.modelingColumn.fill(cell, row.method),
      },
      ...curves.map((curve) => ({
        title: curve.title,
        unit: curve.unit,
        fill: (cell, row) => fillPeak(cell, row.peaks[curve.key]),
      })),
      ...(turn.strengths.some(Numbers.isNumber) ? [{
        title: 'Safety',
        unit: 'strength / stress',
        text: (row) => Numbers.format(factor(row), 3),
        class: (row) => (factor(row) !== null && factor(row) < 1 ? 'is-stopped' : ''),
      }] : []),
    ];
    Tables.make(section.append('div').attr('id', 'turn-peaks').node(), columns, rows)
      .style('--colour', (row) => State.colour(row.method.label));
  }

  // The elastic displacement of the subject over the turn: rows of [x, y], or nothing.
  function orbitOf({ subjects }, method) {
    const subject = subjects[State.chosen.subject];
    return method[subject.kind].map((places) => places[subject.i]);
  }

  function furthest(turn) {
    const reach = turn.subjects.map(({ kind, i }) => d3.max(turn.methods, (m) => d3.max(
      m[kind], (places) => Math.hypot(...places[i]))) || 0);
    return Math.max(0, reach.indexOf(d3.max(reach)));
  }

  function makeOrbits(host, turn) {
    if (!turn.methods.some(Turn.moves) || turn.subjects.length === 0) return;
    State.set({ subject: furthest(turn) });
    const { section, header } = panel(host, 'orbits', 'Elastic displacement');
    select(header, 'subject', 'Of', turn.subjects.map(({ name }, i) => [i, name]),
      (value) => State.set({ subject: Number(value) })).property('value', State.chosen.subject);
    const of = grid(section, 'charts-thirds tall');
    const noise = 1e-9 * Mechanism.extent;
    const orbit = new Chart(of, {
      title: `Orbit: displacement in y, ${length}`,
      xTitle: `displacement in x, ${length}`,
      free: true,
      equal: true,
      xNoise: noise,
      noise,
    });
    const histories = ['x', 'y'].map((axis) => new Chart(of, {
      ...Turn.chartOptions(turn), title: `Displacement in ${axis}, ${length}`, noise,
    }));
    const mark = () => orbit.markAt(Turn.shown(turn).filter(Turn.moves).map((m) => {
      const { kind, i } = turn.subjects[State.chosen.subject];
      const [x, y] = Turn.elasticAt(turn, m, State.chosen.position)[kind][i];
      return { x, y, colour: State.colour(m.label) };
    }));
    State.follow(['hidden', 'subject'], () => {
      orbit.show(Turn.lines(turn, () => []).map((entry, k) => ({
        ...entry,
        points: orbitOf(turn, Turn.shown(turn)[k]).map(([x, y]) => ({ x, y })),
      })));
      histories.forEach((chart, c) => chart.show(
        Turn.lines(turn, (m) => orbitOf(turn, m).map((d) => d[c]))));
      mark();
    });
    State.follow(['position'], mark);
    Turn.followMarks(histories);
  }

  function rigidLine(turn, label, slot, valueOf) {
    return {
      label,
      colour: slotOf(slot),
      points: turn.positions.map((p, i) => ({ x: turn.angles[i], y: valueOf(p) })),
    };
  }

  function makeRigid(host, turn) {
    const { section } = panel(host, 'rigid', 'What moves it: rigid links at the mean speed');
    const angled = turn.positions.some((p) => Numbers.isNumber(p.transmission_angle));
    const of = grid(section, angled ? 'charts-wide' : 'charts-thirds');
    const transmission = ({ transmission_angle: angle }) => (
      Numbers.isNumber(angle) ? Turn.degrees(angle) : null);
    const figures = [
      [`Driving torque, ${force}·${length}`, [['torque', (p) => p.torque]]],
      [`Shaking force, ${force}`, [['in x', (p) => p.shaking_force[0]],
        ['in y', (p) => p.shaking_force[1]], ['size', (p) => Math.hypot(...p.shaking_force)]]],
      [`Shaking moment, ${force}·${length}`, [['moment', (p) => p.shaking_moment]]],
      ...(angled ? [['Transmission angle, degrees', [['angle', transmission]]]] : []),
    ];
    const charts = figures.map(([title, lines]) => {
      const chart = new Chart(of, { ...Turn.chartOptions(turn), title });
      chart.show(lines.map(([label, valueOf], slot) => rigidLine(turn, label, slot, valueOf)));
      return chart;
    });
    Turn.followMarks(charts);
    key(section, 'Shaking force')(['in x', 'in y', 'size']);
    section.append('p').attr('class', 'hint').text('The shaking force is that of the moving masses '
      + 'on the frame, its moment about the centre of the driven body.');
  }

  return {
    makeFrequencies, makeCurves, makeOrbits, makeRigid, panel, grid, select, radios, slotOf,
    key, modeNames, perCycle, frequencyUnit, writtenFrequency,
  };
})();
