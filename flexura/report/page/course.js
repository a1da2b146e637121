'use strict';
// The motions of a transient study, unpacked: the same shape as a path's modelings, with times in
// place of load factors, so that figures and plots serve both.
const Course = (() => {
  const { length, time } = State.units;

  // Numbers are embedded as whole multiples of a unit, from a start on; what is none stays none.
  const numbers = (series) => series.values.map(
    (v) => (v === null ? NaN : series.start + series.unit * v));
  // Rows at time i of things with several components each.
  const unpack = (things) => things.map((components) => components.map(numbers));
  const rowsAt = (things, i) => things.map((components) => components.map((c) => c[i]));

  function states({ fine, coarse }) {
    const bodies = unpack(fine.bodies);
    const points = unpack(fine.points);
    const reactions = unpack(fine.reactions);
    const list = fine.times.map((t, i) => ({
      time: t,
      load_factor: 1,
      bodies: rowsAt(bodies, i),
      points: rowsAt(points, i),
      axes: [],
      reactions: reactions.length > 0 ? rowsAt(reactions, i) : null,
      unstable: false,
    }));
    const mids = unpack(coarse.mids);
    const peaks = coarse.peaks ? coarse.peaks.map(numbers) : null;
    coarse.at.forEach((index, i) => {
      list[index].mids = rowsAt(mids, i);
      if (peaks) list[index].peaks = peaks.map((peak) => peak[i]);
    });
    return list;
  }

  // How far every point and then every body is from where the reference has it at the same time,
  // of the reference's largest displacement.
  function differences(modeling, reference) {
    if (modeling === reference || modeling.states.length === 0) return [];
    const count = modeling.states[0].points.length + modeling.states[0].bodies.length;
    const places = (state) => [...state.points, ...state.bodies];
    const between = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
    return d3.range(count).map((k) => {
      const at = (state) => places(state)[k];
      const scale = d3.max(reference.states, (s) => between(at(s), at(reference.states[0])));
      return modeling.states.map((state, i) => {
        const other = reference.states[i];
        const same = other && Math.abs(other.time - state.time) <= 1e-6 * Math.abs(state.time);
        return same && scale > 0 ? between(at(state), at(other)) / scale : null;
      });
    });
  }

  function unpackModeling(modeling) {
    const energies = {};
    for (const [key, series] of Object.entries(modeling.fine.energies)) {
      energies[key] = numbers(series);
    }
    const frames = modeling.frames.axes.map((axes, i) => ({
      index: modeling.frames.at[i], axes: axes.map(Motion.pairs),
    }));
    return {
      ...modeling,
      times: modeling.fine.times,
      states: states(modeling),
      energies,
      frames,
      events: [],
      reaction_events: [],
      stage: [],
      condensed: [],
    };
  }

  function unpackMotion(motion) {
    const modelings = motion.modelings.map(unpackModeling);
    for (const modeling of modelings) {
      modeling.differences = differences(modeling, modelings[motion.reference]);
    }
    return { ...motion, modelings, stage: '', condensed: [] };
  }

  // Where a place of a drawn frame is once its body has gone from one pose to another.
  function carried([x, y], from, to, small) {
    const turn = (rotation) => (small ? [1, rotation] : [Math.cos(rotation), Math.sin(rotation)]);
    const [c, s] = turn(from[2]);
    const [dx, dy] = [x - from[0], y - from[1]];
    const size = c * c + s * s;
    const [rx, ry] = [(c * dx + s * dy) / size, (c * dy - s * dx) / size];
    const [cc, ss] = turn(to[2]);
    return [to[0] + cc * rx - ss * ry, to[1] + ss * rx + cc * ry];
  }

  // A frame's axes at another time: every point goes with both end bodies, by its share of the way.
  function followed(motion, modeling, frame, state) {
    const small = modeling.modeling === 'linear';
    const poses = (name) => {
      const b = motion.bodies.indexOf(name);
      return b < 0 ? null : [modeling.states[frame.index].bodies[b], state.bodies[b]];
    };
    const move = (p, pair) => (pair ? carried(p, pair[0], pair[1], small) : p);
    return frame.axes.map((axis, f) => {
      const base = poses(Motion.flexures[f].base);
      const action = poses(Motion.flexures[f].action);
      return axis.map((p, k) => {
        const share = k / (axis.length - 1);
        const [a, b] = [move(p, base), move(p, action)];
        return [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])];
      });
    });
  }

  // The axes in a state at a time: those of a frame, or between two of them.
  function axesAt(motion, modeling, state, position) {
    const { frames, times } = modeling;
    const next = d3.bisector((frame) => times[frame.index]).right(frames, position);
    const a = frames[Math.max(0, next - 1)];
    const b = frames[Math.min(next, frames.length - 1)];
    if (a === b || position <= times[a.index]) return a.axes;
    const share = (position - times[a.index]) / (times[b.index] - times[a.index]);
    const from = followed(motion, modeling, a, state);
    const to = followed(motion, modeling, b, state);
    return from.map((axis, f) => (axis.length !== to[f].length ? axis : axis.map(
      ([x, y], k) => [x + share * (to[f][k][0] - x), y + share * (to[f][k][1] - y)])));
  }

  function stateAt(motion, modeling, position) {
    const state = Motion.stateAt(modeling, modeling.times, position);
    return state && { ...state, time: position, axes: axesAt(motion, modeling, state, position) };
  }

  // How fast it may be watched: in how many time units a second.
  const watchable = [[1 / 100, '100× slower'], [1 / 10, '10× slower'], [1 / 2, '2× slower'],
    [1, 'real time'], [2, '2× faster'], [10, '10× faster'], [100, '100× faster']];

  function timeline(motion) {
    const end = d3.max(motion.modelings, (m) => m.times[m.times.length - 1]) || 1;
    const second = { us: 1e6, ms: 1e3, s: 1, min: 1 / 60 }[time] || 1;
    const speeds = [{ label: 'all in 10 s', rate: end / 10 },
      ...watchable.map(([factor, label]) => ({ label, rate: factor * second }))];
    return {
      byLoad: true, name: 'time', unit: time, end, positions: (m) => m.times, speeds,
    };
  }

  const velocityUnit = `${length}/${time}`;

  return { unpackMotion, stateAt, timeline, velocityUnit };
})();
