'use strict';
// The results, and what the reader has chosen to look at. Everything on the page is drawn from
// these two; whoever changes a choice calls State.set, and listeners redraw.
const State = (() => {
  const data = JSON.parse(document.getElementById('data').textContent);
  const units = data.units;

  // Colours are slots of the style sheet, one per label and the same in every study. The
  // modelings that every reader meets keep their own.
  const ownSlots = {
    continuum: 0, exact: 1, scmbm: 2, prbm: 3, linear: 4, beam: 5,
    nonlinear: 0, periodic: 1, quasi_static: 2, midha: 3, transient: 4, // methods of a linkage
  };
  const slotCount = 9;
  const slots = new Map();
  const modelings = data.studies.flatMap((study) => (
    study.path || study.modes || study.motion || study.response
      || { modelings: study.linkage ? study.linkage.methods : [] }).modelings);
  for (const { label, modeling = label } of modelings) {
    if (slots.has(label)) continue;
    const taken = new Set(slots.values());
    let slot = modeling in ownSlots ? ownSlots[modeling] : 6;
    for (let tries = 0; taken.has(slot) && tries < slotCount; ++tries) {
      slot = slot < 6 ? 6 : (slot + 1) % slotCount;
    }
    slots.set(label, slot);
  }
  const colour = (label) => `var(--colour-${slots.get(label) || 0})`;

  const chosen = {
    study: null,
    position: 0, // along the path, the time or the angle: see the timelines
    hidden: new Set(), // labels
    subject: 0, // index into Motion.subjects of the study
    held: 0, // whose reactions are shown
    flexure: 0, // whose section forces are shown
    diagram: '', // key of the section force drawn on the mechanism: see SectionForces
    field: '', // key of the stress that colours the flexures: see StressFields
    record: 0, // of a linear study
    place: 0, // of a response
    exaggeration: 1, // of the deflections of a linkage
    traced: 'all', // whose ways through the turn are drawn: 'all', 'none' or an index
    angular: false, // frequencies of a linkage as rad per time
    modeCount: 3, // how many of its frequencies are shown
    fibre: 'upper', // whose stress a surface shows
    method: 0, // by which it is found
    groups: new Set(['flexure', 'point']), // of ellipses drawn
  };
  let listeners = [];

  function set(changes) {
    Object.assign(chosen, changes);
    const names = Object.keys(changes);
    for (const { of, listener } of listeners) {
      if (names.some((name) => of.includes(name))) listener();
    }
  }

  // Calls `listener` now and whenever one of the named choices changes, until the study is left.
  function follow(of, listener) {
    listeners.push({ of, listener });
    listener();
  }

  function forget() {
    listeners = [];
  }

  const toggled = (set_, item) => {
    const next = new Set(set_);
    if (!next.delete(item)) next.add(item);
    return next;
  };

  return { data, units, chosen, colour, set, follow, forget, toggled };
})();
