'use strict';
// Starts the page: provenance, tabs, and the study that the address names.
(() => {
  const { data } = State;
  const main = document.getElementById('study');

  function provenance() {
    const facts = [
      ['model', data.model_file],
      ['units', `${data.units.length}, ${data.units.force}, ${data.units.time}, rad`],
      ['flexura', data.version],
    ].filter(([, value]) => value);
    const items = d3.select('#provenance').selectAll('div').data(facts).enter().append('div');
    items.append('dt').text(([name]) => name);
    items.append('dd').text(([, value]) => value);
  }

  const vector = (v) => `(${v.map((x) => Numbers.short(x)).join(', ')})`;

  function loadText({
    on, force, moment, follower, constant, history,
  }) {
    const { units } = State;
    const parts = [];
    if (force[0] !== 0 || force[1] !== 0) parts.push(`force ${vector(force)} ${units.force}`);
    if (moment !== 0) parts.push(`moment ${Numbers.short(moment)} ${units.force}·${units.length}`);
    return `${parts.join(' and ') || 'no load'} on ${on}${follower ? ', turning with it' : ''}`
      + `${constant ? ', there from the start' : ''}${history ? `, ${history.words}` : ''}`;
  }

  // How a study of motion was made.
  function motionTexts({ motion, response }) {
    const { method, damping } = motion || response || {};
    return [
      ...(method ? [`Integrated by ${method.replace(/_/g, ' ')}`] : []),
      ...(damping ? [`Damping: ${damping}`] : []),
    ];
  }

  function fieldTexts({ spread, gravity, temperature, constant }) {
    const { length, force, time } = State.units;
    const texts = spread.map(({ flexure, per_length: q }) => (
      `${vector(q)} ${force}/${length} along ${data.drawing.flexures[flexure].name}`));
    if (gravity[0] !== 0 || gravity[1] !== 0) {
      texts.push(`gravity ${vector(gravity)} ${length}/${time}²`);
    }
    if (temperature !== 0) texts.push(`${Numbers.short(temperature)} degrees of temperature`);
    return texts.map((text) => `${text}${constant ? ', there from the start' : ''}`);
  }

  function headline(study) {
    const header = d3.select(main).append('div').attr('class', 'study-header');
    const kinds = {
      path: 'Path of equilibria as the loads grow',
      buckling: 'Load factors at which the mechanism gives way',
      inverse: 'Loads that hold prescribed displacements',
      linear: 'Compliance about the drawn state',
      modes: 'Natural frequencies and the shapes of their modes',
      transient: 'Motion in time',
      response: 'Steady motion under loads that go as a cosine',
      linkage: 'Elastic motion of a driven linkage over a turn',
    };
    header.append('p').attr('class', 'study-kind').text(kinds[study.kind] || study.kind);
    for (const load of study.loads) {
      header.append('p').attr('class', 'faint').text(loadText(load));
    }
    for (const text of [...fieldTexts(study.fields), ...motionTexts(study)]) {
      header.append('p').attr('class', 'faint').text(text);
    }
    if (!study.converged && study.reason) {
      header.append('p').attr('class', 'study-stopped').text(study.reason);
    }
  }

  function open(study) {
    if (State.chosen.study === study) return;
    State.forget();
    State.set({ study });
    main.textContent = '';
    d3.selectAll('#tabs button').attr('aria-selected', (s) => s === study)
      .attr('tabindex', (s) => (s === study ? 0 : -1));
    main.setAttribute('aria-label', `Study ${study.name}`);
    headline(study);
    const page = [[study.path, PathStudy], [study.modes, ModeStudy],
      [study.motion, TransientStudy], [study.response, ResponseStudy],
      // Only a report that has a linkage has its page.
      [study.linkage, study.linkage && LinkageStudy], [study.linear, LinearStudy]];
    page.find(([content]) => content)[1].make(main, study);
  }

  const address = (study) => `#${encodeURIComponent(study.name)}`;

  function openAddressed() {
    const [study, drawn] = window.location.hash.slice(1).split('/');
    let name = '';
    try {
      name = decodeURIComponent(study);
    } catch (error) {
      name = ''; // an address that is no valid encoding names no study
    }
    open(data.studies.find((s) => s.name === name) || data.studies[0]);
    if (SectionForces.named(drawn)) State.set({ diagram: drawn });
    if (StressFields.named(drawn)) State.set({ field: drawn });
  }

  function tabs() {
    const visit = (study) => { window.location.hash = address(study); };
    const buttons = d3.select('#tabs').selectAll('button').data(data.studies).enter()
      .append('button').attr('type', 'button').attr('role', 'tab').attr('aria-controls', 'study')
      .attr('data-study', (study) => study.name).attr('data-kind', (study) => study.kind)
      .on('click', visit);
    buttons.append('span').text((study) => study.name);
    buttons.append('span').attr('class', 'faint').text((study) => study.kind);
    buttons.filter((study) => !study.converged).append('span').attr('class', 'tab-stopped')
      .attr('title', 'stopped early').text('stopped');
    buttons.on('keydown', (study, i) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[d3.event.key];
      const next = step && data.studies[i + step];
      if (!next) return;
      visit(next);
      buttons.nodes()[i + step].focus();
    });
  }

  provenance();
  if (data.studies.length === 0) {
    d3.select(main).append('p').attr('class', 'message').text('This run had no studies.');
    return;
  }
  tabs();
  window.addEventListener('hashchange', openAddressed);
  openAddressed();
})();
