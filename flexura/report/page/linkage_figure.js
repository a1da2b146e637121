'use strict';
// The linkage at an angle of its drive: rigid and faint, and elastic by every method shown with its
// deflections exaggerated; the ways of points and bodies through the turn.
const LinkageFigure = (() => {
  const line = d3.line();

  // Where a body's parts are: ends of its flexures and points where those have gone, pins with the
  // body itself.
  function outlineOf(name, state, turn) {
    const ends = Motion.flexures.flatMap((flexure, f) => {
      const axis = state.flexures[f];
      if (flexure.base === name) return [axis[0]];
      return flexure.action === name ? [axis[axis.length - 1]] : [];
    });
    const points = turn.points.flatMap((point, p) => (
      point.startsWith(`${name}.`) ? [state.points[p]] : []));
    const pins = State.data.drawing.joints
      .filter(({ base, action, direction }) => action === name || (base === name && !direction))
      .map(({ at }) => carried(state, turn)(name).move(at));
    const b = turn.bodies.indexOf(name);
    const shaft = turn.shafts.includes(b) ? [state.bodies[b]] : [];
    const all = [...ends, ...points, ...pins, ...shaft];
    return all.length > 0 ? all : [state.bodies[b]];
  }

  function carried(state, turn) {
    return (name) => {
      const b = turn.bodies.indexOf(name);
      if (b < 0) return { move: Mechanism.still, rotation: 0 };
      const rotation = state.rotations[b];
      const move = Motion.carry(Motion.bodies.get(name), [...state.bodies[b], rotation], false);
      return { move, rotation };
    };
  }

  const displaced = (places, by, factor) => places.map(
    ([x, y], i) => [x + factor * by[i][0], y + factor * by[i][1]]);

  function elasticState(turn, method, rigid, factor) {
    const by = Turn.elasticAt(turn, method, State.chosen.position);
    return {
      flexures: rigid.flexures.map((axis, f) => displaced(axis, by.flexures[f], factor)),
      bodies: displaced(rigid.bodies, by.bodies, factor),
      points: displaced(rigid.points, by.points, factor),
      rotations: rigid.rotations,
    };
  }

  // A border goes with its chord: every point keeps its place along and across it.
  function borderOn(border, drawn, now) {
    const frame = (places) => {
      const [a, b] = [places[0], places[places.length - 1]];
      const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
      return { a, u: [(b[0] - a[0]) / length, (b[1] - a[1]) / length], length };
    };
    const [from, to] = [frame(drawn), frame(now)];
    return border.map((p) => {
      const [x, y] = [p[0] - from.a[0], p[1] - from.a[1]];
      const along = (x * from.u[0] + y * from.u[1]) / from.length;
      const across = from.u[0] * y - from.u[1] * x;
      const at = Math.max(0, Math.min(1, along)) * (now.length - 1);
      const k = Math.min(Math.floor(at), now.length - 2);
      const beyond = (along - at / (now.length - 1)) * to.length;
      return [0, 1].map((i) => now[k][i] + (at - k) * (now[k + 1][i] - now[k][i])
        + beyond * to.u[i] + across * (i === 0 ? -to.u[1] : to.u[0]));
    });
  }

  // What is drawn of flexures: the axes of strips, the borders of links of any shape.
  function drawnFlexures(turn, axes) {
    return axes.map((axis, f) => {
      const flexure = State.data.drawing.flexures[f];
      return flexure.depth > 0 ? axis
        : borderOn(d3.pairs(flexure.axis).filter((_, i) => i % 2 === 0),
          turn.positions[0].flexures[f], axis);
    });
  }

  function bodyItems(view, turn, state, look) {
    return turn.bodies.map((name) => Mechanism.bodyItem(
      view, { name, ends: outlineOf(name, state, turn), points: [] }, Mechanism.still, look));
  }

  function drawRigid(view, turn, rigid) {
    const look = { key: 'rigid' };
    view.paths('ghost-bodies', bodyItems(view, turn, rigid, look));
    view.paths('ghost-flexures', Mechanism.flexureItems(
      view, drawnFlexures(turn, rigid.flexures), look));
  }

  // Bodies that turn on the spot: their shaft is there.
  function shaftsOf({ bodies, positions }) {
    const near = 1e-6 * Mechanism.extent;
    const first = positions[0];
    const still = (b) => positions.every(({ bodies: at }) => Math.hypot(
      at[b][0] - first.bodies[b][0], at[b][1] - first.bodies[b][1]) < near);
    const turns = (b) => positions.some(
      ({ rotations }) => Math.abs(rotations[b] - first.rotations[b]) > 1e-3);
    return d3.range(bodies.length).filter((b) => still(b) && turns(b));
  }

  // Pins in the ground are drawn with it.
  function drawShafts(view, turn) {
    const isPin = ([x, y]) => State.data.drawing.joints.some(({ at, direction }) => (
      !direction && Math.hypot(at[0] - x, at[1] - y) < 1e-6 * Mechanism.extent));
    const places = turn.shafts.map((b) => turn.positions[0].bodies[b]);
    view.paths('ground shafts', places.filter((at) => !isPin(at)).flatMap((shaft) => {
      const place = view.project(shaft);
      const { line: edge, hatch } = Shapes.ground(place, -Math.PI / 2);
      return [{ d: edge, class: 'ground-line' }, { d: hatch, class: 'ground-hatch' },
        { d: Shapes.circle(place, 4), class: 'ground-pin' }];
    }));
  }

  function traced({ subjects }) {
    const { traced: choice } = State.chosen;
    if (choice === 'none') return [];
    return choice === 'all' ? subjects : [subjects[Number(choice)]];
  }

  function drawTraces(view, turn, states, factor) {
    const wayOf = ({ kind, i }, by) => turn.positions.map((position, k) => {
      const [x, y] = position[kind][i];
      return view.project(by ? [x + factor * by[kind][k][i][0], y + factor * by[kind][k][i][1]]
        : [x, y]);
    });
    const subjects = traced(turn);
    view.paths('rigid-ways', subjects.map((s) => ({ d: line(wayOf(s)), key: s.name })));
    view.paths('traces', states.flatMap(({ method, state, look }) => subjects.flatMap((s) => [
      {
        ...look,
        d: line(wayOf(s, method)),
        class: 'trace is-passed',
        key: `${look.key} ${s.name}`,
      },
      {
        ...look,
        d: Shapes.circle(view.project(state[s.kind][s.i]), 3),
        class: 'point',
        key: `${look.key} ${s.name} now`,
      },
    ])));
  }

  // Loads act on what the first method shows, or on rigid links where none moves.
  function drawLoads(view, loads, turn, state) {
    const angle = State.chosen.position * Math.PI / 180;
    const drawn = Figure.drawnLoads(
      view, loads, carried(state, turn), { load_factor: 1, time: angle });
    view.paths('loads', drawn.flatMap(({ items }) => items));
    view.texts('load-names', drawn.flatMap(({ texts }) => texts));
  }

  function draw(view, turn, loads) {
    const { position, exaggeration: factor } = State.chosen;
    const rigid = Turn.rigidAt(turn, position);
    Mechanism.drawGround(view);
    drawShafts(view, turn);
    drawRigid(view, turn, rigid);
    const methods = Turn.shown(turn).filter(Turn.moves);
    methods.sort((a, b) => Turn.isReference(turn, b) - Turn.isReference(turn, a));
    const states = methods.map((method) => {
      const { label } = method;
      const look = { key: label, modeling: label, colour: State.colour(label) };
      return { method, look, state: elasticState(turn, method, rigid, factor) };
    });
    const each = (itemsOf) => states.flatMap(({ state, look }) => itemsOf(state, look));
    view.paths('springs', each((state, look) => (
      Mechanism.springItems(view, carried(state, turn), look))));
    view.paths('bodies', each((state, look) => bodyItems(view, turn, state, look)));
    view.paths('flexures', each((state, look) => (
      Mechanism.flexureItems(view, drawnFlexures(turn, state.flexures), look))));
    view.paths('connections', each((state, look) => (
      Mechanism.connectionItems(view, carried(state, turn), look))));
    drawTraces(view, turn, states, factor);
    drawLoads(view, loads, turn, states.length > 0 ? states[0].state : rigid);
    const named = [...turn.points.map((name, p) => [name, rigid.points[p]]),
      ...(turn.points.length > 0 ? [] : turn.bodies.map((name, b) => [name, rigid.bodies[b]]))];
    view.texts('names', named.map(([text, place]) => {
      const [x, y] = view.project(place);
      return { at: [x + 9, y - 9], text };
    }));
  }

  // Everything that is passed through the turn, rigid and elastic.
  function boxOf(turn) {
    const places = turn.positions.flatMap((p) => [...p.flexures.flat(), ...p.bodies, ...p.points]);
    const [[ax, ay], [bx, by]] = Mechanism.undeformedBox;
    const [x0, x1] = d3.extent([...places.map((p) => p[0]), ax, bx]);
    const [y0, y1] = d3.extent([...places.map((p) => p[1]), ay, by]);
    return [[x0, y0], [x1, y1]];
  }

  function exaggerationSlider(host) {
    const fitting = State.chosen.exaggeration;
    const factors = d3.range(-3, 9).flatMap((e) => [1, 2, 5].map((k) => k * 10 ** e))
      .filter((f) => f > 0.999 * Math.min(1, fitting / 10))
      .filter((f) => f < 1.001 * Math.max(1, 20 * fitting));
    const label = d3.select(host).append('label').attr('class', 'chooser exaggeration');
    label.append('span').text('Deflections');
    const nearest = (value) => d3.scan(factors, (a, b) => (
      Math.abs(Math.log(a / value)) - Math.abs(Math.log(b / value))));
    const slider = label.append('input').attr('type', 'range').attr('id', 'exaggeration')
      .attr('min', 0).attr('max', factors.length - 1).attr('step', 1)
      .attr('aria-label', 'Exaggeration of the deflections')
      .property('value', nearest(fitting))
      .on('input', function changed() {
        State.set({ exaggeration: factors[Number(this.value)] });
      });
    const readout = label.append('output').attr('class', 'exaggeration-value');
    State.follow(['exaggeration'], () => {
      const text = `×${Numbers.short(State.chosen.exaggeration)}`;
      readout.text(text);
      slider.attr('aria-valuetext', text)
        .style('--share', `${100 * slider.property('value') / (factors.length - 1)}%`);
    });
  }

  function traceChooser(host, { subjects }) {
    const label = d3.select(host).append('label').attr('class', 'chooser');
    label.append('span').text('Traces');
    const options = [['all', 'all'], ...subjects.map(({ name }, i) => [String(i), name]),
      ['none', 'none']];
    label.append('select').attr('id', 'traced')
      .on('change', function changed() { State.set({ traced: this.value }); })
      .selectAll('option').data(options).enter().append('option')
      .attr('value', ([value]) => value).text(([, text]) => text);
  }

  function make(host, study, unpacked) {
    const turn = { ...unpacked, shafts: shaftsOf(unpacked) };
    Figure.legend(host, turn.methods);
    const bar = d3.select(host).append('div').attr('class', 'diagram-bar').node();
    const anyMoves = turn.methods.some(Turn.moves);
    if (anyMoves) exaggerationSlider(bar);
    traceChooser(bar, turn);
    const view = new View(host, boxOf(turn), `The linkage over its turn, in study ${study.name}`,
      (v) => draw(v, turn, study.loads));
    Transport.make(host, Turn.timeline(turn));
    d3.select(host).append('p').attr('class', 'hint').text(
      'Grey: as if the links were rigid. Flexures have their true depth, but are never thinner '
      + `than a hairline${anyMoves ? '; only their deflections are exaggerated' : ''}. `
      + 'Drag to pan, Ctrl and wheel to zoom.');
    State.follow(['position', 'hidden', 'exaggeration', 'traced'], () => view.redraw());
  }

  // Where there is no turn to show, the mechanism as drawn.
  function makeStill(host, study) {
    const view = new View(host, Mechanism.undeformedBox, `The linkage of study ${study.name}`,
      (v) => Mechanism.drawStill(v));
    view.redraw();
  }

  return { make, makeStill };
})();
