'use strict';
// A linkage through the turn of its drive: where everything is between the angles that were solved,
// rigid and elastic, and how angles and speeds are written.
const Turn = (() => {
  const { time } = State.units;
  const degrees = (radians) => Math.abs(radians) * 180 / Math.PI;
  const inDegrees = (angle) => `${Numbers.short(angle)}°`;

  // Revolutions a minute where time is in seconds, and turns per time unit elsewhere.
  const perTurn = time === 's' ? 30 / Math.PI : 0.5 / Math.PI;
  const speedUnit = time === 's' ? 'rpm' : `turns/${time}`;
  const inTurns = (speed) => Math.abs(speed) * perTurn;

  const pairRows = (rows) => rows.map(Motion.pairs);

  // A method that stopped early has no motion, or less of it than there are positions.
  function unpackMethod(method, count) {
    const full = (rows) => (rows.length === count ? rows : []);
    return {
      ...method,
      displacements: full(method.displacements).map(pairRows),
      bodies: pairRows(full(method.bodies)),
      points: pairRows(full(method.points)),
    };
  }

  function unpack(linkage) {
    const positions = linkage.positions.map((position) => ({
      ...position,
      flexures: pairRows(position.flexures),
      bodies: Motion.pairs(position.bodies),
      points: Motion.pairs(position.points),
    }));
    // Angles come with seven digits; those of quarter turns are to be what they are.
    const angles = positions.map(({ angle }) => Number(degrees(angle).toFixed(4)));
    const last = angles.length - 1;
    if (Math.abs(angles[last] - 360) < 1e-3) angles[last] = 360;
    const end = last > 0 ? angles[last] : 360;
    const subject = (kind) => (name, i) => ({ name, kind, i });
    return {
      ...linkage,
      positions,
      angles,
      end,
      closed: end === 360 && last > 0,
      methods: linkage.methods.map((method) => unpackMethod(method, positions.length)),
      subjects: [
        ...linkage.points.map(subject('points')), ...linkage.bodies.map(subject('bodies'))],
    };
  }

  const shown = (turn) => turn.methods.filter((m) => !State.chosen.hidden.has(m.label));
  const isReference = (turn, m) => m === turn.methods[turn.reference];

  // Weights of the positions about an angle: a cubic through four, so that a crank keeps its length
  // between few of them.
  function weightsAt({ angles, closed }, angle) {
    const last = angles.length - 1;
    if (last < 1) return [[0, 1]];
    const i = Math.min(Math.max(0, d3.bisectRight(angles, angle) - 1), last - 1);
    const t = (angle - angles[i]) / (angles[i + 1] - angles[i]);
    const wrapped = (k) => ((k + last) % last);
    if (last < 4 || (!closed && (i === 0 || i === last - 1))) return [[i, 1 - t], [i + 1, t]];
    const [before, after] = closed ? [wrapped(i - 1), wrapped(i + 2)] : [i - 1, i + 2];
    return [
      [before, -t * (t - 1) * (t - 2) / 6], [i, (t + 1) * (t - 1) * (t - 2) / 2],
      [i + 1, -(t + 1) * t * (t - 2) / 2], [after, (t + 1) * t * (t - 1) / 6]];
  }

  function blendPlaces(weights, placesOf) {
    return placesOf(weights[0][0]).map((_, p) => [0, 1].map(
      (c) => d3.sum(weights, ([k, weight]) => weight * placesOf(k)[p][c])));
  }

  function blendAxes(weights, axesOf) {
    return axesOf(weights[0][0]).map((_, f) => blendPlaces(weights, (k) => axesOf(k)[f]));
  }

  function rigidAt(turn, angle) {
    const weights = weightsAt(turn, angle);
    const { positions } = turn;
    // A body's rotation goes on through the turn: nothing is blended across the end.
    const i = Math.min(Math.max(0, d3.bisectRight(turn.angles, angle) - 1), positions.length - 1);
    const next = Math.min(i + 1, positions.length - 1);
    const span = turn.angles[next] - turn.angles[i];
    const t = span > 0 ? (angle - turn.angles[i]) / span : 0;
    const rotation = (b) => {
      const change = positions[next].rotations[b] - positions[i].rotations[b];
      const whole = 2 * Math.PI * Math.round(change / (2 * Math.PI));
      return positions[i].rotations[b] + t * (change - whole);
    };
    return {
      flexures: blendAxes(weights, (k) => positions[k].flexures),
      bodies: blendPlaces(weights, (k) => positions[k].bodies),
      points: blendPlaces(weights, (k) => positions[k].points),
      rotations: turn.bodies.map((_, b) => rotation(b)),
    };
  }

  const moves = (method) => method.displacements.length > 0;

  // Displacements from the rigid position, those of a method that stopped being none.
  function elasticAt(turn, method, angle) {
    const weights = weightsAt(turn, angle);
    return {
      flexures: blendAxes(weights, (k) => method.displacements[k]),
      bodies: blendPlaces(weights, (k) => method.bodies[k]),
      points: blendPlaces(weights, (k) => method.points[k]),
    };
  }

  function largestDeflection(method) {
    return d3.max(method.displacements, (axes) => d3.max(
      axes, (axis) => d3.max(axis, ([x, y]) => Math.hypot(x, y)))) || 0;
  }

  // 1, 2 or 5 times a power of ten, with which the largest deflection is about 5 % of the whole.
  function fittingExaggeration(turn) {
    const reference = turn.methods[turn.reference];
    const largest = (reference && largestDeflection(reference))
      || d3.max(turn.methods, largestDeflection) || 0;
    if (!(largest > 0)) return 1;
    const aim = 0.05 * Mechanism.extent / largest;
    const power = 10 ** Math.floor(Math.log10(aim));
    return power * [5, 2, 1].find((step) => step * power <= 1.0001 * aim);
  }

  const timeline = ({ end, closed }) => ({
    byLoad: true,
    name: 'crank angle',
    unit: '°',
    end,
    cyclic: closed,
    speeds: [['in 6 s', 6], ['in 2 s', 2], ['in 15 s', 15], ['in 60 s', 60]].map(
      ([label, seconds]) => ({ label: `a turn ${label}`, rate: end / seconds })),
  });

  // What charts over the turn have in common.
  function chartOptions({ end }) {
    const step = end > 180 ? 90 : 45;
    return {
      xTitle: 'crank angle, degrees',
      xRange: [0, end],
      xTicks: d3.range(0, end + 1e-6, step),
      onSeek: (position) => State.set({ position }),
    };
  }

  // One line per method shown; `valuesOf(method)` gives a value per position, or nothing.
  function lines(turn, valuesOf) {
    return shown(turn).map((m) => ({
      label: m.label,
      colour: State.colour(m.label),
      points: (valuesOf(m) || []).map((y, i) => ({ x: turn.angles[i], y })),
      isReference: isReference(turn, m),
    }));
  }

  function followMarks(charts) {
    State.follow(['position'], () => charts.forEach((chart) => chart.mark(State.chosen.position)));
  }

  return {
    unpack, shown, isReference, rigidAt, elasticAt, moves, fittingExaggeration, timeline,
    chartOptions, lines, followMarks, degrees, inDegrees, inTurns, speedUnit,
  };
})();
