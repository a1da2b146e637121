'use strict';
// A study of kind transient: the mechanism in motion, time histories, phases, energies and stress.
const TransientStudy = (() => {
  const { time } = State.units;
  const tail = 0.04; // of the run, drawn firm behind every point

  // The whole ways only change with the view and with what is shown.
  function waysDrawer(view, motion) {
    const line = d3.line().curve(d3.curveCatmullRom);
    let drawn = '';
    return (shown) => {
      const { transform, width, height } = view;
      const key = [transform, width, height, ...shown.map(({ modeling }) => modeling.label)].join();
      if (key === drawn) return;
      drawn = key;
      view.paths('ways', shown.flatMap(({ modeling }) => motion.points.map((name, p) => ({
        d: line(modeling.states.map((state) => view.project(state.points[p]))),
        modeling: modeling.label,
        colour: State.colour(modeling.label),
        key: `${modeling.label} ${name}`,
      }))));
    };
  }

  function drawTails(view, motion, shown, end) {
    const line = d3.line().curve(d3.curveCatmullRom);
    view.paths('traces', shown.flatMap(({ modeling, state }) => {
      const { states, times } = modeling;
      const now = State.chosen.position;
      const from = d3.bisectLeft(times, now - tail * end);
      const behind = states.slice(from, d3.bisectLeft(times, now));
      const look = { modeling: modeling.label, colour: State.colour(modeling.label) };
      return motion.points.flatMap((name, p) => {
        const place = view.project(state.points[p]);
        const way = [...behind.map((s) => view.project(s.points[p])), place];
        return [
          { ...look, d: line(way), class: 'trace is-passed', key: `${modeling.label} ${name}` },
          {
            ...look,
            d: Shapes.circle(place, 3.5),
            class: 'point',
            key: `${modeling.label} ${name} now`,
          },
        ];
      });
    }));
  }

  function hintFor(study, motion, strays) {
    const sentences = ['Grey: as drawn. Drawn to scale; flexures have their true depth, but are '
      + 'never thinner than a hairline.'];
    if (study.loads.length > 0) sentences.push('Arrows of loads grow and shrink with them.');
    if (motion.modelings.some((m) => !m.converged)) {
      sentences.push('Pale: the last state of a modeling that stopped before.');
    }
    if (strays.length > 0) sentences.push(`Out of this view: ${strays.join(', ')}.`);
    return `${sentences.join(' ')} Drag to pan, Ctrl and wheel to zoom.`;
  }

  function makeFigure(host, study, motion, timeline) {
    Figure.legend(host, motion.modelings);
    const caption = Diagrams.chooser(host);
    const { box, strays } = Figure.frameOf(motion, (m) => [
      ...m.states.flatMap((s) => s.points), ...m.frames.flatMap((frame) => frame.axes.flat())]);
    const stateOf = (modeling, times, position) => Course.stateAt(motion, modeling, position);
    let drawWays = null;
    const view = new View(host, box, `The mechanism in motion, in study ${study.name}`, (v) => {
      drawWays = drawWays || waysDrawer(v, motion);
      const shown = Figure.shownStates(motion, timeline, stateOf);
      caption.text(Figure.draw(v, study, motion, shown, () => {
        drawWays(shown);
        drawTails(v, motion, shown, timeline.end);
      }));
    });
    Transport.make(host, timeline);
    d3.select(host).append('p').attr('class', 'hint').text(hintFor(study, motion, strays));
    State.follow(['position', 'hidden'], () => view.redraw());
    // Section forces are those of the last state, so that is where the reader is taken.
    State.follow(['diagram'], () => {
      if (State.chosen.diagram) State.set({ position: timeline.end });
      else view.redraw();
    });
  }

  function table(host, motion) {
    const panel = d3.select(host).append('section').attr('class', 'panel');
    panel.append('h2').text('Comparison');
    const reference = motion.modelings[motion.reference];
    const last = (m) => m.times[m.times.length - 1];
    const columns = [
      Tables.modelingColumn,
      {
        title: 'Status',
        left: true,
        text: (m) => (m.converged ? 'converged'
          : `stopped${m.times.length > 0 ? ` at ${Numbers.short(last(m))} ${time}` : ''}`),
        class: (m) => (m.converged ? '' : 'is-stopped'),
      },
      { title: 'Unknowns', text: (m) => m.unknowns },
      { title: 'Steps', text: (m) => m.steps },
      { title: 'Rejected', text: (m) => m.rejected },
      { title: 'Iterations', text: (m) => m.iterations },
      { title: 'Smallest step', unit: time, text: (m) => Numbers.format(m.smallest_step, 3) },
      { title: 'Largest step', unit: time, text: (m) => Numbers.format(m.largest_step, 3) },
      { title: 'Computing time', text: (m) => Numbers.duration(m.seconds) },
      { title: 'Energy error', text: (m) => Numbers.percent(m.energy_error, 2) },
      { title: 'Error estimate', text: (m) => Numbers.percent(m.error_estimate, 2) },
      {
        title: 'Largest difference',
        unit: reference ? `from ${reference.label}` : '',
        text: (m) => (m === reference ? 'reference' : Numbers.percent(m.difference)),
        class: (m) => (m === reference ? 'faint' : 'is-key'),
      },
    ];
    Tables.make(panel.append('div').attr('id', 'comparison').node(), columns, motion.modelings)
      .style('--colour', (m) => State.colour(m.label))
      .attr('class', 'is-modeling')
      .each(function notes(m) { Tables.addNotes(this, m, columns.length); });
  }

  function make(host, study) {
    const motion = Course.unpackMotion(study.motion);
    const asPath = { ...study, path: motion };
    const timeline = Course.timeline(motion);
    const subjects = Motion.subjects(motion);
    State.set({ position: timeline.end, subject: 0, flexure: 0 });
    const stage = d3.select(host).append('div').attr('class', 'stage');
    makeFigure(stage.append('section').attr('class', 'panel mechanism').node(), study, motion,
      timeline);
    const right = stage.append('section').attr('class', 'panel plots').node();
    PathPlots.make(right, asPath, subjects, timeline);
    TimePlots.makePhases(host, motion, subjects);
    TimePlots.makeEnergies(host, motion, timeline);
    if (motion.held.length > 0) ReactionPlots.make(host, asPath, timeline);
    table(host, motion);
    MemberPlots.make(host, asPath, timeline);
  }

  return { make };
})();
