'use strict';
// Of a motion: velocity against displacement, and where the energy is.
const TimePlots = (() => {
  const { length, force, time } = State.units;

  // Displacement and velocity of a component, by central differences of the times embedded.
  function phases(modeling, valueOf) {
    const known = modeling.states.map((state) => ({ t: state.time, x: valueOf(state) }))
      .filter(({ x }) => Numbers.isNumber(x));
    if (known.length < 2) return [];
    return known.map(({ t, x }, i) => {
      const a = known[Math.max(0, i - 1)];
      const b = known[Math.min(known.length - 1, i + 1)];
      return { t, x: x - known[0].x, y: (b.x - a.x) / (b.t - a.t) };
    });
  }

  function placeAt(points, t) {
    const next = d3.bisector((p) => p.t).right(points, t);
    const a = points[Math.max(0, next - 1)];
    const b = points[Math.min(next, points.length - 1)];
    const share = b.t > a.t ? (t - a.t) / (b.t - a.t) : 0;
    return { x: a.x + share * (b.x - a.x), y: a.y + share * (b.y - a.y) };
  }

  function phaseLines(motion, valueOf) {
    return motion.modelings.filter((m) => !State.chosen.hidden.has(m.label)).map((m) => ({
      label: m.label,
      colour: State.colour(m.label),
      points: phases(m, valueOf),
      isReference: m === motion.modelings[motion.reference],
    })).filter((line) => line.points.length > 0);
  }

  function makePhases(host, motion, subjects) {
    const section = d3.select(host).append('section').attr('class', 'panel phases');
    const heading = section.append('h2');
    const grid = section.append('div').attr('class', 'charts charts-thirds').node();
    const figure = (name, unit, size, valueOf) => {
      const noise = 1e-9 * size;
      const step = d3.max(motion.modelings, (m) => m.largest_step) || 1;
      const chart = new Chart(grid, {
        title: `Velocity, ${unit}/${time}`,
        xTitle: `${name}, ${unit}`,
        free: true,
        smooth: true,
        xNoise: noise,
        noise: noise / step,
      });
      return { chart, valueOf, lines: [] };
    };
    const figures = [
      figure('displacement in x', length, Mechanism.extent, (subject, state) => (
        subject.place(state)[0])),
      figure('displacement in y', length, Mechanism.extent, (subject, state) => (
        subject.place(state)[1])),
      figure('rotation since the start', 'rad', 1, (subject, state) => subject.rotation(state)),
    ];
    const mark = () => {
      for (const { chart, lines } of figures) {
        chart.markAt(lines.map(({ points, colour }) => (
          { ...placeAt(points, State.chosen.position), colour })));
      }
    };
    State.follow(['subject', 'hidden'], () => {
      const subject = subjects[State.chosen.subject];
      heading.text(`Phases of ${subject.name}`);
      for (const figure_ of figures) {
        figure_.lines = phaseLines(motion, (state) => figure_.valueOf(subject, state));
        figure_.chart.show(figure_.lines);
      }
      mark();
    });
    State.follow(['position'], mark);
  }

  function makeEnergies(host, motion, timeline) {
    const unit = `${force}·${length}`;
    const section = d3.select(host).append('section').attr('class', 'panel energies');
    section.append('h2').text('Energies');
    const dissipates = motion.modelings.some((m) => m.energies.dissipated.some((v) => v !== 0));
    const grid = section.append('div')
      .attr('class', `charts ${dissipates ? 'charts-thirds' : 'charts-wide'}`).node();
    const charts = [
      ['kinetic', 'Kinetic energy'],
      ['strain', 'Strain energy'],
      ['total', 'Kinetic and strain energy less work'],
      ...(dissipates ? [['dissipated', 'Dissipated']] : []),
      ['error', 'Error of the energy balance'],
    ].map(([key, name]) => [key, new Chart(grid, {
      ...PathPlots.optionsFor(timeline), title: `${name}, ${unit}`,
    })]);
    State.follow(['hidden'], () => {
      for (const [key, chart] of charts) {
        chart.show(PathPlots.lines(motion, timeline, (state, first, m, i) => m.energies[key][i]));
      }
    });
    State.follow(['position'], () => {
      for (const [, chart] of charts) chart.mark(State.chosen.position);
    });
  }

  return { makePhases, makeEnergies };
})();
