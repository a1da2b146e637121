"""What cases have in common: errors of paths, tables of modelings, series over meshes."""

import math

from pages import scientific, share, times
from plots import Series, plot
from runs import modeling

LARGEST_SHOWN = 0.5  # errors above are not on convergence plots
FLOOR = 3e-12  # nor are those that Newton's tolerance and rounding leave


def path_error(found, truth, columns):
    """The largest distance over the rows from the truth, by its largest displacement from the
    first row. `columns`: pairs (column found, column of the truth) that together are a place."""
    start = truth[0]
    apart = moved = 0.0
    for a, b in zip(found, truth):
        apart = max(apart, math.hypot(*(a[i] - b[j] for i, j in columns)))
        moved = max(moved, math.hypot(*(b[j] - start[j] for _, j in columns)))
    return apart / moved


def relative(found, truth):
    return abs(found / truth - 1.0)


def modeling_rows(runs, error_of, cost_by="exact"):
    """Rows of the table of modelings; a run that stopped says so."""
    basis = runs[cost_by].summary["seconds"] if cost_by in runs else None
    rows = []
    for label, run in runs.items():
        entry = run.summary
        error = error_of(run) if run.converged else None
        estimate = entry.get("error_estimate")
        rows.append([
            f"`{label}`", share(error) if run.converged else "stopped",
            "" if estimate is None else scientific(estimate) if estimate else "< 1e-13",
            entry.get("unknowns", ""), entry.get("iterations", ""),
            times(entry["seconds"] / basis) if basis else ""])
    return rows


MODELING_HEAD = ["modeling", "error", "its own estimate", "unknowns", "iterations",
                 "cost by `exact`"]


def modeling_table(page, runs, error_of, cost_by="exact"):
    page.table(MODELING_HEAD, modeling_rows(runs, error_of, cost_by))


class Sweep:
    """One modeling at several sizes: `make(size)` gives its settings, `size` the number by which
    h is counted (elements of a flexure, or modes)."""

    def __init__(self, name, sizes, make, counted="elements"):
        self.name, self.sizes, self.make, self.counted = name, sizes, make, counted

    def labels(self):
        return [f"{self.name}_{size}".replace(" ", "_") for size in self.sizes]

    def modelings(self):
        return [modeling(label=label, **self.make(size))
                for label, size in zip(self.labels(), self.sizes)]


def beam_sweep(order, sizes, **settings):
    return Sweep(f"beam order {order}", sizes, lambda n: {
        "name": "beam", "elements": n, "order": order, "tolerance": 1e-11, **settings})


def named_sweep(title, sizes, **settings):
    return Sweep(title, sizes, lambda n: {"elements": n, "tolerance": 1e-11, **settings})


def exact_sweep(sizes, **settings):
    return Sweep("exact", sizes, lambda n: {
        "name": "exact", "modes": n, "tolerance": 1e-11, **settings}, "modes")


def standard_sweeps(**settings):
    """Those of most cases."""
    return [exact_sweep([2, 3, 4, 5, 6, 7, 8, 10, 12], **settings),
            beam_sweep(1, [2, 4, 8, 16, 32, 64, 128], **settings),
            beam_sweep(2, [2, 4, 8, 16, 32, 64], **settings),
            beam_sweep(3, [1, 2, 4, 8, 16, 32], **settings),
            beam_sweep(5, [1, 2, 4, 8], **settings)]


def run_sweeps(flexura, model, study, sweeps, error_of):
    """For each sweep its sizes, unknowns and errors, of those runs that converged."""
    chosen = [m for sweep in sweeps for m in sweep.modelings()]
    changed = {**study, "modelings": chosen}
    changed.pop("reference", None)
    if study["kind"] == "path":
        changed["estimate"] = False
    runs = flexura.run(model, changed)
    found = []
    for sweep in sweeps:
        points = []
        for size, label in zip(sweep.sizes, sweep.labels()):
            run = runs[label]
            error = error_of(run) if run.converged else math.nan
            if not math.isnan(error):
                points.append((size, run.summary["unknowns"], error))
        found.append((sweep, points))
    return found


def shown(points):
    return [(size, unknowns, error) for size, unknowns, error in points
            if FLOOR < error < LARGEST_SHOWN]


def observed_order(points):
    """The slope between the last two points well above the floor; None where there are not two."""
    kept = [(size, error) for size, _, error in points if 100.0 * FLOOR < error < 0.05]
    if len(kept) < 2:
        return None
    (a, ea), (b, eb) = kept[-2:]
    return math.log(ea / eb) / math.log(b / a)


def convergence(page, found, what, expected=None):
    """The plot over unknowns and the table of orders. `expected`: by sweep, what theory says."""
    page.section("Convergence")
    series = [Series(sweep.name, [(u, e) for _, u, e in shown(points)], "marks", k)
              for k, (sweep, points) in enumerate(found)]
    page.figure("convergence", f"Error of {what}, over unknowns",
                plot(series, "unknowns", "error", True, True))
    rows = []
    for sweep, points in found:
        if not points:
            continue
        order = None if sweep.counted == "modes" else observed_order(points)
        finest = min(points, key=lambda p: p[2])
        wanted = (expected or {}).get(sweep.name)
        rows.append([f"`{sweep.name}`", f"{finest[0]} {sweep.counted}", finest[1],
                     share(finest[2]), "" if order is None else f"{order:.2f}",
                     "faster than any" if sweep.counted == "modes" else wanted or ""])
    page.table(["series", "best", "unknowns", "its error", "observed order", "expected"], rows)
    page.text("""Orders are the slope between the two finest meshes whose errors stand above what
    Newton's method and rounding leave.""")


TWICE = {f"beam order {p}": str(2 * p) for p in (1, 2, 3, 4, 5)}
