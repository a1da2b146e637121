'use strict';
// What holds a prescribed body or point: force and moment along the path, and, where it is driven,
// force against displacement with the forces at which it would snap and the places where it would
// stay when let go.
const ReactionPlots = (() => {
  const { length, force } = State.units;
  const parts = [`Force in x, ${force}`, `Force in y, ${force}`, `Moment, ${force}·${length}`];

  function chooser(host, held) {
    const label = d3.select(host).append('label').attr('class', 'chooser');
    label.append('span').text('Held');
    const select = label.append('select').attr('id', 'held')
      .on('change', function changed() { State.set({ held: Number(this.value) }); });
    select.selectAll('option').data(held).enter().append('option')
      .attr('value', (_, i) => i).text((place) => place.name);
  }

  // The part of the reaction that drives, and the way it goes: the largest over all states.
  function drivingPart(path, index) {
    const sizes = [0, 1, 2].map((part) => d3.max(path.modelings.flatMap((m) => (
      m.states.map((s) => (s.reactions ? Math.abs(s.reactions[index][part]) : 0))))) || 0);
    return sizes[1] >= sizes[0] ? 1 : 0;
  }

  // Displacement and force along the way that the reference is driven: both then begin positive.
  function travel(path, index, part) {
    const held = path.held[index];
    const moved = (state, first) => (
      Motion.heldPlace(held, state)[part] - Motion.heldPlace(held, first)[part]);
    const { states } = path.modelings[path.reference];
    const sense = moved(states[states.length - 1], states[0]) < 0 ? -1 : 1;
    return (state, first) => ({
      x: sense * moved(state, first), y: sense * state.reactions[index][part],
    });
  }

  function driven(path, index, part) {
    const way = travel(path, index, part);
    return path.modelings.filter((m) => !State.chosen.hidden.has(m.label)).map((m) => {
      const first = m.states[0];
      const at = (state) => way(state, first);
      const marks = m.reaction_events.filter((e) => e.load_factor > 0).map((e) => ({
        ...at(e.state),
        title: `${m.label}: ${e.kind === 'equilibrium'
          ? `${e.stable ? 'stable' : 'unstable'} equilibrium` : e.kind}`,
      }));
      const points = m.states.filter((s) => s.reactions)
        .map((s) => ({ ...at(s), unstable: s.unstable }));
      return {
        label: m.label,
        colour: State.colour(m.label),
        points,
        marks,
        isReference: m === path.modelings[path.reference],
      };
    });
  }

  function eventTable(host, path) {
    const rows = path.modelings.flatMap((m) => m.reaction_events.map((e) => ({ m, e })));
    if (rows.length === 0) return;
    const table = d3.select(host).append('div').attr('class', 'table-frame')
      .append('table').attr('class', 'reaction-events');
    const number = (i) => i > 1;
    table.append('thead').append('tr').selectAll('th')
      .data(['modeling', 'passes', 'load factor', `reaction, ${force}`]).enter()
      .append('th').classed('is-left', (_, i) => !number(i)).text((t) => t);
    const lines = table.append('tbody').selectAll('tr').data(rows).enter().append('tr');
    lines.append('td').attr('class', 'is-left').text(({ m }) => m.label);
    lines.append('td').attr('class', 'is-left').text(({ e }) => (e.kind === 'equilibrium'
      ? `equilibrium at zero force, ${e.stable ? 'stable' : 'unstable'}` : e.kind));
    lines.append('td').text(({ e }) => Numbers.format(e.load_factor, 6));
    lines.append('td').text(({ e }) => Numbers.format(e.reaction, 6));
  }

  function make(host, study, timeline) {
    const { path } = study;
    State.set({ held: 0 });
    const section = d3.select(host).append('section').attr('class', 'panel reactions');
    const heading = section.append('h2');
    if (path.held.length > 1) chooser(section.node(), path.held);
    const grid = section.append('div').attr('class', 'charts charts-thirds').node();
    const common = PathPlots.optionsFor(timeline);
    // rounding beside the largest force, on the mechanism's size, is no reaction
    const largest = d3.max(path.modelings.flatMap((m) => m.states.flatMap((s) => (
      (s.reactions || []).map(([x, y]) => Math.hypot(x, y)))))) || 0;
    const charts = parts.map((title, part) => new Chart(grid, {
      ...common, title, noise: 1e-6 * largest * (part === 2 ? Mechanism.extent : 1),
    }));
    const drives = path.modelings.some((m) => m.reaction_events.length > 0);
    const curve = drives ? new Chart(
      section.append('div').attr('class', 'charts drive-curve').node(),
      { title: `Force against displacement, ${force}`, xTitle: `displacement, ${length}` },
    ) : null;
    State.follow(['held', 'hidden'], () => {
      const index = State.chosen.held;
      heading.text(`Reactions that hold ${path.held[index].name}`);
      charts.forEach((chart, part) => chart.show(PathPlots.lines(path, timeline, (state) => (
        state.reactions ? state.reactions[index][part] : null))));
      if (!curve) return;
      const part = drivingPart(path, index);
      curve.show(driven(path, index, part), `${parts[part]}, along the way it is driven`);
    });
    State.follow(['position'], () => {
      for (const chart of charts) chart.mark(State.chosen.position);
    });
    eventTable(section.node(), path);
  }

  return { make };
})();
