"""Limit points and buckling: Lee's frame, a deep arch, a toggle, columns."""

import math

import measure
import runs
from measure import TWICE, beam_sweep, convergence, exact_sweep, named_sweep, relative
from pages import Page, share, times
from pictures import picture
from plots import Series, plot
from runs import modeling


def limit_points(run, load):
    """Loads at the limit points of a path, and the states there."""
    return [(load * event["load_factor"], event["state"]["bodies"])
            for event in run.summary["events"] if event["kind"] == "limit point"]


def first_limit(run, load):
    found = limit_points(run, load)
    return found[0][0] if found else math.nan


def limit_sweeps():
    return [exact_sweep([3, 4, 5, 6, 7, 8, 10, 12]), beam_sweep(1, [4, 8, 16, 32, 64]),
            beam_sweep(2, [2, 4, 8, 16, 32]), beam_sweep(3, [2, 4, 8, 16]),
            beam_sweep(5, [1, 2, 4]),
            named_sweep("von_karman", [4, 8, 16, 32], name="beam", theory="von_karman")]


def limit_rows(found, truth, load):
    rows = []
    basis = found["exact"].summary["seconds"]
    for label, run in found.items():
        limits = [value for value, _ in limit_points(run, load)]
        cells = [f"{limits[k]:.8g}" if k < len(limits) else "none" for k in range(len(truth))]
        errors = [share(relative(limits[k], truth[k])) if k < len(limits) else ""
                  for k in range(len(truth))]
        rows.append([f"`{label}`", *[c for pair in zip(cells, errors) for c in pair],
                     run.summary["unknowns"], run.summary["iterations"],
                     times(run.summary["seconds"] / basis)])
    return rows


def lee_modelings():
    return [modeling("prbm"), modeling("bcm"), modeling("bcm", "bcm_4", elements=4),
            modeling("beam", "von_karman", theory="von_karman"), modeling("beam"),
            modeling("beam", "beam_order_4", elements=6, order=4, tolerance=1e-11),
            modeling("exact", tolerance=1e-10)]


def lee_frame(flexura):
    page = Page("lee_frame", "Lee's frame", ["verification/cases/lee_frame.toml"])
    model = runs.load_model(page.models[0])
    limits = [e for e in runs.reference_json("static/C_lee_frame_limits.json")["iii"]["extrema"]
              if e["kind"] == "extremum of P"]
    truth = [-limits[0]["P"], -limits[1]["P"]]
    found = flexura.run(model, runs.study(model, "snap", modelings=lee_modelings()))
    exact = limit_points(found["exact"], -2.5)
    page.text("""A column and a beam of length 120, rigidly joined, both pinned to the ground; a
    dead load presses on the beam at a fifth of its length. The frame carries it to a limit point,
    snaps, and would pull upwards before it carries load again: the load turns back twice, and so
    does the displacement under it.""")
    page.figure("picture", "Drawn, and at the end of the path, beyond both limit points",
                picture(model, found["exact"], [{"on": "loaded", "force": [0, -1.0]}]))
    page.section("Source and reference")
    page.text("""Lee, Manuel and Rossow (J. Eng. Mech. Div. ASCE 94, 1968), whose curve others
    digitised (18.76 and −9.47 in their units, E ten thousand times as large). Reference: [an
    independent continuation](../../tests/data/reference/static/README.md) in multiple precision;
    limit loads to 15 digits, places to 12.""")
    page.section("Limit loads")
    page.table(["modeling", "first limit", "error", "second limit", "error", "unknowns",
                "iterations", "cost by `exact`"], limit_rows(found, truth, -2.5))
    worst = max(relative(found_at[0], p) for found_at, p in zip(exact, truth))
    place = max(math.hypot(state["loaded"]["x"] - 24 - e["u"], state["loaded"]["y"] - 120 + e["v"])
                for (_, state), e in zip(exact, limits)) / 120
    page.promise("both limit loads", "exact", worst, 1e-11)
    page.promise("where the loaded point is there, by the length", "exact", place, 1e-5)
    lee_path(page, found)
    page.text("""Limit loads come out to twice the digits of places: the load is stationary there.
    The digitised curve is right to its reading, about 1 %.""")

    def error_of(run):
        return relative(first_limit(run, -2.5), truth[0])

    sweeps = limit_sweeps()
    convergence(page, measure.run_sweeps(flexura, model, runs.study(model, "snap", until={
        "limit_points": 1}), sweeps, error_of), "the first limit load",
        {**TWICE, "von_karman": "2"})
    return page


def lee_path(page, found):
    truth = runs.reference_table("static/C_lee_frame_path.csv", theory="iii")
    series = [Series("reference", [(r["v_load_point(+down)"], r["P"]) for r in truth], "thick", 0)]
    for k, label in enumerate(["exact", "bcm_4", "prbm"]):
        points = [(120 - r["loaded.y"], 2.5 * r["load_factor"]) for r in found[label].table()]
        series.append(Series(label, points, "line", (1, 4, 3)[k]))
    most = max(v for v, _ in series[1].points)
    series[0].points = [p for p in series[0].points if p[0] <= most + 2 and p[1] < 2.6]
    page.figure("path", "Load over the displacement under it, downwards",
                plot(series, "displacement", "load"))


def arch_and_toggle(flexura):
    page = Page("snap_through", "Snap-through of a deep arch and a toggle",
                ["verification/cases/deep_arch.toml", "verification/cases/williams_toggle.toml"])
    arch, toggle = (runs.load_model(m) for m in page.models)
    page.section("Deep arch")
    page.text("""DaDeppo and Schmidt (J. Appl. Mech. 42, 1975): an arch of radius 100 over 215
    degrees, one end clamped, the other hinged, inextensible in the source and here with
    EA = GA_s = 100 EI/unit². The dead load at the crown reaches 897 there.""")
    chosen = [modeling("prbm"), modeling("beam", "beam_16", elements=16),
              modeling("beam", "beam_order_5", elements=16, order=5, tolerance=1e-11),
              modeling("exact", tolerance=1e-9)]
    found = flexura.run(arch, runs.study(arch, "snap", modelings=chosen))
    page.figure("picture", "Drawn, and just past the limit point",
                picture(arch, found["exact"], [{"on": "crown", "force": [0, -1.0]}]))
    truth = [-897.0]
    page.table(["modeling", "limit load", "from 897", "unknowns", "iterations", "cost by `exact`"],
               limit_rows(found, truth, -1000.0))
    value = -first_limit(found["exact"], -1000.0)
    fine = -first_limit(found["beam_order_5"], -1000.0)
    page.promise("the arch's limit load against 897, three digits", "exact",
                 relative(value, 897.0), 1e-3)
    page.promise("the arch's limit load, from elements of order 5", "exact",
                 relative(value, fine), 1e-8)
    page.text(f"""Ours is {value:.6f}; curved elements of others give 897.3, straight ones 906.""")
    toggle_part(page, flexura, toggle)

    def error_of(run):
        return relative(-first_limit(run, -1000.0), fine)

    sweeps = [s for s in limit_sweeps() if s.name != "von_karman"]
    convergence(page, measure.run_sweeps(flexura, arch, runs.study(arch, "snap"), sweeps,
                                         error_of), "the arch's limit load (from order 5)", TWICE)
    return page


def toggle_part(page, flexura, model):
    page.section("Williams' toggle")
    page.text("""Two bars of 12.943 in, rise 0.386 in, clamped at the ground and joined rigidly, a
    dead load at the apex (Williams, Q. J. Mech. Appl. Math. 17, 1964; the data are those that the
    literature repeats). No digits are published that we could find, so this is no comparison with
    a truth from outside: two discretizations that share nothing but the beam are held against each
    other.""")
    chosen = [modeling("bcm"), modeling("bcm", "bcm_4", elements=4), modeling("prbm"),
              modeling("beam", "von_karman", theory="von_karman"), modeling("beam"),
              modeling("beam", "beam_order_5", elements=8, order=5, tolerance=1e-11),
              modeling("exact", tolerance=1e-10)]
    found = flexura.run(model, runs.study(model, "snap", modelings=chosen))
    truth = [-value for value, _ in limit_points(found["beam_order_5"], -80.0)]
    page.table(["modeling", "first limit, lbf", "error", "second limit, lbf", "error", "unknowns",
                "iterations", "cost by `exact`"],
               limit_rows(found, [-p for p in truth], -80.0))
    page.promise("the toggle's limit loads, from elements of order 5", "exact",
                 max(relative(-v, p) for (v, _), p in
                     zip(limit_points(found["exact"], -80.0), truth)), 1e-8)
    series = []
    for k, label in enumerate(["exact", "bcm_4", "bcm", "prbm"]):
        points = [(0.386 - r["apex.y"], 80.0 * r["load_factor"]) for r in found[label].table()]
        points = [p for p in points if p[0] < 0.9 and abs(p[1]) < 90]
        series.append(Series(label, points, "thick" if k == 0 else "line", (0, 4, 1, 3)[k]))
    page.figure("toggle", "Load of the toggle over the displacement of its apex",
                plot(series, "displacement, in", "load, lbf"))
