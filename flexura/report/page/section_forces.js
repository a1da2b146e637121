'use strict';
// Section forces and stress at the last state of a modeling: what they are called, and where they
// are largest.
const SectionForces = (() => {
  const { length, force } = State.units;

  // `sign` is the word of the switch, `letter` that of a value; `column` is that of a station's
  // row; `side` is where a diagram has what is positive: 1 to the left of the axis, seen from its
  // base end. Moments then lie on the side in tension.
  const quantities = [
    {
      key: 'axial_force',
      sign: 'N',
      letter: 'N',
      name: 'Axial force',
      unit: force,
      column: 1,
      side: 1,
    },
    {
      key: 'shear_force',
      sign: 'V',
      letter: 'V',
      name: 'Shear force',
      unit: force,
      column: 2,
      side: 1,
    },
    {
      key: 'bending_moment',
      sign: 'M',
      letter: 'M',
      name: 'Bending moment',
      unit: `${force}·${length}`,
      column: 3,
      side: -1,
    },
    {
      key: 'stress',
      sign: 'stress',
      letter: 'σ',
      name: 'Largest fibre stress',
      unit: `${force}/${length}²`,
      column: 4,
      side: 1,
    },
  ];
  const named = (key) => quantities.find((quantity) => quantity.key === key) || null;

  const place = (row) => [row[5], row[6]];
  const rowsOf = (modeling) => modeling.members.flatMap(
    (rows, flexure) => rows.map((row, station) => ({ row, flexure, station })));
  const largest = (rows, column) => d3.max(rows, ({ row }) => Math.abs(row[column])) || 0;

  // Where the absolute value is largest: {value, flexure, station, s}, null without any stations.
  // What is nothing but rounding of the other forces is 0.
  function extreme(modeling, { column }) {
    const rows = rowsOf(modeling);
    if (rows.length === 0) return null;
    const most = largest(rows, column);
    const { row, flexure, station } = rows.find((r) => Math.abs(r.row[column]) === most);
    const load = Math.max(largest(rows, 1), largest(rows, 2), largest(rows, 3) / Mechanism.extent);
    const unit = { 1: load, 2: load, 3: load * Mechanism.extent, 4: 0 }[column];
    const value = most <= 1e-9 * unit ? 0 : row[column];
    return { value, flexure, station, s: row[0] };
  }

  return { quantities, named, place, extreme };
})();
