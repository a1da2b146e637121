'use strict';
// Section forces along a flexure at the last state of every modeling.
const MemberPlots = (() => {
  const { length, force } = State.units;

  function make(host, study) {
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
    const charts = [
      [new Chart(grid, { xTitle, title: `Bending moment, ${force}·${length}` }), 3],
      [new Chart(grid, { xTitle, title: `Axial force, ${force}` }), 1],
      [new Chart(grid, { xTitle, title: `Shear force, ${force}` }), 2],
      [new Chart(grid, { xTitle, title: `Largest fibre stress, ${force}/${length}²` }), 4],
    ];
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
  }

  return { make };
})();
