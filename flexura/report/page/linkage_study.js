'use strict';
// A study of kind linkage: the linkage over the turn of its drive, and all that was found of it.
const LinkageStudy = (() => {
  function factsOf(turn) {
    const buckling = turn.buckling_factor;
    return [
      ['Driver', turn.driver],
      ['Mean speed', `${Numbers.short(Turn.inTurns(turn.speed))} ${Turn.speedUnit} (${
        Numbers.short(turn.speed)} rad/${State.units.time})`],
      ['Kind', turn.grashof],
      ['Modeling', turn.modeling],
      ['Damping', turn.damping],
      ['Buckling', Numbers.isNumber(buckling) ? `when the axial forces are ${
        Numbers.short(buckling, 3)} times as large, at ${
        Turn.inDegrees(Turn.degrees(turn.buckling_angle))}` : ''],
    ].filter(([, value]) => value);
  }

  function makeFacts(host, turn) {
    const section = d3.select(host).append('section').attr('class', 'panel linkage-facts');
    section.append('h2').text('The linkage');
    const items = section.append('dl').attr('class', 'record-facts').selectAll('div')
      .data(factsOf(turn)).enter().append('div');
    items.append('dt').text(([name]) => name);
    items.append('dd').text(([, value]) => value);
    if (turn.notes.length === 0) return section.node();
    section.append('h3').text('Findings');
    section.append('ul').attr('class', 'findings').selectAll('li').data(turn.notes).enter()
      .append('li').text((note) => note);
    return section.node();
  }

  function comparison(host, turn) {
    const { section } = TurnPlots.panel(host, 'linkage-comparison', 'Comparison');
    const reference = turn.methods[turn.reference];
    const columns = [
      { ...Tables.modelingColumn, title: 'Method' },
      {
        title: 'Status',
        left: true,
        text: (m) => (m.converged ? 'converged' : 'stopped'),
        class: (m) => (m.converged ? '' : 'is-stopped'),
      },
      { title: 'Unknowns', text: (m) => m.unknowns },
      {
        title: 'Iterations',
        left: true,
        text: (m) => (m.counted ? `${m.iterations} ${m.counted}` : '–'),
      },
      { title: 'Time', text: (m) => Numbers.duration(m.seconds) },
      { title: 'Error estimate', text: (m) => Numbers.percent(m.error_estimate, 2) },
      {
        title: 'Largest difference',
        unit: reference ? `from ${reference.label}` : '',
        text: (m) => (m === reference ? 'reference' : Numbers.percent(m.difference)),
        class: (m) => (m === reference ? 'faint' : 'is-key'),
      },
    ];
    Tables.make(section.append('div').attr('id', 'comparison').node(), columns, turn.methods)
      .style('--colour', (m) => State.colour(m.label))
      .attr('class', 'is-modeling')
      .each(function notes(m) { Tables.addNotes(this, m, columns.length); });
    section.append('p').attr('class', 'hint').text('Errors and differences are those of strains, '
      + 'over the largest strain of their flexure.');
  }

  function make(host, study) {
    const turn = Turn.unpack(study.linkage);
    const stage = d3.select(host).append('div').attr('class', 'stage');
    const figure = stage.append('section').attr('class', 'panel mechanism').node();
    const beside = stage.append('div').attr('class', 'linkage-side').node();
    if (turn.positions.length === 0) {
      LinkageFigure.makeStill(figure, study);
    } else {
      State.set({
        position: 0, exaggeration: Turn.fittingExaggeration(turn), traced: 'all',
      });
      LinkageFigure.make(figure, study, turn);
      TurnPlots.makeFrequencies(beside, turn);
    }
    makeFacts(beside, turn);
    if (turn.positions.length > 0) {
      TurnPlots.makeCurves(host, turn);
      StressSurface.make(host, turn);
      TurnPlots.makeOrbits(host, turn);
      SpeedPlots.makeCampbell(host, turn);
      SpeedPlots.makeStability(host, turn);
      TurnPlots.makeRigid(host, turn);
    }
    if (turn.methods.length > 0) comparison(host, turn);
  }

  return { make };
})();
