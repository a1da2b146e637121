'use strict';
// The comparison of a study's modelings: what each costs and how far each is off.
const Tables = (() => {
  const { length } = State.units;

  // columns: [{title, unit, text, left}]; one row per item. Returns the row selection.
  function make(host, columns, items) {
    const table = d3.select(host).append('div').attr('class', 'table-frame').append('table');
    const head = table.append('thead').append('tr').selectAll('th').data(columns).enter()
      .append('th').attr('scope', 'col').classed('is-left', (c) => c.left);
    head.append('span').text((c) => c.title);
    head.filter((c) => c.unit).append('span').attr('class', 'unit').text((c) => c.unit);
    const rows = table.append('tbody').selectAll('tr').data(items).enter().append('tr');
    rows.selectAll('td').data((item) => columns.map((c) => ({ ...c, item }))).enter()
      .append('td').classed('is-left', (c) => c.left)
      .attr('class', function classes(c) {
        return [this.className, c.class ? c.class(c.item) : ''].join(' ').trim() || null;
      })
      .text((c) => (c.text ? c.text(c.item) : ''))
      .each(function fill(c) { if (c.fill) c.fill(d3.select(this), c.item); });
    return rows;
  }

  function last(modeling) {
    return modeling.states[modeling.states.length - 1];
  }

  function lastPlace(subject, modeling, axis) {
    return modeling.states.length ? Numbers.format(subject.place(last(modeling))[axis], 6) : '–';
  }

  function statusText(modeling) {
    if (modeling.converged) return 'converged';
    const state = last(modeling);
    return state ? `stopped at ${Numbers.short(state.load_factor)}` : 'stopped';
  }

  // A stop's reason and the events on the way, in words under the row they belong to.
  function addNotes(row, modeling, columnCount) {
    const notes = (modeling.events || []).map((event) => ({
      kind: 'event', text: `${event.kind} at load factor ${Numbers.short(event.load_factor)}`,
    }));
    if (!modeling.converged) {
      notes.push({ kind: 'stop', text: modeling.reason || 'It stopped and gave no reason.' });
    } else if (modeling.reason) {
      notes.push({ kind: 'remark', text: modeling.reason });
    }
    if (modeling.remark) notes.push({ kind: 'remark', text: modeling.remark });
    if (notes.length === 0) return;
    const cell = d3.create('tr').attr('class', 'notes')
      .style('--colour', State.colour(modeling.label));
    cell.append('td').attr('colspan', columnCount).selectAll('p').data(notes).enter().append('p')
      .attr('class', (note) => `note note-${note.kind}`).text((note) => note.text);
    row.parentNode.insertBefore(cell.node(), row.nextSibling);
  }

  function comparison(host, path, subjects) {
    const reference = path.modelings[path.reference];
    const subject = subjects[State.chosen.subject];
    const columns = [
      {
        title: 'Modeling',
        left: true,
        fill: (cell, m) => {
          cell.append('span').attr('class', 'swatch');
          cell.append('span').text(m.label);
          if (m.label !== m.modeling) cell.append('span').attr('class', 'faint').text(m.modeling);
        },
      },
      {
        title: 'Status',
        left: true,
        text: statusText,
        class: (m) => (m.converged ? '' : 'is-stopped'),
      },
      { title: 'Unknowns', text: (m) => d3.format(',')(m.unknowns).replace(/,/g, '\u2009') },
      { title: 'Load steps', text: (m) => m.steps },
      { title: 'Iterations', text: (m) => m.iterations },
      { title: 'Time', text: (m) => Numbers.duration(m.seconds) },
      { title: 'Error estimate', text: (m) => Numbers.percent(m.error_estimate, 2) },
      {
        title: 'Largest difference',
        unit: `from ${reference.label}`,
        text: (m) => (m === reference ? 'reference' : Numbers.percent(m.difference)),
        class: (m) => (m === reference ? 'faint' : 'is-key'),
      },
      { title: `Final x of ${subject.name}`, unit: length, text: (m) => lastPlace(subject, m, 0) },
      { title: 'Final y', unit: length, text: (m) => lastPlace(subject, m, 1) },
      {
        title: 'Rotation',
        unit: 'rad',
        text: (m) => (m.states.length ? Numbers.format(subject.rotation(last(m)), 6) : '–'),
      },
    ];
    make(host, columns, path.modelings)
      .style('--colour', (m) => State.colour(m.label))
      .attr('class', 'is-modeling')
      .each(function notes(m) { addNotes(this, m, columns.length); });
  }

  const modelingColumn = {
    title: 'Modeling',
    left: true,
    fill: (cell, m) => {
      cell.append('span').attr('class', 'swatch');
      cell.append('span').text(m.label);
    },
  };

  function fillExtreme(cell, path, extreme) {
    if (!extreme) {
      cell.text('–');
      return;
    }
    cell.append('span').text(Numbers.format(extreme.value));
    if (extreme.value === 0) return;
    cell.append('span').attr('class', 'faint is-place')
      .text(`${path.flexures[extreme.flexure]}, s = ${Numbers.short(extreme.s, 3)} ${length}`);
  }

  function safetyColumns(path, { unit }) {
    if (!path.modelings.some((m) => m.safety)) return [];
    const reached = (m) => (m.safety ? m.safety.reached : null);
    return [
      {
        title: 'Safety',
        unit: 'strength / stress',
        text: (m) => (m.safety ? Numbers.format(m.safety.factor, 3) : '–'),
        class: (m) => (m.safety && m.safety.factor !== null && m.safety.factor < 1
          ? 'is-stopped' : ''),
      },
      {
        title: 'Strength reached',
        unit: unit ? `at time, ${unit}` : 'at load factor',
        class: (m) => (reached(m) ? 'is-stopped' : 'faint'),
        fill: (cell, m) => {
          cell.append('span').text(reached(m) ? Numbers.format(reached(m).load_factor) : 'never');
          if (!reached(m)) return;
          cell.append('span').attr('class', 'faint is-place')
            .text(path.flexures[reached(m).flexure]);
        },
      },
    ];
  }

  // Of a motion: the largest stress at any of its times.
  function runColumns(path, { unit }) {
    const stress = SectionForces.named('stress');
    if (!path.modelings.some((m) => m.largest_stress)) return [];
    return [{
      title: 'Largest over the run',
      unit: stress.unit,
      fill: (cell, { largest_stress: largest }) => {
        cell.append('span').text(largest ? Numbers.format(largest.value) : '–');
        if (!largest) return;
        cell.append('span').attr('class', 'faint is-place')
          .text(`${path.flexures[largest.flexure]}, at ${Numbers.short(largest.time)} ${unit}`);
      },
    }];
  }

  // Section forces, stress and safety at the last state of every modeling.
  function extremes(host, path, timeline) {
    const columns = [modelingColumn, ...SectionForces.quantities.map((quantity) => ({
      title: quantity.name,
      unit: quantity.unit,
      fill: (cell, m) => fillExtreme(cell, path, SectionForces.extreme(m, quantity)),
    })), ...runColumns(path, timeline), ...safetyColumns(path, timeline)];
    make(host, columns, path.modelings).style('--colour', (m) => State.colour(m.label));
  }

  return {
    make, comparison, extremes, addNotes, modelingColumn,
  };
})();
