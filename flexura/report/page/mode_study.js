'use strict';
// A study of kind buckling or modes: the shape of a mode, swinging, a table of all and, along a
// path, how frequencies change with the load.
const ModeStudy = (() => {
  const cycles = Numbers.cycles(State.units.time);
  const largest = 0.12; // drawn amplitude, of the mechanism's size

  // How the values of a study are called and written. An angular frequency that is negative is the
  // rate at which an unstable mode grows.
  const perTurn = (w) => w / (2 * Math.PI);
  const loadFactors = {
    title: 'Load factors',
    unit: '',
    isUnstable: () => false,
    text: (value) => Numbers.format(value, 6),
    sentence: (value) => `load factor ${Numbers.format(value, 6)}`,
  };
  const frequencies = {
    title: 'Frequencies',
    unit: cycles,
    isUnstable: (value) => value < 0,
    text: (value) => (value < 0 ? 'unstable' : Numbers.format(perTurn(value), 6)),
    sentence: (value) => (value < 0
      ? `unstable, grows e-fold in ${Numbers.format(-1 / value, 4)} ${State.units.time}`
      : `frequency ${Numbers.format(perTurn(value), 6)} ${cycles}`),
  };

  // What is drawn at a moment: the equilibrium and `amplitude` times the shape.
  function moved(mode, amplitude) {
    return {
      bodies: mode.bodies.map((pose, b) => pose.map(
        (v, c) => v + amplitude * mode.shape_bodies[b][c])),
      axes: mode.axes.map((axis, k) => Motion.pairs(axis.map(
        (v, i) => v + amplitude * mode.shape_axes[k][i]))),
    };
  }

  function drawFigure(view, modes, mode, { label, modeling }, swing) {
    const look = {
      key: 'mode', modeling: label, colour: State.colour(label), chain: modeling === 'prbm',
    };
    const { bodies, axes } = moved(mode, largest * Mechanism.extent * swing);
    const carried = Figure.carriedBy(modes.bodies, bodies, true);
    Mechanism.drawGhost(view);
    Mechanism.drawGround(view);
    view.paths('springs', Mechanism.springItems(view, carried, look));
    view.paths('bodies', modes.bodies.map((name) => (
      Mechanism.bodyItem(view, Motion.bodies.get(name), carried(name).move, look))));
    view.paths('flexures', Mechanism.flexureItems(view, axes, look));
    view.paths('connections', Mechanism.connectionItems(view, carried, look));
    view.paths('joints', look.chain ? Mechanism.chainItems(view, axes, look) : []);
  }

  function table(host, modes, values, choose) {
    const panel = d3.select(host).append('section').attr('class', 'panel');
    panel.append('h2').text(values.title);
    const count = d3.max(modes.modelings, (m) => m.modes.length) || 0;
    const columns = [
      {
        title: 'Modeling',
        left: true,
        fill: (cell, m) => {
          cell.append('span').attr('class', 'swatch');
          cell.append('span').text(m.label);
        },
      },
      ...d3.range(count).map((k) => ({
        title: `Mode ${k + 1}`,
        unit: values.unit,
        fill: (cell, m) => {
          if (!m.modes[k]) return;
          const { value } = m.modes[k];
          cell.append('button').attr('type', 'button').attr('class', 'row-button')
            .attr('data-mode', `${m.label} ${k + 1}`)
            .classed('is-unstable', values.isUnstable(value)).text(values.text(value))
            .on('click', () => choose(m, k));
        },
      })),
      { title: 'Unknowns', text: (m) => m.unknowns },
      { title: 'Time', text: (m) => Numbers.duration(m.seconds) },
      { title: 'Error estimate', text: (m) => Numbers.percent(m.error_estimate, 2) },
      {
        title: 'Difference',
        text: (m) => (m === modes.modelings[modes.reference]
          ? 'reference' : Numbers.percent(m.difference)),
      },
    ];
    const rows = Tables.make(panel.append('div').attr('id', 'modes').node(), columns,
      modes.modelings);
    rows.style('--colour', (m) => State.colour(m.label)).attr('class', 'is-modeling');
    for (const m of modes.modelings.filter((n) => n.reason)) {
      panel.append('p').attr('class', m.converged ? 'faint' : 'study-stopped')
        .text(`${m.label}: ${m.reason}`);
    }
  }

  // One line per modeling and mode; growing modes are below zero, and dashed.
  function curves(host, modes) {
    if (!modes.modelings.some((m) => m.curve.length > 1)) return;
    const section = d3.select(host).append('section').attr('class', 'panel frequencies');
    section.append('h2').text('Frequencies along the path');
    Figure.legend(section.node(), modes.modelings);
    const chart = new Chart(section.append('div').attr('class', 'charts one-chart').node(), {
      title: `Frequency, ${cycles}`, xTitle: 'load factor',
    });
    const line = (m, k) => ({
      label: `${m.label}, mode ${k + 1}`,
      colour: State.colour(m.label),
      points: m.curve.filter((point) => Numbers.isNumber(point.values[k])).map((point) => ({
        x: point.load_factor, y: perTurn(point.values[k]), unstable: point.values[k] < 0,
      })),
      isReference: m === modes.modelings[modes.reference],
    });
    State.follow(['hidden'], () => {
      const shown = modes.modelings.filter((m) => !State.chosen.hidden.has(m.label));
      chart.show(shown.flatMap((m) => (
        d3.range(d3.max(m.curve, (point) => point.values.length) || 0).map((k) => line(m, k)))));
    });
    if (modes.modelings.some((m) => m.curve.some((point) => point.values.some((w) => w < 0)))) {
      section.append('p').attr('class', 'hint').text('Dashed, below zero: unstable modes, at the '
        + 'rate at which they grow, over 2π.');
    }
  }

  function swingWhileShown(node, redraw) {
    if (window.matchMedia('(prefers-reduced-motion: reduce)').matches) return;
    const timer = d3.timer((elapsed) => {
      if (document.contains(node)) redraw(Math.cos(elapsed / 400));
      else timer.stop();
    });
  }

  // The figure of the modes; returns show(modeling, number).
  function makeFigure(host, study, values) {
    let chosen = null;
    let swing = 1;
    const panel = d3.select(host).append('section').attr('class', 'panel mechanism');
    const title = panel.append('h2');
    const box = Mechanism.undeformedBox.map(([x, y], i) => {
      const out = (i === 0 ? -1 : 1) * largest * Mechanism.extent;
      return [x + out, y + out];
    });
    const view = new View(panel.node(), box, `A mode of study ${study.name}`, (v) => {
      if (!chosen) return;
      const { modeling, number } = chosen;
      drawFigure(v, study.modes, modeling.modes[number], modeling, swing);
    });
    panel.append('p').attr('class', 'hint').text('Grey: as drawn. The size of the motion is '
      + 'free: the largest displacement is drawn as an eighth of the mechanism.');
    swingWhileShown(panel.node(), (now) => {
      swing = now;
      view.redraw();
    });
    return (modeling, number) => {
      chosen = { modeling, number };
      title.text(`Mode ${number + 1} by ${modeling.label}, `
        + `${values.sentence(modeling.modes[number].value)}`);
      view.redraw();
    };
  }

  function make(host, study) {
    const { modes } = study;
    const values = study.kind === 'modes' ? frequencies : loadFactors;
    const reference = modes.modelings[modes.reference];
    const first = reference && reference.modes.length > 0
      ? reference : modes.modelings.find((m) => m.modes.length > 0);
    const show = first ? makeFigure(host, study, values) : () => {};
    if (first) show(first, 0);
    table(host, modes, values, show);
    curves(host, modes);
  }

  return { make };
})();
