'use strict';
// A study of kind buckling: the shape of a mode, swinging, and a table of all.
const ModeStudy = (() => {
  const { length } = State.units;
  const largest = 0.12; // drawn amplitude, of the mechanism's size

  // What is drawn at a moment: the equilibrium and `amplitude` times the shape.
  function moved(mode, amplitude) {
    return {
      bodies: mode.bodies.map((pose, b) => pose.map(
        (v, c) => v + amplitude * mode.shape_bodies[b][c])),
      axes: mode.axes.map((axis, k) => Motion.pairs(axis.map(
        (v, i) => v + amplitude * mode.shape_axes[k][i]))),
    };
  }

  function drawFigure(view, modes, mode, label, swing) {
    const colour = State.colour(label);
    const look = { key: 'mode', modeling: label, colour };
    const amplitude = largest * Mechanism.extent * swing;
    const { bodies, axes } = moved(mode, amplitude);
    Mechanism.drawGhost(view);
    Mechanism.drawGround(view);
    view.paths('bodies', modes.bodies.map((name, b) => {
      const body = Motion.bodies.get(name);
      return Mechanism.bodyItem(view, body, Motion.carry(body, bodies[b], true), look);
    }));
    view.paths('flexures', Mechanism.flexureItems(view, axes, look));
  }

  function table(host, modes, choose) {
    const panel = d3.select(host).append('section').attr('class', 'panel');
    panel.append('h2').text('Load factors');
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
        fill: (cell, m) => {
          if (!m.modes[k]) return;
          cell.append('button').attr('type', 'button').attr('class', 'link')
            .attr('data-mode', `${m.label} ${k + 1}`)
            .text(Numbers.format(m.modes[k].value, 6)).on('click', () => choose(m, k));
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

  function make(host, study) {
    const { modes } = study;
    const first = modes.modelings[modes.reference] && modes.modelings[modes.reference].modes.length
      ? modes.modelings[modes.reference] : modes.modelings.find((m) => m.modes.length > 0);
    let chosen = first ? { modeling: first, number: 0 } : null;
    let swing = 1;
    if (chosen) {
      const panel = d3.select(host).append('section').attr('class', 'panel mechanism');
      const title = panel.append('h2');
      const box = Mechanism.undeformedBox.map(([x, y], i) => {
        const out = (i === 0 ? -1 : 1) * largest * Mechanism.extent;
        return [x + out, y + out];
      });
      const view = new View(panel.node(), box, `A mode of study ${study.name}`, (v) => {
        const { modeling, number } = chosen;
        drawFigure(v, modes, modeling.modes[number], modeling.label, swing);
      });
      panel.append('p').attr('class', 'hint').text('Grey: as drawn. The size of the motion is '
        + 'free: the largest displacement is drawn as an eighth of the mechanism.');
      const still = window.matchMedia('(prefers-reduced-motion: reduce)').matches;
      const show = (modeling, number) => {
        chosen = { modeling, number };
        title.text(`Mode ${number + 1} by ${modeling.label}, load factor `
          + `${Numbers.format(modeling.modes[number].value, 6)}`);
        view.redraw();
      };
      show(chosen.modeling, 0);
      table(host, modes, show);
      if (!still) {
        const node = panel.node();
        const timer = d3.timer((elapsed) => {
          if (!document.contains(node)) {
            timer.stop();
            return;
          }
          swing = Math.cos(elapsed / 400);
          view.redraw();
        });
      }
      return;
    }
    table(host, modes, () => {});
  }

  return { make };
})();
