'use strict';
// The mechanism as all chosen modelings have it in a state of a path or a motion: bodies, flexures,
// springs, joints, loads and reactions.
const Figure = (() => {
  // What the figure must show: all ways, but for the modelings that leave for somewhere far away,
  // as small displacements do at large rotations. Those are returned as `strays`. `placesOf` gives
  // all places of a modeling.
  function frameOf(path, placesOf) {
    const boxes = path.modelings.map((m) => {
      const places = placesOf(m);
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

  function legend(host, modelings) {
    const items = d3.select(host).append('div').attr('class', 'legend').selectAll('label')
      .data(modelings).enter().append('label')
      .style('--colour', (m) => State.colour(m.label));
    items.append('input').attr('type', 'checkbox').attr('data-toggle', (m) => m.label)
      .property('checked', (m) => !State.chosen.hidden.has(m.label))
      .on('change', (m) => State.set({ hidden: State.toggled(State.chosen.hidden, m.label) }));
    items.append('span').attr('class', 'swatch');
    items.append('span').text((m) => m.label);
  }

  // The reference first, so that what is compared with it lies above it. `stateOf` gives a
  // modeling's state at the position, null where it has none.
  function shownStates(path, timeline, stateOf) {
    const reference = path.modelings[path.reference];
    const order = [reference, ...path.modelings.filter((m) => m !== reference)];
    return order.filter((m) => !State.chosen.hidden.has(m.label)).map((modeling) => {
      const times = timeline.positions(modeling);
      return {
        modeling,
        state: stateOf(modeling, times, State.chosen.position),
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

  // How bodies move, by their names: where a place has gone, and the rotation.
  function carriedBy(names, poses, small) {
    return (name) => {
      const b = names.indexOf(name);
      if (b < 0) return { move: Mechanism.still, rotation: 0 };
      const pose = poses[b];
      return { move: Motion.carry(Motion.bodies.get(name), pose, small), rotation: pose[2] };
    };
  }

  function drawParts(view, path, shown) {
    const each = (itemsOf) => shown.flatMap(({ modeling, state }) => itemsOf(
      carriedBy(path.bodies, state.bodies, modeling.modeling === 'linear'),
      lookOf(modeling, state), state));
    view.paths('springs', each((carried, look) => Mechanism.springItems(view, carried, look)));
    view.paths('bodies', each((carried, look) => path.bodies.map((name) => (
      Mechanism.bodyItem(view, Motion.bodies.get(name), carried(name).move, look)))));
    view.paths('flexures', each((_, look, state) => (
      Mechanism.flexureItems(view, state.axes, look))));
    view.paths('connections', each((carried, look) => (
      Mechanism.connectionItems(view, carried, look))));
    view.paths('joints', each((_, look, state) => (
      look.chain ? Mechanism.chainItems(view, state.axes, look) : [])));
  }

  // Names stand where points are as drawn; below them where a load's size is in the way.
  function drawNames(view, path, loadTexts) {
    view.texts('names', path.points.filter((name) => Mechanism.find(name)).map((name) => {
      const [x, y] = view.project(Mechanism.find(name).place);
      const above = [x + 8, y - 9];
      const taken = loadTexts.some(({ at: [u, v] }) => (
        Math.abs(u - above[0] - 15) < 70 && Math.abs(v - above[1]) < 15));
      return { at: taken ? [x + 8, y + 20] : above, text: name };
    }));
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

  // The factor on a load in a state of a path, or at a time or an angle where it has a history.
  function factorOf({ constant, history }, { load_factor: grown, time }) {
    if (!history) return constant ? 1 : grown;
    const last = history.factors.length - 1;
    const place = Math.max(0, Math.min(1, time / history.end)) * last;
    const i = Math.min(Math.floor(place), last - 1);
    return history.factors[i] + (place - i) * (history.factors[i + 1] - history.factors[i]);
  }

  // The arrows of loads, and their sizes, on bodies carried to where they are in a state.
  function drawnLoads(view, loads, carried, state) {
    return loads.map((load) => {
      const factor = factorOf(load, state);
      const share = Math.abs(factor) / (load.history ? load.history.largest || 1 : 1);
      const on = Mechanism.find(load.on);
      if (!on || share < 1e-3) return { items: [], texts: [] };
      const { move, rotation } = carried(on.body.name);
      const turn = load.follower ? rotation : 0;
      const [fx, fy] = load.force.map((v) => v * factor);
      const force = [fx * Math.cos(turn) - fy * Math.sin(turn),
        fx * Math.sin(turn) + fy * Math.cos(turn)];
      return Mechanism.loadItems(view, move(on.place), force, load.moment * factor, share);
    });
  }

  // Loads and reactions act on what the reference shows, or else on the first modeling shown.
  // Returns the texts at the loads.
  function drawLoads(view, study, path, shown) {
    const items = [];
    const texts = [];
    const add = (drawn) => { items.push(...drawn.items); texts.push(...drawn.texts); };
    if (shown.length > 0) {
      const { modeling, state } = shown[0];
      const carried = carriedBy(path.bodies, state.bodies, modeling.modeling === 'linear');
      drawnLoads(view, study.loads, carried, state).forEach(add);
      if (state.reactions) drawReactions(view, path, modeling, state, add);
    }
    view.paths('loads', items);
    view.texts('load-names', texts);
    return texts;
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

  // `drawTraces()` draws the ways of the points. Returns what there is to say of the
  // diagram.
  function draw(view, study, path, shown, drawTraces) {
    Mechanism.drawGhost(view);
    Mechanism.drawGround(view);
    const diagram = Diagrams.draw(view, shown);
    drawParts(view, path, shown);
    drawTraces();
    const loadTexts = drawLoads(view, study, path, shown);
    drawFields(view, study.fields, shown);
    drawNames(view, path, loadTexts);
    Diagrams.drawPeaks(view, diagram);
    return diagram.caption;
  }

  return {
    frameOf, legend, shownStates, carriedBy, drawnLoads, draw,
  };
})();
