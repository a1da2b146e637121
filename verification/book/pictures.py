"""A picture of a mechanism, drawn and moved, from its model and the tables of a run."""

import math

from plots import svg

FLEXURE, GHOST, BODY, LOAD = "var(--c1)", "var(--ghost)", "var(--c3)", "var(--c2)"


def plain_number(value, degrees=False):
    """Of a number, or a text that ends in "deg", in radians."""
    if isinstance(value, str):
        amount = float(value.split()[0])
        return math.radians(amount) if value.endswith("deg") else amount
    return math.radians(value) if degrees and abs(value) > 4.0 * math.pi else value


def axis_points(axis):
    """Places along the axis of a flexure as drawn."""
    if "line" in axis:
        return [tuple(point) for point in axis["line"]]
    if "spline" in axis:
        return [tuple(point) for point in axis["spline"]]
    arc = axis["arc"]
    start, sweep = plain_number(arc["start"]), plain_number(arc["sweep"])
    (cx, cy), r = arc["centre"], arc["radius"]
    angles = [start + sweep * k / 40 for k in range(41)]
    return [(cx + r * math.cos(a), cy + r * math.sin(a)) for a in angles]


def attached_points(model, body):
    """Of a body: ends of flexures, named points and its centre."""
    found = []
    for flexure in model["flexures"].values():
        points = axis_points(flexure["axis"])
        for end, place in zip(flexure["between"], (points[0], points[-1])):
            if end == body:
                found.append(place)
    table = model["bodies"][body]
    found += [tuple(point) for point in table.get("points", {}).values()]
    if "centre" in table:
        found.append(tuple(table["centre"]))
    return found


def hull(points):
    """The convex hull, counter-clockwise."""
    points = sorted(set((round(x, 12), round(y, 12)) for x, y in points))
    if len(points) < 3:
        return points

    def chain(ordered):
        kept = []
        for p in ordered:
            while len(kept) > 1 and cross(kept[-2], kept[-1], p) <= 0:
                kept.pop()
            kept.append(p)
        return kept[:-1]

    return chain(points) + chain(points[::-1])


def cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def moved(points, start, row, body):
    """Points of a body as drawn, where a row of a path has them."""
    x0, y0 = start[f"{body}.x"], start[f"{body}.y"]
    x, y = row[f"{body}.x"], row[f"{body}.y"]
    turn = row[f"{body}.rotation"] - start[f"{body}.rotation"]
    c, s = math.cos(turn), math.sin(turn)
    return [(x + c * (a - x0) - s * (b - y0), y + s * (a - x0) + c * (b - y0)) for a, b in points]


class Frame:
    """From places of the model to pixels."""

    def __init__(self, points, width=760, most=360, margin=46):
        xs, ys = [p[0] for p in points], [p[1] for p in points]
        size = max(max(xs) - min(xs), 1e-12), max(max(ys) - min(ys), 1e-12)
        self.scale = min((width - 2 * margin) / size[0], (most - 2 * margin) / size[1])
        self.width, self.height = width, int(size[1] * self.scale + 2 * margin)
        self.height = max(self.height, 150)
        self.x0 = 0.5 * (width - self.scale * (min(xs) + max(xs)))
        self.y0 = 0.5 * (self.height + self.scale * (min(ys) + max(ys)))

    def __call__(self, point):
        return self.x0 + self.scale * point[0], self.y0 - self.scale * point[1]

    def path(self, points):
        return "M" + "L".join("{:.1f} {:.1f}".format(*self(point)) for point in points)


def polyline(frame, points, colour, width=2.4):
    return (f'<path fill="none" stroke="{colour}" stroke-width="{width}" '
            f'stroke-linejoin="round" stroke-linecap="round" d="{frame.path(points)}"/>')


def shape(frame, points, colour):
    """A rigid body: its hull, or a bar between two places."""
    outline = hull(points)
    if len(outline) < 2:
        x, y = frame(points[0])
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{colour}"/>'
    return (f'<path fill="{colour}" fill-opacity="0.12" stroke="{colour}" stroke-width="6" '
            f'stroke-opacity="0.55" stroke-linejoin="round" stroke-linecap="round" '
            f'd="{frame.path(outline)}Z"/>')


def ground(frame, flexure, end):
    """Hatching where an end is clamped to the ground, a circle where it is pinned."""
    points = axis_points(flexure["axis"])
    at, towards = (points[0], points[1]) if end == 0 else (points[-1], points[-2])
    x, y = frame(at)
    body = flexure["between"][end]
    if body in flexure.get("pinned", []):
        return (f'<circle cx="{x:.1f}" cy="{y:.1f}" r="6" class="panel" stroke="var(--soft)" '
                f'stroke-width="1.6"/>')
    tx, ty = frame(towards)
    turn = math.degrees(math.atan2(ty - y, tx - x))
    hatch = "".join(f"M0 {k}l-7 6" for k in range(-14, 15, 7))
    return (f'<path transform="translate({x:.1f} {y:.1f}) rotate({turn:.1f})" fill="none" '
            f'stroke="var(--soft)" stroke-width="1.3" d="M0-16V16{hatch}"/>')


def guides(frame, model, places):
    """A pair of rails beside every body that slides along the ground."""
    parts = []
    for joint in model.get("joints", {}).values():
        if "prismatic" not in joint:
            continue
        body, along = joint["prismatic"]["bodies"][1], joint["prismatic"]["direction"]
        x, y = frame(places[body][0])
        turn = math.degrees(math.atan2(-along[1], along[0]))
        parts.append(f'<path transform="translate({x:.1f} {y:.1f}) rotate({turn:.1f})" '
                     f'fill="none" stroke="var(--soft)" stroke-width="1.3" '
                     f'd="M-12-6H12M-12 6H12M-9-6l4-5M-2-6l4-5M5-6l4-5M-9 11l4-5M-2 11l4-5M5 '
                     f'11l4-5"/>')
    return parts


def arrow(frame, at, force):
    """A force that pushes at a place: the arrow's point is there."""
    x, y = frame(at)
    turn = math.degrees(math.atan2(-force[1], force[0]))
    return (f'<g transform="translate({x:.1f} {y:.1f}) rotate({turn:.1f})">'
            f'<path stroke="{LOAD}" stroke-width="2" d="M-40 0H-8"/>'
            f'<path fill="{LOAD}" d="M-2 0L-13-5V5Z"/></g>')


def round_arrow(frame, at, moment):
    x, y = frame(at)
    flip = -1 if moment > 0 else 1
    return (f'<g transform="translate({x:.1f} {y:.1f}) scale(1 {flip})">'
            f'<path fill="none" stroke="{LOAD}" stroke-width="2" d="M15-9A17 17 0 1 1 3-17"/>'
            f'<path fill="{LOAD}" transform="translate(3 -17) rotate(10)" '
            f'd="M11 0L-1-5V5Z"/></g>')


def place_of(model, on):
    """As drawn: of a body's point or its centre."""
    body, _, point = on.partition(".")
    table = model["bodies"][body]
    if point:
        return tuple(table["points"][point])
    if "centre" in table:
        return tuple(table["centre"])
    return attached_points(model, body)[0]


def load_arrows(frame, model, loads, rows):
    parts = []
    for load in loads:
        body = load["on"].partition(".")[0]
        at = moved([place_of(model, load["on"])], rows[0], rows[-1], body)[0] if rows else (
            place_of(model, load["on"]))
        force = [v for v in load.get("force", [0, 0])]
        if any(isinstance(v, str) for v in force):
            continue
        if any(force):
            parts.append(arrow(frame, at, force))
        if load.get("moment"):
            parts.append(round_arrow(frame, at, load["moment"]))
    return parts


def stations(run):
    """Places along every flexure at the last state of a run, and a smooth line through them."""
    lines = {}
    for row in run.table("members"):
        lines.setdefault(row["flexure"], []).append((row["x"], row["y"]))
    return {name: smooth(line) for name, line in lines.items()}


def smooth(points, between=4):
    """Points on the cubic (Catmull and Rom's) through all of a line's."""
    ends = [points[0], *points, points[-1]]
    line = []
    for a, b, c, d in zip(ends, ends[1:], ends[2:], ends[3:]):
        for k in range(between):
            t = k / between
            line.append(tuple(q + 0.5 * t * (r - p + t * (2 * p - 5 * q + 4 * r - s
                                                         + t * (3 * (q - r) + s - p)))
                              for p, q, r, s in zip(a, b, c, d)))
    return [*line, points[-1]]


def fixed_bodies(model):
    return {name for name, table in model["bodies"].items() if table.get("fixed")}


def picture(model, run=None, loads=()):
    """The mechanism as drawn (grey) and at the last state of a run (colour)."""
    drawn = {name: axis_points(f["axis"]) for name, f in model["flexures"].items()}
    bent = stations(run) if run else {}
    rows = run.table() if run else []
    fixed = fixed_bodies(model)
    free = {name: attached_points(model, name) for name in model["bodies"] if name not in fixed}
    ended = {n: moved(p, rows[0], rows[-1], n) for n, p in free.items()} if rows else free
    everything = [p for group in (drawn, bent, free, ended) for line in group.values()
                  for p in line]
    frame = Frame(everything)
    parts = []
    if run:
        parts += [polyline(frame, line, GHOST, 1.4) for line in drawn.values()]
        parts += [shape(frame, points, GHOST) for points in free.values() if points]
    parts += [shape(frame, points, BODY) for points in ended.values() if points]
    parts += [polyline(frame, line, FLEXURE) for line in (bent or drawn).values()]
    for flexure in model["flexures"].values():
        parts += [ground(frame, flexure, end) for end in (0, 1)
                  if flexure["between"][end] in fixed]
    parts += guides(frame, model, ended)
    parts += load_arrows(frame, model, loads, rows)
    return svg(frame.width, frame.height, parts)
