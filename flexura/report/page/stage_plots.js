'use strict';
// What a designer reads off a stage along the path, and the condensed stiffness of chosen bodies.
const StagePlots = (() => {
  const { length, force } = State.units;

  // Each drawn only where a modeling has it.
  const figures = [
    { key: 'soft', title: `Smallest stiffness, ${force}/${length}` },
    { key: 'stiff', title: `Largest stiffness, ${force}/${length}` },
    { key: 'ratio', title: 'Largest over smallest stiffness' },
    { key: 'across', title: `Parasitic motion across, ${length}`, small: true },
    { key: 'rotation', title: 'Parasitic rotation, rad', small: true },
    { key: 'drift', title: `Drift of the instant centre, ${length}` },
    { key: 'geometric', title: 'Geometric advantage' },
    { key: 'mechanical', title: 'Mechanical advantage' },
  ];

  function valueOf(stage, key) {
    if (!stage) return null;
    if (key === 'ratio') return stage.soft && stage.stiff ? stage.stiff / stage.soft : null;
    return stage[key];
  }

  function makeCharts(host, study, timeline) {
    const { path } = study;
    const section = d3.select(host).append('section').attr('class', 'panel stage-plots');
    section.append('h2').text(`The stage ${path.stage}`);
    const grid = section.append('div').attr('class', 'charts charts-thirds').node();
    const all = path.modelings.flatMap((m) => m.stage);
    const charts = figures
      .filter(({ key }) => all.some((stage) => Numbers.isNumber(valueOf(stage, key))))
      .map(({ key, title, small }) => [key, new Chart(grid, {
        ...PathPlots.optionsFor(timeline),
        title,
        noise: small ? 1e-9 * (key === 'rotation' ? 1 : Mechanism.extent) : 0,
      })]);
    State.follow(['hidden'], () => {
      for (const [key, chart] of charts) {
        chart.show(PathPlots.lines(path, timeline, (state, first, modeling, i) => (
          i === null ? null : valueOf(modeling.stage[i], key))));
      }
    });
    State.follow(['position'], () => {
      for (const [, chart] of charts) chart.mark(State.chosen.position);
    });
  }

  // The reference's matrix, at the first and the last state.
  function makeMatrices(host, path) {
    const { condensed, label } = path.modelings[path.reference];
    if (condensed.length === 0) return;
    const section = d3.select(host).append('section').attr('class', 'panel condensed');
    section.append('h2').text(`Condensed stiffness by ${label}`);
    const names = path.condensed.flatMap((body) => ['x', 'y', 'rotation'].map((c) => `${body}.${c}`));
    for (const { load_factor: factor, matrix } of condensed) {
      section.append('h3').text(`At load factor ${Numbers.short(factor)}`);
      const columns = [
        { title: 'force on', left: true, text: (row) => names[row] },
        ...names.map((name, c) => ({
          title: name, text: (row) => Numbers.format(matrix[row * names.length + c], 6),
        })),
      ];
      Tables.make(section.append('div').node(), columns, d3.range(names.length));
    }
    section.append('p').attr('class', 'hint').text(`Rows: force in ${force} or moment in `
      + `${force}·${length} on a body's centre; columns: its displacement in ${length} or rotation.`);
  }

  function make(host, study, timeline) {
    if (study.path.stage) makeCharts(host, study, timeline);
    makeMatrices(host, study.path);
  }

  return { make };
})();
