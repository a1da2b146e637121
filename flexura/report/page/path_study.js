'use strict';
// A study of kind path or inverse: figure, slider, plots and tables.
const PathStudy = (() => {
  // The whole path of every point, faint, and what is behind the slider, firm.
  function drawTraces(view, path, shown, timeline) {
    const line = d3.line();
    const items = shown.flatMap(({ modeling, state }) => path.points.map((name, p) => {
      const times = timeline.positions(modeling);
      const look = { modeling: modeling.label, colour: State.colour(modeling.label) };
      const way = (until) => Motion.trace(modeling, times, p, until).map((q) => view.project(q));
      const all = way(Infinity);
      const until = [...way(State.chosen.position), view.project(state.points[p])];
      return [
        { ...look, d: line(all), class: 'trace', key: `${modeling.label} ${name} all` },
        { ...look, d: line(until), class: 'trace is-passed', key: `${modeling.label} ${name}` },
        {
          ...look,
          d: Shapes.circle(view.project(state.points[p]), 3.5),
          class: 'point',
          key: `${modeling.label} ${name} now`,
        },
      ];
    }).flat());
    view.paths('traces', items);
  }

  function hintFor(path, strays) {
    const sentences = ['Grey: undeformed. Drawn to scale; flexures have their true depth, but are '
      + 'never thinner than a hairline.'];
    if (path.modelings.some((m) => m.states.some((state) => state.unstable))) {
      sentences.push('Dashed: unstable.');
    }
    if (path.modelings.some((m) => !m.converged)) {
      sentences.push('Pale: the last state of a modeling that stopped before.');
    }
    if (strays.length > 0) {
      sentences.push(`Out of this view in the end: ${strays.join(', ')}; zoom out to follow.`);
    }
    return `${sentences.join(' ')} Drag to pan, Ctrl and wheel to zoom.`;
  }

  function make(host, study) {
    const { path } = study;
    const timeline = Motion.timeline(path);
    if (study.kind === 'inverse') timeline.name = 'share prescribed';
    const subjects = Motion.subjects(path);
    State.set({ position: timeline.end, subject: 0, flexure: 0 });
    const stage = d3.select(host).append('div').attr('class', 'stage');
    const left = stage.append('section').attr('class', 'panel mechanism').node();
    Figure.legend(left, path.modelings);
    const caption = Diagrams.chooser(left);
    const fields = StressFields.make(left, path, timeline);
    const label = `The mechanism, undeformed and deformed, in study ${study.name}`;
    const { box, strays } = Figure.frameOf(path, (m) => m.states.flatMap(
      (s) => [...s.points, ...s.axes.flatMap(Motion.pairs)]));
    const view = new View(left, box, label, (v) => {
      const shown = Figure.shownStates(path, timeline, Motion.stateAt);
      caption.text(Figure.draw(v, study, path, shown, () => (
        drawTraces(v, path, shown, timeline))));
      fields.draw(v, shown);
    });
    Transport.make(left, timeline);
    d3.select(left).append('p').attr('class', 'hint').text(hintFor(path, strays));
    const right = stage.append('section').attr('class', 'panel plots').node();
    PathPlots.make(right, study, subjects, timeline);
    if (path.held.length > 0) ReactionPlots.make(host, study, timeline);
    StagePlots.make(host, study, timeline);
    State.follow(['position', 'hidden'], () => view.redraw());
    // Section forces are those of the last state, so that is where the reader is taken.
    State.follow(['diagram'], () => {
      if (State.chosen.diagram) State.set({ position: timeline.end });
      else view.redraw();
    });
    // So are stresses, where no others were kept.
    State.follow(['field'], () => {
      if (State.chosen.field && fields.onlyAtEnd) State.set({ position: timeline.end });
      else view.redraw();
    });
    const comparison = d3.select(host).append('section').attr('class', 'panel');
    comparison.append('h2').text('Comparison');
    const table = comparison.append('div').attr('id', 'comparison').node();
    State.follow(['subject'], () => {
      table.textContent = '';
      Tables.comparison(table, path, subjects);
    });
    MemberPlots.make(host, study, timeline);
  }

  return { make };
})();
