'use strict';
// Ellipses of elasticity, antipolar lines, poles and principal compliances as drawn items.
const Ellipses = (() => {
  // Positions on the screen of an ellipse's centre and of the ends of its axes.
  function axesOf(view, { centre, major, minor, orientation }) {
    const end = (size, angle) => [
      centre[0] + size * Math.cos(angle), centre[1] + size * Math.sin(angle)];
    const project = (p) => view.project(p);
    return {
      centre: project(centre),
      major: [end(-major, orientation), end(major, orientation)].map(project),
      minor: [end(-minor, orientation + Math.PI / 2), end(minor, orientation + Math.PI / 2)]
        .map(project),
    };
  }

  // Where the name of an axis stands clear of its end.
  function beyond([[x0, y0], [x1, y1]]) {
    const length = Math.hypot(x1 - x0, y1 - y0) || 1;
    return [x1 + 12 * (x1 - x0) / length, y1 + 12 * (y1 - y0) / length + 4];
  }

  function outline(view, ellipse) {
    return Shapes.ellipse(view.project(ellipse.centre), ellipse.major * view.scale,
      ellipse.minor * view.scale, -ellipse.orientation);
  }

  function drawAll(view, records, chosen) {
    const items = records.filter((r) => r.ellipse).map((record) => ({
      d: outline(view, record.ellipse),
      class: `ellipse of-${record.of}${record === chosen ? ' is-chosen' : ''}`,
      key: `${record.of} ${record.name}`,
    }));
    const centres = records.filter((r) => r.ellipse).map((record) => ({
      d: Shapes.circle(view.project(record.ellipse.centre), record === chosen ? 3.5 : 2.2),
      class: `centre of-${record.of}`,
      key: `${record.of} ${record.name} centre`,
    }));
    return view.paths('ellipses', [...items, ...centres]);
  }

  // Semi-axes of the chosen ellipse, the antipolar line of its point, and the cross of principal
  // compliances there: arms in proportion to the compliances, the longer one a fixed share.
  function drawChosen(view, record) {
    const line = d3.line();
    const items = [];
    const texts = [];
    if (record.ellipse) {
      const { major, minor } = axesOf(view, record.ellipse);
      items.push({ d: line(major), class: 'semi-axis' }, { d: line(minor), class: 'semi-axis' });
      texts.push({ at: beyond(major), anchor: 'middle', text: 'a' },
        { at: beyond(minor), anchor: 'middle', text: 'b' });
    }
    if (record.antipolar) {
      const { point, direction } = record.antipolar;
      const far = 50 * Mechanism.extent;
      const ends = [-far, far].map((t) => view.project(
        [point[0] + t * direction[0], point[1] + t * direction[1]]));
      items.push({ d: line(ends), class: 'antipolar' });
    }
    const longest = 0.16 * Mechanism.extent;
    const [greater] = record.principal_compliances;
    record.principal_directions.forEach(([dx, dy], i) => {
      const arm = greater > 0 ? longest * record.principal_compliances[i] / greater : 0;
      const half = Math.max(arm, 5 / view.scale);
      const [x, y] = record.at;
      const ends = [-half, half].map((t) => view.project([x + t * dx, y + t * dy]));
      items.push({ d: line(ends), class: `compliance-arm arm-${i}` });
    });
    items.push({ d: Shapes.circle(view.project(record.at), 3.5), class: 'loaded-point' });
    view.paths('chosen', items);
    view.texts('chosen-names', texts);
  }

  function drawPoles(view, poles) {
    const known = poles.map((p, k) => ({ ...p, number: k + 1 })).filter((p) => p.pole)
      .map((p) => ({ ...p, at: view.project(p.pole) }));
    view.paths('poles', known.flatMap(({ at: [x, y] }) => [
      { d: Shapes.circle([x, y], 7), class: 'pole' },
      { d: `M${x - 11},${y}h22M${x},${y - 11}v22`, class: 'pole' },
    ]));
    view.texts('pole-names', known.map(({ at: [x, y], number }) => ({
      at: [x + 13, y + 17], text: `pole ${number}`,
    })));
  }

  return { drawAll, drawChosen, drawPoles };
})();
