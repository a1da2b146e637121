'use strict';
// Where everything is between the states of a path.
const Motion = (() => {
  const drawing = State.data.drawing;

  const pairs = (flat) => d3.range(0, flat.length, 2).map((i) => [flat[i], flat[i + 1]]);
  const bodies = new Map(drawing.bodies.map((body) => [body.name, {
    name: body.name,
    fixed: body.fixed,
    centre: body.centre,
    ends: pairs(body.ends),
    points: pairs(body.points),
  }]));
  // Pins are a part of both bodies that they join, sliders of the one that slides.
  for (const { base, action, at, direction } of drawing.joints) {
    bodies.get(action).ends.push(at);
    if (!direction) bodies.get(base).ends.push(at);
  }
  const flexures = drawing.flexures.map((flexure) => ({ ...flexure, axis: pairs(flexure.axis) }));

  // The slider runs over the load factor where that grows along every path, and over the steps
  // of the path where it turns back.
  function timeline(path) {
    const all = path.modelings.filter((m) => m.states.length > 0);
    const grows = all.every((m) => m.states.every(
      (state, i) => i === 0 || state.load_factor > m.states[i - 1].load_factor));
    const positions = (m) => m.states.map((state, i) => (grows ? state.load_factor : i));
    const end = d3.max(all, (m) => d3.max(positions(m))) || 1;
    return { byLoad: grows, name: grows ? 'load factor' : 'step', end, positions };
  }

  // Weights by which a quadratic through up to three states gives its slope at state j.
  function slopeWeights(times, j) {
    const last = times.length - 1;
    const first = Math.max(0, Math.min(j - 1, last - 2));
    const nodes = d3.range(first, Math.min(first + 2, last) + 1);
    return nodes.map((k) => {
      const others = nodes.filter((i) => i !== k);
      const scale = others.reduce((product, i) => product * (times[k] - times[i]), 1);
      const slope = others.length === 1 ? 1 : d3.sum(others, (i) => times[j] - times[i]);
      return [k, slope / scale];
    });
  }

  // Weights of the states that give the cubic between states i and i + 1 at t in [0, 1]: smooth
  // motion through what the solver found.
  function cubicWeights(times, i, t) {
    const weights = new Map();
    const add = (k, weight) => weights.set(k, (weights.get(k) || 0) + weight);
    const step = times[i + 1] - times[i];
    add(i, (1 + 2 * t) * (1 - t) ** 2);
    add(i + 1, t * t * (3 - 2 * t));
    for (const [k, w] of slopeWeights(times, i)) add(k, w * step * t * (1 - t) ** 2);
    for (const [k, w] of slopeWeights(times, i + 1)) add(k, w * step * t * t * (t - 1));
    return [...weights];
  }

  function blend(states, weights, rowsOf) {
    return rowsOf(states[weights[0][0]]).map((row, r) => row.map(
      (_, c) => d3.sum(weights, ([k, weight]) => weight * rowsOf(states[k])[r][c])));
  }

  function between(states, times, i, t) {
    const weights = cubicWeights(times, i, t);
    const [a, b] = [states[i], states[i + 1]];
    // A drawn axis that changes its number of points cannot be blended.
    const comparable = weights.every(([k]) => states[k].axes.every(
      (axis, n) => axis.length === a.axes[n].length));
    return {
      load_factor: a.load_factor + t * (b.load_factor - a.load_factor),
      bodies: blend(states, weights, (state) => state.bodies),
      points: blend(states, weights, (state) => state.points),
      axes: comparable ? blend(states, weights, (state) => state.axes) : a.axes,
      reactions: weights.every(([k]) => states[k].reactions)
        ? blend(states, weights, (state) => state.reactions) : null,
      unstable: a.unstable || b.unstable,
    };
  }

  // The state of a modeling at a position of the timeline; its last one beyond its end.
  function stateAt(modeling, times, position) {
    const states = modeling.states;
    if (states.length === 0) return null;
    const next = Math.max(1, d3.bisectRight(times, position));
    let state = states[Math.min(next, states.length) - 1];
    if (next < states.length) {
      const t = (position - times[next - 1]) / (times[next] - times[next - 1]);
      if (t > 1e-9) state = between(states, times, next - 1, t);
    }
    const ended = position > times[times.length - 1] + 1e-9;
    return { ...state, axes: state.axes.map(pairs), ended };
  }

  // The way of point p up to a position, as finely as the eye wants it.
  function trace(modeling, times, p, position) {
    const states = modeling.states;
    const way = [];
    const pieces = 6;
    for (let i = 0; i < states.length && times[i] <= position; ++i) {
      way.push(states[i].points[p]);
      for (let k = 1; k < pieces && i + 1 < states.length; ++k) {
        const t = k / pieces;
        if (times[i] + t * (times[i + 1] - times[i]) > position) break;
        way.push(blend(states, cubicWeights(times, i, t), (state) => state.points)[p]);
      }
    }
    return way;
  }

  // Where a place drawn on a body has gone: rigidly, but to first order for `linear`.
  function carry(body, pose, small) {
    const [x, y, rotation] = pose;
    const c = small ? 1 : Math.cos(rotation);
    const s = small ? rotation : Math.sin(rotation);
    return ([px, py]) => {
      const dx = px - body.centre[0];
      const dy = py - body.centre[1];
      return [x + c * dx - s * dy, y + s * dx + c * dy];
    };
  }

  // What can be chosen to be plotted: every named point with the rotation of its body, then
  // every moving body at its centre, then the section in the middle of every flexure.
  function subjects(path) {
    const points = path.points.map((name, i) => ({
      name,
      kind: 'point',
      owner: path.owners[i],
      place: (state) => state.points[i],
    }));
    const centres = path.bodies.map((name, i) => ({
      name,
      kind: 'body',
      owner: i,
      place: (state) => state.bodies[i],
    }));
    const absent = [NaN, NaN, NaN]; // where long motions are thinned
    const mid = (state, i) => (state.mids ? state.mids[i] : absent);
    const mids = path.flexures.map((name, i) => ({
      name,
      kind: 'flexure',
      owner: null,
      place: (state) => mid(state, i),
      rotation: (state) => mid(state, i)[2],
    }));
    const turned = [...points, ...centres].map((subject) => ({
      ...subject,
      rotation: (state) => (subject.owner === null ? null : state.bodies[subject.owner][2]),
    }));
    return [...turned, ...mids];
  }

  // Where something held is: at its point, or at its body's centre.
  const heldPlace = (held, state) => (
    held.point === null ? state.bodies[held.body] : state.points[held.point]);

  return {
    bodies, flexures, pairs, timeline, stateAt, trace, carry, subjects, heldPlace,
  };
})();
