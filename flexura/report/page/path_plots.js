'use strict';
// Displacements, rotation and the difference from the reference along a path, for the
// point or body that the reader has chosen.
const PathPlots = (() => {
  const { length } = State.units;

  function chooser(host, subjects) {
    const label = d3.select(host).append('label').attr('class', 'chooser');
    label.append('span').text('Point, body or flexure');
    const select = label.append('select').attr('id', 'subject')
      .on('change', function changed() { State.set({ subject: Number(this.value) }); });
    const groups = [['Points', 'point'], ['Bodies, at their centres', 'body'],
      ['Flexures, at mid-length', 'flexure']];
    for (const [title, kind] of groups) {
      const of = subjects.map((s, i) => ({ ...s, i })).filter((s) => s.kind === kind);
      if (of.length === 0) continue;
      select.append('optgroup').attr('label', title).selectAll('option').data(of).enter()
        .append('option').attr('value', (s) => s.i).text((s) => s.name);
    }
    select.property('value', State.chosen.subject);
  }

  // Load factor against a displacement, for paths on which the load turns back.
  function loadCurve(path, timeline, place) {
    return path.modelings.filter((m) => !State.chosen.hidden.has(m.label)).map((m) => {
      const first = m.states[0];
      const at = (state) => ({ x: place(state, first), y: state.load_factor });
      return {
        label: m.label,
        colour: State.colour(m.label),
        points: m.states.map((state) => ({ ...at(state), unstable: state.unstable })),
        marks: m.events.filter((e) => e.state).map((e) => ({
          ...at(e.state),
          title: `${m.label}: ${e.kind} at load factor ${Numbers.short(e.load_factor)}`,
        })),
        isReference: m === path.modelings[path.reference],
      };
    });
  }

  function makeLoadCurves(host, study, subjects, timeline) {
    const { path } = study;
    const grid = d3.select(host).append('div').attr('class', 'charts').node();
    const charts = ['x', 'y'].map((axis) => new Chart(grid, {
      title: `Load factor against displacement in ${axis}`,
      xTitle: `displacement in ${axis}, ${length}`,
      free: true,
    }));
    const place = (axis) => (state, first) => {
      const subject = subjects[State.chosen.subject];
      return subject.place(state)[axis] - subject.place(first)[axis];
    };
    const mark = () => charts.forEach((chart, axis) => chart.markAt(
      path.modelings.filter((m) => !State.chosen.hidden.has(m.label) && m.states.length > 0)
        .map((m) => {
          const i = Math.min(Math.round(State.chosen.position), m.states.length - 1);
          const state = m.states[Math.max(0, i)];
          return {
            x: place(axis)(state, m.states[0]), y: state.load_factor, colour: State.colour(m.label),
          };
        })));
    State.follow(['subject', 'hidden'], () => {
      charts.forEach((chart, axis) => chart.show(loadCurve(path, timeline, place(axis))));
      mark();
    });
    State.follow(['position'], mark);
  }

  // One line per visible modeling: value(state, first state, modeling, index).
  function lines(path, timeline, value) {
    return path.modelings.filter((m) => !State.chosen.hidden.has(m.label)).map((m) => {
      const isReference = m === path.modelings[path.reference];
      const times = timeline.positions(m);
      const points = m.states.map((state, i) => ({
        x: times[i], y: value(state, m.states[0], m, i), unstable: state.unstable,
      }));
      const marks = timeline.byLoad ? m.events.filter((e) => e.state).map((e) => ({
        x: e.load_factor,
        y: value(e.state, m.states[0], m, null),
        title: `${m.label}: ${e.kind} at load factor ${Numbers.short(e.load_factor)}`,
      })).filter((mark) => Numbers.isNumber(mark.y)) : [];
      return { label: m.label, colour: State.colour(m.label), points, marks, isReference };
    });
  }

  function optionsFor(timeline) {
    const { name, unit } = timeline;
    return {
      xTitle: unit ? `${name}, ${unit}` : name,
      xRange: [0, timeline.end],
      onSeek: (x) => State.set({ position: x }),
    };
  }

  // charts: pairs of a chart and value(subject, its index), which gives the value of a state.
  function follow(charts, study, subjects, timeline) {
    State.follow(['subject', 'hidden'], () => {
      const index = State.chosen.subject;
      for (const [chart, value] of charts) {
        chart.show(lines(study.path, timeline, value(subjects[index], index)));
      }
    });
    State.follow(['position'], () => {
      for (const [chart] of charts) chart.mark(State.chosen.position);
    });
  }

  function make(host, study, subjects, timeline) {
    const path = study.path;
    const reference = path.modelings[path.reference];
    chooser(host, subjects);
    if (!timeline.byLoad) makeLoadCurves(host, study, subjects, timeline);
    const grid = d3.select(host).append('div').attr('class', 'charts').node();
    const common = optionsFor(timeline);
    const offset = (axis) => (subject) => (state, first) => (
      subject.place(state)[axis] - subject.place(first)[axis]);
    const rotation = (subject) => (state) => subject.rotation(state);
    const difference = (_, index) => (state, first, modeling, i) => {
      const series = modeling.differences[index];
      return i === null || !series || series[i] === null ? null : 100 * series[i];
    };
    const moved = { ...common, noise: 1e-9 * Mechanism.extent }; // less is rounding
    const charts = [
      [new Chart(grid, { ...moved, title: `Displacement in x, ${length}` }), offset(0)],
      [new Chart(grid, { ...moved, title: `Displacement in y, ${length}` }), offset(1)],
      [new Chart(grid, { ...common, noise: 1e-9, title: 'Rotation, rad' }), rotation],
    ];
    if (path.modelings.length > 1) {
      charts.push([new Chart(grid, {
        ...common,
        title: `Difference from ${reference.label}, %`,
        log: true,
        empty: `Nothing is shown that differs from ${reference.label}`,
      }), difference]);
    }
    follow(charts, study, subjects, timeline);
  }

  return { make, lines, optionsFor };
})();
