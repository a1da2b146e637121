'use strict';
// Outlines as SVG path data, in screen coordinates (y down).
const Shapes = (() => {
  const f = (value) => value.toFixed(2);
  const at = (x, y) => `${f(x)},${f(y)}`;

  // Everything within `radius` of the convex hull of the points.
  function roundedHull(points, radius) {
    const distinct = points.filter((p, i) => points.findIndex(
      (q) => Math.hypot(p[0] - q[0], p[1] - q[1]) < 1e-6) === i);
    if (distinct.length === 0) return '';
    if (distinct.length === 1) return circle(distinct[0], radius);
    // A hull of two points, or of points in a line, is a segment walked there and back.
    const hull = (distinct.length > 2 && d3.polygonHull(distinct)) || extremes(distinct);
    if (hull.length > 2 && d3.polygonArea(hull) > 0) hull.reverse();
    const offset = (a, b) => {
      const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
      return [radius * (b[1] - a[1]) / length, radius * (a[0] - b[0]) / length];
    };
    const sides = hull.map((a, i) => [a, hull[(i + 1) % hull.length]]);
    const parts = sides.map(([a, b], i) => {
      const [nx, ny] = offset(a, b);
      const [c, d] = sides[(i + 1) % sides.length];
      const [mx, my] = offset(c, d);
      const begin = i === 0 ? `M${at(a[0] + nx, a[1] + ny)}` : '';
      return `${begin}L${at(b[0] + nx, b[1] + ny)}`
        + `A${f(radius)},${f(radius)} 0 0 1 ${at(b[0] + mx, b[1] + my)}`;
    });
    return `${parts.join('')}Z`;
  }

  function extremes(points) {
    const along = d3.extent(points, (p) => p[0])[0] === d3.extent(points, (p) => p[0])[1] ? 1 : 0;
    const sorted = [...points].sort((a, b) => a[along] - b[along]);
    return [sorted[0], sorted[sorted.length - 1]];
  }

  function circle([x, y], r) {
    const half = `a${f(r)},${f(r)} 0 1 0`;
    return `M${at(x - r, y)}${half} ${f(2 * r)},0${half} ${f(-2 * r)},0Z`;
  }

  // A filled head whose point is at `tip`, pointing along `angle`.
  function arrowHead(tip, angle, size) {
    const ex = Math.cos(angle);
    const ey = Math.sin(angle);
    const neck = [tip[0] - size * ex, tip[1] - size * ey];
    const half = 0.38 * size;
    return `M${at(...tip)}L${at(neck[0] - half * ey, neck[1] + half * ex)}`
      + `L${at(neck[0] + half * ey, neck[1] - half * ex)}Z`;
  }

  // An arrow of `length` ending at `tip`, pointing along `angle`.
  function arrow(tip, angle, length) {
    const size = Math.min(9, 0.7 * length);
    const back = (distance) => [
      tip[0] - distance * Math.cos(angle), tip[1] - distance * Math.sin(angle)];
    return {
      shaft: `M${at(...back(length))}L${at(...back(0.8 * size))}`,
      head: arrowHead(tip, angle, size),
    };
  }

  // A moment: most of a circle with a head; counter-clockwise on the screen if positive.
  function momentArc(centre, radius, positive) {
    const sign = positive ? -1 : 1; // of the screen's angle, which grows clockwise
    const point = (a) => [centre[0] + radius * Math.cos(a), centre[1] + radius * Math.sin(a)];
    const start = Math.PI / 2 - sign * 0.9;
    const end = start + sign * 1.4 * Math.PI;
    const size = 9;
    // The head's axis is the chord of the arc that it covers.
    const tip = point(end + sign * size / radius);
    const neck = point(end);
    const angle = Math.atan2(tip[1] - neck[1], tip[0] - neck[0]);
    const arc = `A${f(radius)},${f(radius)} 0 1 ${positive ? 0 : 1}`;
    return {
      shaft: `M${at(...point(start))}${arc} ${at(...neck)}`,
      head: arrowHead(tip, angle, size),
    };
  }

  // The built-in end of a flexure: a line across its axis, hatched behind. `angle` is the
  // direction in which the flexure leaves, on the screen.
  function ground([x, y], angle, half = 17) {
    const ex = Math.cos(angle);
    const ey = Math.sin(angle);
    const place = (across, behind) => [
      x - ey * across - ex * behind, y + ex * across - ey * behind];
    const line = `M${at(...place(-half, 0))}L${at(...place(half, 0))}`;
    const hatch = d3.range(-half + 7, half + 1, 6).map(
      (t) => `M${at(...place(t, 0))}L${at(...place(t - 7, 8))}`).join('');
    return { line, hatch };
  }

  // A slider: two rails along `angle`, and the hatches that hold them to the ground.
  function slider([x, y], angle, half = 15, gap = 6) {
    const ex = Math.cos(angle);
    const ey = Math.sin(angle);
    const place = (along, across) => at(x + ex * along - ey * across, y + ey * along + ex * across);
    const rail = (side) => `M${place(-half, side)}L${place(half, side)}`;
    const hatch = d3.range(-half + 6, half + 1, 6).map(
      (t) => `M${place(t, gap)}L${place(t - 5, gap + 6)}`).join('');
    return { rails: rail(gap) + rail(-gap), hatch };
  }

  // An ellipse whose major axis points along `angle` on the screen.
  function ellipse([cx, cy], major, minor, angle) {
    const dx = major * Math.cos(angle);
    const dy = major * Math.sin(angle);
    const turn = f(angle * 180 / Math.PI);
    const half = `A${f(major)},${f(Math.max(minor, 0.01))} ${turn} 1 1`;
    const start = at(cx - dx, cy - dy);
    return `M${start}${half} ${at(cx + dx, cy + dy)}${half} ${start}Z`;
  }

  // A coil between two places, straight for a while at both ends.
  function coil(a, b, half = 5) {
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (length < 1) return '';
    const [ex, ey] = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
    const place = (along, across) => at(
      a[0] + ex * along - ey * across, a[1] + ey * along + ex * across);
    const lead = Math.min(10, 0.2 * length);
    const turns = 2 * Math.round(Math.min(Math.max(length / 11, 3), 20));
    const teeth = d3.range(turns).map((k) => place(
      lead + (length - 2 * lead) * (k + 0.5) / turns, k % 2 ? half : -half));
    return `M${at(...a)}L${place(lead, 0)}L${teeth.join('L')}L${place(length - lead, 0)}L${at(...b)}`;
  }

  // A flat spiral about a place, from the direction `angle` on the screen outwards.
  function spiral([x, y], angle, radius = 13) {
    const turns = 2.5;
    const points = d3.range(0, 61).map((k) => {
      const share = k / 60;
      const a = angle + 2 * Math.PI * turns * share;
      return at(x + radius * share * Math.cos(a), y + radius * share * Math.sin(a));
    });
    return `M${points.join('L')}`;
  }

  return {
    roundedHull, circle, arrow, momentArc, ground, slider, ellipse, coil, spiral,
  };
})();
