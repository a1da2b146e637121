'use strict';
// Play, pause and the slider along the path.
const Transport = (() => {
  const secondsForAll = 5;

  function make(host, timeline) {
    const bar = d3.select(host).append('div').attr('class', 'transport');
    const button = bar.append('button').attr('type', 'button').attr('id', 'play')
      .attr('class', 'play');
    const { name } = timeline;
    const slider = bar.append('input').attr('type', 'range').attr('id', 'load-slider')
      .attr('min', 0).attr('max', timeline.end).attr('step', timeline.end / 1000)
      .attr('aria-label', name);
    const readout = bar.append('output').attr('for', 'load-slider').attr('class', 'readout');
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
      const from = State.chosen.position >= timeline.end ? 0 : State.chosen.position;
      timer = d3.timer((elapsed) => {
        const position = from + timeline.end * elapsed / (1000 * secondsForAll);
        if (position >= timeline.end || !slider.node().isConnected) pause();
        State.set({ position: Math.min(position, timeline.end) });
      });
      show();
    }

    button.on('click', () => (timer ? pause() : play()));
    slider.on('input', () => {
      pause();
      State.set({ position: Number(slider.property('value')) });
    });
    State.follow(['position'], () => {
      const position = State.chosen.position;
      const text = timeline.byLoad ? position.toFixed(3) : position.toFixed(1);
      slider.property('value', position).attr('aria-valuetext', `${name} ${text}`)
        .style('--share', `${100 * position / timeline.end}%`);
      readout.html('').append('span').attr('class', 'readout-name').text(name);
      readout.append('span').attr('class', 'readout-value').text(text);
    });
    show();
  }

  return { make };
})();
