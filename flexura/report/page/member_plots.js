'use strict';
// Section forces along a flexure at the last state of every modeling.
const MemberPlots = (() => {
  const { length } = State.units;

  // The largest stress of the chosen flexure along the path, and its strength.
  function makePeaks(host, study, timeline) {
    const { path } = study;
    const { unit } = SectionForces.named('stress');
    const chart = new Chart(host, {
      ...PathPlots.optionsFor(timeline),
      title: `Largest stress ${timeline.unit ? 'over time' : 'along the path'}, ${unit}`,
    });
    State.follow(['flexure', 'hidden'], () => {
      const k = State.chosen.flexure;
      const lines = PathPlots.lines(path, timeline, (state) => (state.peaks || [])[k]);
      const strength = path.strengths[k];
      const far = d3.max(lines.flatMap((line) => line.points), (p) => p.y) || 0;
      if (Numbers.isNumber(strength) && far > 0.1 * strength) {
        lines.push({
          label: 'strength',
          colour: 'var(--faint)',
          points: [0, timeline.end].map((x) => ({ x, y: strength })),
        });
      }
      chart.show(lines);
    });
    State.follow(['position'], () => chart.mark(State.chosen.position));
  }

  function make(host, study, timeline) {
    const path = study.path;
    const withMembers = path.modelings.filter((m) => m.members.some((rows) => rows.length > 0));
    if (withMembers.length === 0) return;
    const section = d3.select(host).append('section').attr('class', 'panel');
    const header = section.append('div').attr('class', 'panel-header');
    header.append('h2').text('Section forces at the last state');
    const label = header.append('label').attr('class', 'chooser');
    label.append('span').text('Flexure');
    label.append('select').attr('id', 'flexure')
      .on('change', function changed() { State.set({ flexure: Number(this.value) }); })
      .selectAll('option').data(path.flexures).enter().append('option')
      .attr('value', (_, i) => i).text((name) => name);
    const grid = section.append('div').attr('class', 'charts charts-wide').node();
    const xTitle = `arc length from the base end, ${length}`;
    const charts = ['bending_moment', 'axial_force', 'shear_force', 'stress'].map((key) => {
      const { name, unit, column } = SectionForces.named(key);
      return [new Chart(grid, { xTitle, title: `${name}, ${unit}` }), column];
    });
    State.follow(['flexure', 'hidden'], () => {
      const shown = withMembers.filter((m) => !State.chosen.hidden.has(m.label));
      for (const [chart, column] of charts) {
        chart.show(shown.map((m) => ({
          label: m.label,
          colour: State.colour(m.label),
          points: (m.members[State.chosen.flexure] || [])
            .map((row) => ({ x: row[0], y: row[column] })),
        })));
      }
    });
    makePeaks(grid, study, timeline);
    section.append('h3').attr('class', 'extremes-title')
      .text('Largest in absolute value, and where');
    Tables.extremes(section.append('div').attr('id', 'extremes').node(), path, timeline);
  }

  return { make };
})();
