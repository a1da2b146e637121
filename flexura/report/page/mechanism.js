'use strict';
// The mechanism as drawn items for a View: flexures as bands of their true depth, bodies, ground,
// points and loads.
const Mechanism = (() => {
  const { bodies, flexures } = Motion;
  const { joints } = State.data.drawing;
  const drawingBodies = State.data.drawing.bodies;
  const all = [...bodies.values()];
  const places = [
    ...flexures.flatMap((f) => f.axis), ...all.flatMap((b) => [...b.ends, ...b.points]),
    ...State.data.drawing.springs.filter((s) => !s.torsional)
      .flatMap((s) => [s.base_place, s.action_place])];
  const [x0, x1] = d3.extent(places, (p) => p[0]);
  const [y0, y1] = d3.extent(places, (p) => p[1]);
  const extent = Math.max(x1 - x0, y1 - y0) || 1;
  const undeformedBox = [[x0, y0], [x1, y1]];

  // Thick enough to be seen and to show that it is one piece; it never hides a flexure's end.
  const bodyRadius = 0.011 * extent;
  const thinnestFlexure = 1.5;

  const smooth = d3.line().curve(d3.curveCatmullRom);
  const straight = d3.line();

  // A section that varies: a strip of pieces, each as wide as the section is there. An axis may be
  // drawn through fewer points than depths are known at.
  function variedItems(view, axis, flexure, look) {
    const every = (flexure.depths.length - 1) / (axis.length - 1);
    const depth = (k) => flexure.depths[Math.round(k * every)];
    return axis.slice(1).map((p, k) => ({
      ...look,
      d: straight([view.project(axis[k]), view.project(p)]),
      width: Math.max(thinnestFlexure, 0.5 * (depth(k) + depth(k + 1)) * view.scale),
      key: `${look.key} ${flexure.name} ${k}`,
    }));
  }

  function flexureItems(view, axes, look) {
    return axes.flatMap((axis, i) => (flexures[i].depths && !look.chain ? variedItems(
      view, axis, flexures[i], look) : [{
      ...look,
      // without a depth it is the border of a mesh, which has corners
      d: (look.chain || flexures[i].depth === 0 ? straight : smooth)(
        axis.map((p) => view.project(p))),
      width: look.chain ? 1.6 : Math.max(thinnestFlexure, flexures[i].depth * view.scale),
      key: `${look.key} ${flexures[i].name}`,
    }]));
  }

  // The joints of a chain of rigid segments.
  function chainItems(view, axes, look) {
    return axes.flatMap((axis, i) => axis.slice(1, -1).map((p, j) => ({
      ...look, d: Shapes.circle(view.project(p), 3), key: `${look.key} ${i} ${j}`,
    })));
  }

  function bodyItem(view, body, carried, look) {
    const on = [...body.ends, ...body.points];
    const outline = (on.length ? on : [body.centre]).map((p) => view.project(carried(p)));
    return {
      ...look,
      d: Shapes.roundedHull(outline, Math.max(4, bodyRadius * view.scale)),
      key: `${look.key} ${body.name}`,
    };
  }

  // `carried(body name)` gives the motion of a body and its rotation.
  function springItems(view, carried, look) {
    return State.data.drawing.springs.map((spring) => {
      const base = carried(spring.base);
      const action = carried(spring.action);
      const end = view.project(action.move(spring.action_place));
      return {
        ...look,
        d: spring.torsional ? Shapes.spiral(end, base.rotation - action.rotation)
          : Shapes.coil(view.project(base.move(spring.base_place)), end),
        key: `${look.key} ${spring.name}`,
      };
    });
  }

  // Joints between bodies: a pin moves with its bodies, a slider with the one that slides, along
  // the direction that turns with the other.
  function connectionItems(view, carried, look) {
    return joints.map((joint) => {
      const place = view.project(carried(joint.action).move(joint.at));
      const item = { ...look, key: `${look.key} ${joint.name}` };
      if (!joint.direction) return { ...item, d: Shapes.circle(place, 4) };
      const [x, y] = joint.direction;
      const angle = Math.atan2(-y, x) - carried(joint.base).rotation;
      const { rails, hatch } = Shapes.slider(place, angle);
      return { ...item, d: bodies.get(joint.base).fixed ? rails + hatch : rails };
    });
  }

  const still = (p) => p;

  function drawGhost(view) {
    const look = { key: 'ghost' };
    const moving = all.filter((body) => !body.fixed);
    view.paths('ghost-bodies', moving.map((body) => bodyItem(view, body, still, look)));
    view.paths('ghost-flexures', flexureItems(view, flexures.map((f) => f.axis), look));
  }

  // The mechanism as drawn, where it is all there is to see.
  function drawStill(view) {
    drawGround(view);
    const look = { key: 'still' };
    view.paths('still-bodies', all.filter((body) => !body.fixed)
      .map((body) => bodyItem(view, body, still, look)));
    view.paths('still-flexures', flexureItems(view, flexures.map((f) => f.axis), look));
    view.paths('connections', connectionItems(view, () => ({ move: still, rotation: 0 }), look));
  }

  // Where the rest of a body is, seen from a joint on it; up, if there is no rest.
  function away({ at }, body) {
    const rest = [...body.ends, ...body.points].filter(
      (p) => Math.hypot(p[0] - at[0], p[1] - at[1]) > 1e-6 * extent);
    return rest.length > 0 ? [d3.mean(rest, (p) => p[0]), d3.mean(rest, (p) => p[1])]
      : [at[0], at[1] + extent];
  }

  // Where a flexure is fastened to a body: bodies list their ends in the order of the flexures.
  function endOn(flexure, name) {
    const own = flexures.filter((other) => other.base === name || other.action === name);
    return bodies.get(name).ends[own.findIndex((other) => other.name === flexure.name)];
  }

  // Ground under every flexure, spring end or pin that a fixed body holds; a circle where a flexure
  // may turn there. A link of any shape, drawn as a line without depth, goes straight from its end.
  function drawGround(view) {
    const held = flexures.flatMap((flexure) => {
      const { axis, base, action } = flexure;
      const strip = flexure.depth > 0;
      const [from, to] = strip ? [axis[0], axis[axis.length - 1]]
        : [endOn(flexure, base), endOn(flexure, action)];
      const ends = [];
      if (bodies.get(base).fixed) ends.push([from, strip ? axis[1] : to, flexure.pinned_base]);
      if (bodies.get(action).fixed) {
        ends.push([to, strip ? axis[axis.length - 2] : from, flexure.pinned_action]);
      }
      return ends;
    });
    for (const spring of State.data.drawing.springs.filter((s) => !s.torsional)) {
      const [a, b] = [spring.base_place, spring.action_place];
      if (bodies.get(spring.base).fixed) held.push([a, b, false]);
      if (bodies.get(spring.action).fixed) held.push([b, a, false]);
    }
    for (const joint of joints.filter((j) => !j.direction)) {
      const [base, action] = [bodies.get(joint.base), bodies.get(joint.action)];
      const moving = base.fixed ? action : base;
      if (base.fixed || action.fixed) held.push([joint.at, away(joint, moving), false]);
    }
    const symbols = held.map(([end, next, pinned]) => {
      const p = view.project(end);
      const q = view.project(next);
      const angle = Math.atan2(q[1] - p[1], q[0] - p[0]);
      return { ...Shapes.ground(p, angle), pin: pinned ? Shapes.circle(p, 4) : '' };
    });
    view.paths('ground', symbols.flatMap(({ line, hatch, pin }) => [
      { d: line, class: 'ground-line' }, { d: hatch, class: 'ground-hatch' },
      { d: pin, class: 'ground-pin' },
    ]));
  }

  // Where a load or a point named "body" or "body.point" is drawn, and on which body.
  function find(on) {
    for (const body of drawingBodies) {
      if (on === body.name) return { body: bodies.get(body.name), place: body.centre };
      const k = body.point_names.findIndex((point) => on === `${body.name}.${point}`);
      if (k >= 0) return { body: bodies.get(body.name), place: bodies.get(body.name).points[k] };
    }
    return null;
  }

  // Arrows for a force and an arc for a moment at `place`; `share` (0 to 1) scales the length. A text
  // as `label` stands at the tip in place of the size; false leaves both out.
  function loadItems(view, place, force, moment, share, label) {
    const p = view.project(place);
    const items = [];
    const texts = [];
    const size = Math.hypot(...force);
    if (size > 0) {
      const length = 16 + 46 * share;
      const angle = Math.atan2(-force[1], force[0]);
      // The arrow starts at its point, so that it never lies on the body it pulls.
      const tip = [p[0] + length * Math.cos(angle), p[1] + length * Math.sin(angle)];
      const { shaft, head } = Shapes.arrow(tip, angle, length);
      items.push({ d: shaft, class: 'load-shaft' }, { d: head, class: 'load-head' });
      // Beside the middle of the shaft, on its upper side.
      const across = Math.abs(Math.cos(angle)) > 0.5 ? 9 : 14;
      const side = Math.cos(angle) >= 0 ? 1 : -1;
      texts.push(typeof label === 'string' ? {
        at: [tip[0] + 9 * Math.cos(angle), tip[1] + 9 * Math.sin(angle) + 4],
        anchor: 'middle',
        text: label,
      } : {
        at: [p[0] + 0.6 * length * Math.cos(angle) + side * across * Math.sin(angle),
          p[1] + 0.6 * length * Math.sin(angle) - side * across * Math.cos(angle)],
        anchor: Math.abs(Math.cos(angle)) > 0.5 ? 'middle' : 'start',
        text: `${Numbers.short(size, 3)} ${State.units.force}`,
      });
    }
    if (moment !== 0) {
      const { shaft, head } = Shapes.momentArc(p, 20, moment > 0);
      items.push({ d: shaft, class: 'load-shaft' }, { d: head, class: 'load-head' });
      texts.push({
        at: [p[0], p[1] + 36],
        anchor: 'middle',
        text: typeof label === 'string' ? label
          : `${Numbers.short(Math.abs(moment), 3)} ${State.units.force}·${State.units.length}`,
      });
    }
    return { items, texts: label === false ? [] : texts };
  }

  return {
    extent, undeformedBox, flexureItems, chainItems, bodyItem, springItems, connectionItems,
    drawGhost, drawGround, drawStill, find, loadItems, still,
  };
})();
