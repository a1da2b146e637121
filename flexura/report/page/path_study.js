'use strict';
// A study of kind path or inverse: figure, slider, plots and tables.
const PathStudy = (() => {
  // What the figure must show: every path, but for the modelings that leave for somewhere far
  // away, as small displacements do at large rotations. Those are returned as `strays`.
  function frameOf(path) {
    const boxes = path.modelings.map((m) => {
      const places = m.states.flatMap((s) => [...s.points, ...s.axes.flatMap(Motion.pairs)]);
      return d3.extent(places, (p) => p[0]).concat(d3.extent(places, (p) => p[1]));
    });
    const [[ax, ay], [bx, by]] = Mechanism.undeformedBox;
    const join = (box, [x0, x1, y0, y1]) => (x0 === undefined ? box : [
      Math.min(box[0], x0), Math.max(box[1], x1), Math.min(box[2], y0), Math.max(box[3], y1)]);
    const core = join([ax, bx, ay, by], boxes[path.reference]);
    const size = 0.6 * Math.max(core[1] - core[0], core[3] - core[2]);
    const near = ([left, right, bottom, top]) => left === undefined || (left > core[0] - size
      && right < core[1] + size && bottom > core[2] - size && top < core[3] + size);
    const [x0, x1, y0, y1] = boxes.filter(near).reduce(join, core);
    const strays = path.modelings.filter((_, i) => !near(boxes[i])).map((m) => m.label);
    return { box: [[x0, y0], [x1, y1]], strays };
  }

  function legend(host, path) {
    const items = d3.select(host).append('div').attr('class', 'legend').selectAll('label')
      .data(path.modelings).enter().append('label')
      .style('--colour', (m) => State.colour(m.label));
    items.append('input').attr('type', 'checkbox').attr('data-toggle', (m) => m.label)
      .property('checked', (m) => !State.chosen.hidden.has(m.label))
      .on('change', (m) => State.set({ hidden: State.toggled(State.chosen.hidden, m.label) }));
    items.append('span').attr('class', 'swatch');
    items.append('span').text((m) => m.label);
  }

  // The reference first, so that what is compared with it lies above it.
  function shownStates(path, timeline) {
    const reference = path.modelings[path.reference];
    const order = [reference, ...path.modelings.filter((m) => m !== reference)];
    return order.filter((m) => !State.chosen.hidden.has(m.label)).map((modeling) => {
      const times = timeline.positions(modeling);
      return {
        modeling,
        state: Motion.stateAt(modeling, times, State.chosen.position),
        isLast: State.chosen.position >= times[times.length - 1] - 1e-9,
      };
    }).filter(({ state }) => state !== null);
  }

  function lookOf(modeling, state) {
    const classes = [state.unstable ? 'is-unstable' : '', state.ended ? 'is-ended' : ''];
    return {
      key: modeling.label,
      modeling: modeling.label,
      colour: State.colour(modeling.label),
      class: classes.join(' ').trim(),
      chain: modeling.modeling === 'prbm',
    };
  }

  function drawBodies(view, path, shown) {
    const items = shown.flatMap(({ modeling, state }) => path.bodies.map((name, b) => {
      const body = Motion.bodies.get(name);
      const carried = Motion.carry(body, state.bodies[b], modeling.modeling === 'linear');
      return Mechanism.bodyItem(view, body, carried, lookOf(modeling, state));
    }));
    view.paths('bodies', items);
  }

  function drawSprings(view, path, shown) {
    view.paths('springs', shown.flatMap(({ modeling, state }) => {
      const carried = (name) => {
        const b = path.bodies.indexOf(name);
        if (b < 0) return { move: Mechanism.still, rotation: 0 };
        const body = Motion.bodies.get(name);
        return {
          move: Motion.carry(body, state.bodies[b], modeling.modeling === 'linear'),
          rotation: state.bodies[b][2],
        };
      };
      return Mechanism.springItems(view, carried, lookOf(modeling, state));
    }));
  }

  // The whole path of every point, faint, and what is behind the slider, firm.
  function drawTraces(view, path, shown, timeline) {
    const line = d3.line();
    const items = shown.flatMap(({ modeling, state }) => path.points.map((name, p) => {
      const times = timeline.positions(modeling);
      const look = { modeling: modeling.label, colour: State.colour(modeling.label) };
      const way = (until) => Motion.trace(modeling, times, p, until).map((q) => view.project(q));
      const all = way(Infinity);
      const until = [...way(State.chosen.position), view.project(state.points[p])];
      return [
        { ...look, d: line(all), class: 'trace', key: `${modeling.label} ${name} all` },
        { ...look, d: line(until), class: 'trace is-passed', key: `${modeling.label} ${name}` },
        {
          ...look,
          d: Shapes.circle(view.project(state.points[p]), 3.5),
          class: 'point',
          key: `${modeling.label} ${name} now`,
        },
      ];
    }).flat());
    view.paths('traces', items);
  }

  function drawNames(view, path) {
    view.texts('names', path.points.filter((name) => Mechanism.find(name)).map((name) => {
      const [x, y] = view.project(Mechanism.find(name).place);
      return { at: [x + 8, y - 9], text: name };
    }));
  }

  // Loads and reactions act on what the reference shows, or else on the first modeling shown.
  function drawLoads(view, study, shown) {
    const items = [];
    const texts = [];
    const add = (drawn) => { items.push(...drawn.items); texts.push(...drawn.texts); };
    if (shown.length > 0) {
      const { modeling, state } = shown[0];
      for (const load of study.loads) {
        const factor = load.constant ? 1 : state.load_factor;
        const share = Math.abs(factor);
        const on = Mechanism.find(load.on);
        if (!on || share < 1e-3) continue;
        const b = study.path.bodies.indexOf(on.body.name);
        const pose = b >= 0 ? state.bodies[b] : [...on.body.centre, 0];
        const place = Motion.carry(on.body, pose, modeling.modeling === 'linear')(on.place);
        const turn = load.follower ? pose[2] : 0;
        const [fx, fy] = load.force.map((v) => v * factor);
        const force = [fx * Math.cos(turn) - fy * Math.sin(turn),
          fx * Math.sin(turn) + fy * Math.cos(turn)];
        add(Mechanism.loadItems(view, place, force, load.moment * factor, share));
      }
      if (state.reactions) drawReactions(view, study.path, modeling, state, add);
    }
    view.paths('loads', items);
    view.texts('load-names', texts);
  }

  // A row of arrows along every flexure that carries a distributed load, and one for gravity.
  function drawFields(view, fields, shown) {
    const items = [];
    const texts = [];
    if (shown.length > 0) {
      const { state } = shown[0];
      const share = fields.constant ? 1 : Math.abs(state.load_factor);
      const sign = fields.constant || state.load_factor >= 0 ? 1 : -1;
      const arrow = (tip, [x, y], length) => {
        const angle = Math.atan2(-sign * y, sign * x);
        const { shaft, head } = Shapes.arrow(tip, angle, length);
        items.push({ d: shaft, class: 'load-shaft' }, { d: head, class: 'load-head' });
      };
      for (const { flexure, per_length: q } of share < 1e-3 ? [] : fields.spread) {
        const axis = state.axes[flexure];
        const step = Math.max(1, Math.floor((axis.length - 1) / 8));
        for (let k = 0; k < axis.length; k += step) {
          arrow(view.project(axis[k]), q, 8 + 12 * share);
        }
      }
      if (Math.hypot(...fields.gravity) > 0 && share >= 1e-3) {
        arrow([26, 24 + 22], fields.gravity, 14 + 20 * share);
        texts.push({ at: [40, 34], anchor: 'start', text: 'gravity' });
      }
    }
    view.paths('fields', items);
    view.texts('field-names', texts);
  }

  function drawReactions(view, path, modeling, state, add) {
    const sizes = modeling.states.flatMap((s) => s.reactions || [])
      .map(([x, y]) => Math.hypot(x, y));
    const largest = d3.max(sizes) || 1;
    state.reactions.forEach(([x, y, moment], h) => {
      const share = Math.hypot(x, y) / largest;
      if (state.load_factor < 1e-3) return;
      const place = Motion.heldPlace(path.held[h], state);
      add(Mechanism.loadItems(view, place, [x, y], moment, share, false));
    });
  }

  // Returns what there is to say of the diagram.
  function drawFigure(view, study, timeline) {
    const shown = shownStates(study.path, timeline);
    Mechanism.drawGhost(view);
    Mechanism.drawGround(view);
    const diagram = Diagrams.draw(view, shown);
    drawSprings(view, study.path, shown);
    drawBodies(view, study.path, shown);
    view.paths('flexures', shown.flatMap(({ modeling, state }) => (
      Mechanism.flexureItems(view, state.axes, lookOf(modeling, state)))));
    view.paths('joints', shown.filter(({ modeling }) => modeling.modeling === 'prbm')
      .flatMap(({ modeling, state }) => (
        Mechanism.jointItems(view, state.axes, lookOf(modeling, state)))));
    drawTraces(view, study.path, shown, timeline);
    drawLoads(view, study, shown);
    drawFields(view, study.fields, shown);
    drawNames(view, study.path);
    Diagrams.drawPeaks(view, diagram);
    return diagram.caption;
  }

  function hintFor(path, strays) {
    const sentences = ['Grey: undeformed. Drawn to scale; flexures have their true depth, but are '
      + 'never thinner than a hairline.'];
    if (path.modelings.some((m) => m.states.some((state) => state.unstable))) {
      sentences.push('Dashed: unstable.');
    }
    if (path.modelings.some((m) => !m.converged)) {
      sentences.push('Pale: the last state of a modeling that stopped before.');
    }
    if (strays.length > 0) {
      sentences.push(`Out of this view in the end: ${strays.join(', ')}; zoom out to follow.`);
    }
    return `${sentences.join(' ')} Drag to pan, Ctrl and wheel to zoom.`;
  }

  function make(host, study) {
    const path = study.path;
    const timeline = Motion.timeline(path);
    if (study.kind === 'inverse') timeline.name = 'share prescribed';
    const subjects = Motion.subjects(path);
    State.set({ position: timeline.end, subject: 0, flexure: 0 });
    const stage = d3.select(host).append('div').attr('class', 'stage');
    const left = stage.append('section').attr('class', 'panel mechanism').node();
    legend(left, path);
    const caption = Diagrams.chooser(left);
    const label = `The mechanism, undeformed and deformed, in study ${study.name}`;
    const { box, strays } = frameOf(path);
    const view = new View(left, box, label, (v) => {
      caption.text(drawFigure(v, study, timeline));
    });
    Transport.make(left, timeline);
    d3.select(left).append('p').attr('class', 'hint').text(hintFor(path, strays));
    const right = stage.append('section').attr('class', 'panel plots').node();
    PathPlots.make(right, study, subjects, timeline);
    if (path.held.length > 0) ReactionPlots.make(host, study, timeline);
    StagePlots.make(host, study, timeline);
    State.follow(['position', 'hidden'], () => view.redraw());
    // Section forces are those of the last state, so that is where the reader is taken.
    State.follow(['diagram'], () => {
      if (State.chosen.diagram) State.set({ position: timeline.end });
      else view.redraw();
    });
    const comparison = d3.select(host).append('section').attr('class', 'panel');
    comparison.append('h2').text('Comparison');
    const table = comparison.append('div').attr('id', 'comparison').node();
    State.follow(['subject'], () => {
      table.textContent = '';
      Tables.comparison(table, path, subjects);
    });
    MemberPlots.make(host, study, timeline);
  }

  return { make };
})();
