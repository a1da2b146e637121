'use strict';
// Play, pause and the slider along a path or through the time of a motion.
const Transport = (() => {
  const secondsForAll = 5;

  // A thousandth of the whole shows.
  function written({ byLoad, unit, end }, position) {
    if (!unit) return position.toFixed(byLoad ? 3 : 1);
    const decimals = 3 - Math.floor(Math.log10(end));
    return decimals > 9 ? Numbers.format(position) : position.toFixed(Math.max(0, decimals));
  }

  function speedChooser(bar, { speeds }) {
    const select = bar.append('select').attr('id', 'speed').attr('aria-label', 'Speed');
    select.selectAll('option').data(speeds).enter().append('option').attr('value', (_, i) => i)
      .text((speed) => speed.label);
    return () => speeds[Number(select.property('value'))].rate;
  }

  // timeline: name, end, byLoad; of a motion also unit and speeds: [{label, rate}], the first one
  // to begin with, rates in time units a second. A `cyclic` one begins again at its end.
  function make(host, timeline) {
    const bar = d3.select(host).append('div').attr('class', 'transport');
    const button = bar.append('button').attr('type', 'button').attr('id', 'play')
      .attr('class', 'play');
    const {
      name, end, unit, cyclic,
    } = timeline;
    const slider = bar.append('input').attr('type', 'range').attr('id', 'load-slider')
      .attr('min', 0).attr('max', end).attr('step', end / 1000).attr('aria-label', name);
    const readout = bar.append('output').attr('for', 'load-slider').attr('class', 'readout');
    const rate = timeline.speeds ? speedChooser(bar, timeline) : () => end / secondsForAll;
    let timer = null;

    function show() {
      const playing = timer !== null;
      button.classed('is-playing', playing).attr('aria-label', playing ? 'Pause' : 'Play')
        .attr('title', playing ? 'Pause' : 'Play');
    }

    function pause() {
      if (timer) timer.stop();
      timer = null;
      show();
    }

    function play() {
      if (State.chosen.position >= end) State.set({ position: 0 });
      let before = 0;
      timer = d3.timer((elapsed) => {
        if (!slider.node().isConnected) {
          pause();
          return;
        }
        const position = State.chosen.position + rate() * (elapsed - before) / 1000;
        before = elapsed;
        if (position >= end && !cyclic) pause();
        State.set({ position: cyclic ? position % end : Math.min(position, end) });
      });
      show();
    }

    button.on('click', () => (timer ? pause() : play()));
    slider.on('input', () => {
      pause();
      State.set({ position: Number(slider.property('value')) });
    });
    State.follow(['position'], () => {
      const { position } = State.chosen;
      const text = written(timeline, position);
      slider.property('value', position).style('--share', `${100 * position / end}%`)
        .attr('aria-valuetext', [name, text, unit].filter((word) => word).join(' '));
      readout.html('').append('span').attr('class', 'readout-name').text(name);
      readout.append('span').attr('class', 'readout-value').text(text);
      if (unit) readout.append('span').attr('class', 'readout-name').text(unit);
    });
    show();
  }

  return { make };
})();
