'use strict';
// Of a linkage: where excitation meets frequencies as the drive speeds up, the multipliers of
// Floquet that tell whether the motion is stable, and strains over speed.
const SpeedPlots = (() => {
  const { slotOf } = TurnPlots;
  const size = ([re, im]) => Math.hypot(re, im);
  const largest = ({ multipliers }) => d3.max(multipliers, size);
  const isUnstable = (state) => state.multipliers.length > 0 && largest(state) > 1;

  const speedTitle = `mean speed of the drive, ${Turn.speedUnit}`;
  const speedsOf = ({ speeds }) => speeds.map(
    (state) => ({ ...state, x: Turn.inTurns(state.speed) }));

  // Least and greatest frequency of every mode over the turn, in the unit chosen.
  function bandsOf(turn) {
    const rows = turn.followed.length > 0 ? turn.followed : turn.frequencies;
    return d3.range(State.chosen.modeCount).map((mode) => d3.extent(
      rows, (row) => row[mode] / TurnPlots.perCycle()));
  }

  // Multiples of the drive's own frequency, up to the highest frequency shown.
  function raysOf(end, high) {
    const once = end / Turn.inTurns(1) / TurnPlots.perCycle();
    const last = Math.min(30, Math.max(8, Math.ceil(high / once)));
    const step = last > 12 ? Math.ceil(last / 12) : 1;
    return d3.range(1, last + 1).filter((k) => k === 1 || k % step === 0).map((order) => {
      const top = Math.min(order * once, high);
      return { order, points: [{ x: 0, y: 0 }, { x: end * top / (order * once), y: top }] };
    });
  }

  function drawBands(group, chart, bands, rays) {
    const [left, right] = chart.x.range();
    const floor = chart.y(0);
    bands.forEach(([low, high], mode) => {
      if (high <= 0) return; // negative where a link has buckled
      const top = chart.y(high);
      group.append('rect').attr('class', 'band').style('--colour', slotOf(mode))
        .attr('x', left).attr('width', right - left).attr('y', top)
        .attr('height', Math.max(1.5, Math.min(floor, chart.y(low)) - top))
        .append('title').text(`mode ${mode + 1}: ${TurnPlots.writtenFrequency(low)} to ${
          TurnPlots.writtenFrequency(high)}`);
    });
    // Every order at the end of its ray: beside it on the right, above it at the top.
    let free = Infinity;
    for (const { order, points } of rays) {
      const [x, y] = [chart.x(points[1].x), chart.y(points[1].y)];
      const atTop = y < chart.y.range()[1] + 3;
      if (!atTop || free - x > 22) {
        group.append('text').attr('class', 'ray-name')
          .attr('text-anchor', atTop ? 'middle' : 'start')
          .attr('x', atTop ? x : x + 3).attr('y', atTop ? y - 4 : y + 4).text(`${order}×`);
        free = atTop ? x : Infinity;
      }
    }
  }

  const holdsOwn = ({ xRange: [from, to] }, turn) => {
    const own = Turn.inTurns(turn.speed);
    return own >= from && own <= to;
  };
  const markOwn = (chart, turn) => {
    if (holdsOwn(chart.options, turn)) chart.mark(Turn.inTurns(turn.speed));
  };
  const ownSentence = (chart, turn) => (
    holdsOwn(chart.options, turn) ? ' The upright line is the speed of the study.' : '');

  function makeCampbell(host, turn) {
    const speeds = speedsOf(turn);
    if (speeds.length < 2 || turn.frequencies.length === 0) return;
    const { section } = TurnPlots.panel(host, 'campbell', 'Frequencies against speed');
    const end = d3.max(speeds, ({ x }) => x);
    let bands = [];
    let rays = [];
    const options = {
      title: 'Frequency',
      xTitle: speedTitle,
      xRange: [0, end],
      format: TurnPlots.writtenFrequency,
      under: (group, chart) => drawBands(group, chart, bands, rays),
    };
    const chart = new Chart(TurnPlots.grid(section, 'one-chart'), options);
    Object.assign(chart.margin, { right: 30, top: 20 });
    const showNames = TurnPlots.key(section);
    State.follow(['modeCount', 'angular'], () => {
      showNames(TurnPlots.modeNames());
      bands = bandsOf(turn);
      const high = 1.08 * d3.max(bands, ([, top]) => top);
      options.yRange = [0, high];
      rays = raysOf(end, high);
      chart.show(rays.map(({ order, points }) => ({
        label: `${order}× the drive`, colour: 'var(--faint)', points,
      })), `Frequency, ${TurnPlots.frequencyUnit()}`);
    });
    markOwn(chart, turn);
    section.append('p').attr('class', 'hint').text('Bands: every mode from its least to its '
      + 'greatest frequency over the turn, at the speed of the study. Rays: 1×, 2×, .. the '
      + 'frequency of the drive; where a ray is inside a band the drive excites that mode '
      + `somewhere in the turn.${ownSentence(chart, turn)}`);
  }

  function circle() {
    return d3.range(0, 73).map((k) => {
      const a = k * Math.PI / 36;
      return { x: Math.cos(a), y: Math.sin(a) };
    });
  }

  function drawPlane(host, turn) {
    const reach = 1.12 * Math.max(1, d3.max(turn.multipliers, ([re, im]) => (
      Math.max(Math.abs(re), Math.abs(im)))));
    const plane = new Chart(host, {
      title: 'Imaginary part of the multipliers',
      xTitle: 'real part',
      free: true,
      equal: true,
      xRange: [-reach, reach],
      yRange: [-reach, reach],
      yTicks: reach < 2 ? [-1, 0, 1] : d3.ticks(-reach, reach, 4),
    });
    const group = (unstable, colour) => ({
      label: '',
      colour,
      points: [],
      marks: turn.multipliers.filter((m) => (size(m) > 1) === unstable).map((m) => ({
        x: m[0], y: m[1], title: `${complex(m)}, size ${Numbers.short(size(m))}`,
      })),
    });
    const groups = [group(false, slotOf(0)), group(true, 'var(--warning)')]
      .filter(({ marks }) => marks.length > 0);
    // A line without points is not drawn: the marks go with the circle.
    plane.show([{ label: 'unit circle', colour: 'var(--faint)', points: circle() },
      ...groups.map((g) => ({ ...g, points: g.marks.slice(0, 1) }))]);
  }

  // An imaginary part of rounding is none.
  const isReal = (m) => Math.abs(m[1]) <= 1e-9 * size(m);

  function complex([re, im]) {
    const imaginary = `${Numbers.format(Math.abs(im), 4)}i`;
    return isReal([re, im]) ? Numbers.format(re, 4)
      : `${Numbers.format(re, 4)} ${im < 0 ? '−' : '+'} ${imaginary}`;
  }

  // One row for a multiplier and its conjugate.
  function multiplierTable(host, turn) {
    const rows = turn.multipliers.filter(([, im]) => im >= 0).slice(0, 8);
    Tables.make(host, [
      {
        title: 'Multiplier',
        text: (m) => complex(m).replace(' + ', ' ± '),
      },
      { title: 'Size', text: (m) => Numbers.format(size(m), 4) },
      {
        title: 'Turn by turn',
        left: true,
        text: (m) => (size(m) > 1 ? 'grows' : 'decays'),
        class: (m) => (size(m) > 1 ? 'is-stopped' : 'faint'),
      },
    ], rows);
  }

  // Ranges of speed at which the motion is unstable or the linkage buckles.
  function drawRanges(group, chart, speeds, is) {
    const x = (i) => chart.x(speeds[Math.max(0, Math.min(i, speeds.length - 1))].x);
    speeds.forEach((state, i) => {
      if (!is(state)) return;
      const [from, to] = [0.5 * (x(i - 1) + x(i)), 0.5 * (x(i) + x(i + 1))];
      group.append('rect').attr('class', 'unstable-range').attr('x', from)
        .attr('y', chart.margin.top)
        .attr('width', Math.max(1.5, to - from))
        .attr('height', chart.height - chart.margin.top - chart.margin.bottom);
    });
  }

  function speedPoints(speeds, valueOf) {
    return speeds.map((state) => ({
      x: state.x,
      y: valueOf(state),
      unstable: isUnstable(state),
    }));
  }

  function speedChart(of, turn, speeds, title, more) {
    const bad = (state) => state.buckles || isUnstable(state);
    const chart = new Chart(of, {
      title,
      xTitle: speedTitle,
      xRange: d3.extent(speeds, ({ x }) => x),
      under: (group, c) => {
        drawRanges(group, c, speeds, bad);
        if (more) more(group, c);
      },
    });
    markOwn(chart, turn);
    return chart;
  }

  function verdict(turn) {
    if (turn.multipliers.length === 0) return '';
    const most = d3.max(turn.multipliers, size);
    const at = `${Numbers.short(Turn.inTurns(turn.speed))} ${Turn.speedUnit}`;
    return `At ${at} the largest multiplier is ${Numbers.short(most)}: the periodic motion is ${
      most < 1 ? 'stable' : 'unstable'}.`;
  }

  function sentenceOf(speeds) {
    const bad = speeds.filter(isUnstable);
    const buckled = speeds.filter((state) => state.buckles);
    const list = (states) => {
      const [from, to] = d3.extent(states, ({ x }) => Numbers.isNumber(x) && x);
      return from === to ? `at ${Numbers.short(from)}`
        : `between ${Numbers.short(from)} and ${Numbers.short(to)}`;
    };
    return [
      bad.length > 0 ? `${bad.length} of ${speeds.length} speeds are unstable, ${list(bad)} ${
        Turn.speedUnit}.` : `All ${speeds.length} speeds are stable.`,
      buckled.length > 0 ? `At ${buckled.length} a link would buckle at rest somewhere in the turn, ${
        list(buckled)} ${Turn.speedUnit}.` : '',
    ].filter((text) => text).join(' ');
  }

  function makeSpeedCharts(section, turn, speeds) {
    const of = TurnPlots.grid(section, 'charts-halves tall');
    const limit = (group, chart) => {
      const [left, right] = chart.x.range();
      group.append('line').attr('class', 'limit').attr('x1', left).attr('x2', right)
        .attr('y1', chart.y(1)).attr('y2', chart.y(1));
    };
    const stability = speedChart(of, turn, speeds, 'Largest size of a multiplier', limit);
    const sizes = speeds.filter(({ multipliers }) => multipliers.length > 0);
    stability.options.yRange = [0, 1.08 * Math.max(1, d3.max(sizes, largest) || 1)];
    stability.show([{
      label: 'largest size',
      colour: slotOf(0),
      points: speedPoints(speeds, (state) => largest(state)),
      marks: sizes.filter(isUnstable).map((state) => ({
        x: state.x,
        y: largest(state),
        title: `unstable at ${Numbers.short(state.x)} ${Turn.speedUnit}`,
      })),
    }]);
    const strain = speedChart(of, turn, speeds, 'Largest bending strain in the turn');
    strain.show(turn.flexures.map((name, f) => ({
      label: name,
      colour: slotOf(f),
      points: speedPoints(speeds, ({ peak_strain: peaks }) => (
        Numbers.isNumber(peaks[f]) ? Math.abs(peaks[f]) : null)),
    })));
    TurnPlots.key(section)(turn.flexures);
    section.append('p').attr('class', 'hint').text(`${sentenceOf(speeds)} Shaded and dashed: `
      + `unstable, or buckled in the turn.${ownSentence(strain, turn)}`);
  }

  function makeStability(host, turn) {
    const speeds = speedsOf(turn);
    if (turn.multipliers.length === 0 && speeds.length < 2) return;
    const { section } = TurnPlots.panel(host, 'stability', 'Stability of the periodic motion');
    if (turn.multipliers.length > 0) {
      section.append('p').attr('class', 'verdict').text(verdict(turn));
      const of = TurnPlots.grid(section, 'charts-halves tall');
      drawPlane(of, turn);
      multiplierTable(d3.select(of).append('div').attr('id', 'multipliers').node(), turn);
    }
    if (speeds.length > 1) makeSpeedCharts(section, turn, speeds);
    section.append('p').attr('class', 'hint').text('Multipliers of Floquet: by what a small '
      + 'disturbance is multiplied from one turn to the next. Outside the unit circle it grows.');
  }

  return { makeCampbell, makeStability };
})();
