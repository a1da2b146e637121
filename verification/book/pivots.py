"""Pivots and stages: the cross-spring pivot, a parallelogram, a circular hinge."""

import math

import measure
import runs
from measure import TWICE, convergence, modeling_table, named_sweep, relative
from pages import Page, scientific, share
from pictures import picture
from plots import Series, plot
from runs import modeling

STEEL_SET = "L50 b10 h0.5 E210000"


def resolved(model, **values):
    """The model with its expressions of places replaced: pictures take numbers alone."""
    def replace(value):
        if isinstance(value, dict):
            return {k: replace(v) for k, v in value.items()}
        if isinstance(value, list):
            return [replace(v) for v in value]
        if isinstance(value, str) and value.startswith("= "):
            sign = -1.0 if value[2:].startswith("-") else 1.0
            return sign * values.get(value[2:].lstrip("-"), math.nan)
        return value
    return {**model, "flexures": replace(model["flexures"])}


def pivot_path(flexura, model, moments, modelings):
    """States under each of the moments of a table: one study per moment, of one step."""
    errors = {}
    for moment in moments:
        study = {"kind": "path", "loads": [{"on": "stage", "moment": moment}], "steps": 4,
                 "modelings": modelings, "estimate": False}
        for label, run in flexura.run(model, study).items():
            errors.setdefault(label, []).append(run)
    return errors


def off_from(found, truth):
    """Rotation and shift of the crossing point: errors over all rows, relative to the largest."""
    turn = max(abs(run.table()[-1]["stage.rotation"] - row["phi_rad"])
               for run, row in zip(found, truth)) / max(abs(r["phi_rad"]) for r in truth)
    apart = max(math.hypot(run.table()[-1]["stage.x"] - row["shift_x"],
                           run.table()[-1]["stage.y"] - row["shift_y"])
                for run, row in zip(found, truth))
    return turn, apart / max(math.hypot(r["shift_x"], r["shift_y"]) for r in truth)


def cross_spring(flexura):
    page = Page("cross_spring", "Cross-spring pivot", ["verification/cases/cross_spring.toml"])
    model = runs.load_model(page.models[0])
    page.text("""Two steel leaves of 50 mm cross at mid-length at 90 degrees and carry a stage that
    a pure moment turns, up to 1.3 rad. The stage turns nearly, but not quite, about the crossing
    point: its shift is what a designer wants to know, and it is small, so it is a hard test.""")
    whole = runs.reference_table("static/C_cross_spring_pivot.csv", set=STEEL_SET, theory="iii")
    truth = whole[3::4]
    moments = [row["M"] for row in truth]
    chosen = [modeling("linear"), modeling("scmbm"), modeling("prbm"),
              modeling("prbm", "prbm_su", parameters="su"), modeling("bcm"),
              modeling("bcm", "bcm_8", elements=8),
              modeling("beam", "von_karman", theory="von_karman"), modeling("beam"),
              modeling("beam", "beam_order_4", elements=8, order=4),
              modeling("exact", tolerance=1e-11), modeling("continuum", tolerance=1e-5)]
    found = pivot_path(flexura, model, moments, chosen)
    drawing = resolved(model, h=50 / (2 * math.sqrt(2)))
    page.figure("picture", f"Drawn, and turned by {truth[-1]['phi_rad']:.3g} rad",
                picture(drawing, found["exact"][-1], [{"on": "stage", "moment": 1.0}]))
    page.section("Source and reference")
    page.text("""Haringx (Appl. Sci. Res. A1, 1949) and many since; published tables give few
    digits. Reference: [an independent solution](../../tests/data/reference/static/README.md), 15
    digits, by shooting, with axial and shear strain.""")
    page.section("Modelings")
    rows, exact_off = [], None
    for label, path in found.items():
        if not all(run.converged for run in path):
            rows.append([f"`{label}`", "stopped", "", "", ""])
            continue
        turn, shift = off_from(path, truth)
        exact_off = max(turn, shift) if label == "exact" else exact_off
        rows.append([f"`{label}`", share(turn), share(shift), path[-1].summary["unknowns"],
                     path[-1].summary["iterations"]])
    page.table(["modeling", "rotation", "shift", "unknowns", "iterations, last moment"], rows)
    page.promise("rotation and shift, 1.3 rad", "exact", exact_off, 1e-9)
    page.text(f"""Errors are the largest over {len(truth)} moments, by the largest value.""")
    shifts(page, found, truth)
    page.text("""The shift comes from the shortening of bent leaves. `linear` and `scmbm` know
    nothing of that and have none. Pseudo-rigid-body chains have rotation and shift to some per
    cent.""")
    pivot_convergence(page, flexura, model, truth[-1])
    return page


def shifts(page, found, truth):
    series = [Series("truth", [(r["phi_rad"], math.hypot(r["shift_x"], r["shift_y"]))
                               for r in truth], "thick", 0)]
    for k, label in enumerate(["exact", "prbm", "bcm", "scmbm"]):
        points = []
        for run in found[label]:
            last = run.table()[-1]
            points.append((last["stage.rotation"], math.hypot(last["stage.x"], last["stage.y"])))
        points = [p for p in points if p[0] < 1.5 and p[1] < 20]
        series.append(Series(label, points, "marks", k + 1))
    page.figure("shift", "Shift of the crossing point over the rotation",
                plot(series, "rotation, rad", "shift, mm"))


def pivot_convergence(page, flexura, model, row):
    study = {"kind": "path", "loads": [{"on": "stage", "moment": row["M"]}], "steps": 4,
             "modelings": [], "estimate": False}

    def error_of(run):
        last = run.table()[-1]
        return math.hypot(last["stage.x"] - row["shift_x"],
                          last["stage.y"] - row["shift_y"]) / math.hypot(row["shift_x"],
                                                                         row["shift_y"])

    sweeps = measure.standard_sweeps() + [
        named_sweep("von_karman", [4, 8, 16, 32, 64], name="beam", theory="von_karman")]
    convergence(page, measure.run_sweeps(flexura, model, study, sweeps, error_of),
                "the shift at the largest moment", {**TWICE, "von_karman": "2"})


SOLID = {1: (-0.00097028, 0.0400768, 1.0278e-4), 5: (-0.02284664, 0.193272, 1.25510e-3),
         10: (-0.0784276, 0.352388, 6.45661e-3), 20: (-0.215222, 0.559876, 3.45973e-2)}
PLANAR = {5: (-0.02446316, 0.20051343), 10: (-0.08386905, 0.36483612)}


def stage_at(run, ay):
    row = run.table()[ay]
    return row["stage.x"] / 250 - 1, row["stage.y"] / 250, row["stage.rotation"]


def parallelogram(flexura):
    page = Page("parallelogram", "Parallelogram flexure",
                ["verification/cases/parallelogram.toml"])
    model = runs.load_model(page.models[0])
    chosen = [modeling("linear"), modeling("scmbm"), modeling("prbm"),
              modeling("prbm", "prbm_su", parameters="su"), modeling("bcm"),
              modeling("bcm", "bcm_4", elements=4),
              modeling("beam", "von_karman", theory="von_karman"), modeling("beam"),
              modeling("beam", "beam_order_4", elements=8, order=4), modeling("exact"),
              modeling("exact", "inextensible", axial=False, shear=False),
              modeling("continuum", tolerance=1e-5),
              modeling("continuum", "plane_strain", tolerance=1e-5, plane="strain")]
    found = flexura.run(model, runs.study(model, "push", modelings=chosen, reference="exact"))
    page.text("""Two steel leaves of 250 by 50 by 5 mm, 150 mm apart, guide a stage. A force across
    them, up to Fy L²/EI = 20, moves it by more than half their length.""")
    page.figure("picture", "Drawn, and under the full force",
                picture(model, found["exact"], [{"on": "stage", "force": [0, 1.0]}]))
    page.section("Source and reference")
    page.text("""A public data set (MIT licence,
    github.com/haijunsu-osu/parallelogram_model_comparison) with solid finite elements (CalculiX,
    second order, 10 mm) and the boundary value problem of inextensible beams. The solids are
    themselves some per cent off: the data set's finer mesh moves them by 0.6 to 1.7 % at Fy L²/EI
    = 5.""")
    page.section("The boundary value problem")
    rows, worst = [], 0.0
    for ay, (ux, uy) in PLANAR.items():
        x, y, _ = stage_at(found["inextensible"], ay)
        off = max(abs(x - ux), abs(y - uy))
        worst = max(worst, off)
        rows.append([ay, f"{ux:.8f}", f"{x:.8f}", f"{uy:.8f}", f"{y:.8f}", scientific(off)])
    page.table(["Fy L²/EI", "ux/L theirs", "ours", "uy/L theirs", "ours", "off"], rows)
    page.promise("displacements of inextensible leaves, in lengths", "exact", worst, 1e-5)
    solids(page, found)
    page.section("Modelings")
    page.text("Against `exact` with axial and shear strain: distance of the stage over 20 loads.")
    truth = found["exact"].table()
    columns = [("stage.x", "stage.x"), ("stage.y", "stage.y")]
    modeling_table(page, found, lambda run: measure.path_error(run.table(), truth, columns))
    fine = flexura.run(model, runs.study(model, "push", estimate=False, modelings=[
        modeling("exact", modes=16, tolerance=1e-12)]))["exact"].table()
    convergence(page, measure.run_sweeps(
        flexura, model, runs.study(model, "push"),
        measure.standard_sweeps() + [
            named_sweep("von_karman", [4, 8, 16, 32, 64], name="beam", theory="von_karman")],
        lambda run: measure.path_error(run.table(), fine, columns)),
        "the stage (from 16 modes)", {**TWICE, "von_karman": "2"})
    return page


def solids(page, found):
    page.section("The solid elements")
    rows = []
    for ay, (ux, uy, turn) in SOLID.items():
        beam, strain = stage_at(found["exact"], ay), stage_at(found["plane_strain"], ay)
        rows.append([ay, f"{uy:.6f}", f"{beam[1]:.6f}", f"{strain[1]:.6f}",
                     share(beam[1] / uy - 1.0), share(strain[1] / uy - 1.0), f"{ux:.6f}",
                     f"{beam[0]:.6f}", f"{strain[0]:.6f}"])
    page.table(["Fy L²/EI", "uy/L solid", "beam", "plane strain", "beam off", "plane strain off",
                "ux/L solid", "beam", "plane strain"], rows)
    page.text("""A leaf ten times as wide as thick bends as a strip where it is free to curl
    across its width, and as a plate, stiffer by 1/(1 − ν²), where the clamps keep it from it. The
    solids lie between the two (the beam, and the continuum in plane strain), as they should: no
    plane model is wrong here, and none is right (test
    `ParallelogramFlexure.SolidsLieBetweenStripAndPlate`).""")


def paros(t, r, modulus=210e3, width=10.0):
    """Rotation per moment of a right circular hinge of length 2r: the integral of 12/(E b t³)."""
    b = t / (2 * r)
    q = b * (2 + b)
    arc = math.atan(math.sqrt((2 + b) / b))
    return 3 / (2 * modulus * width * r * r * q) * (
        1 / (1 + b) + (3 + 2 * b + b * b) / ((1 + b) * q) + 6 * (1 + b) / q**1.5 * arc)


def smith(t, r, modulus=210e3, width=10.0):
    return 24 * (0.565 * t / r + 0.166) * r / (modulus * width * t**3)


def circular_hinge(flexura):
    page = Page("circular_hinge", "Right circular hinge",
                ["verification/cases/circular_hinge.toml"])
    model = runs.load_model(page.models[0])
    page.text("""A hinge of 8 mm cut by two circles of 4 mm radius, t thick in the middle and 10
    mm wide, is turned by a moment. Beam theory integrates 12/(E b t(x)³); in truth stress cannot
    follow so fast a change of the section.""")
    page.section("Source and reference")
    page.text("""Paros and Weisbord (Machine Design 37, 1965) for the integral in closed form;
    Smith's fit to finite elements, θ/M = 24 K R/(E b t³), K = 0.565 t/R + 0.166 (*Foundations of
    Ultraprecision Mechanism Design*, 1992), good to a per cent or two for t/R from 0.2 to 0.6.""")
    page.section("Rotation per moment")
    worst, near, rows = 0.0, 0.0, []
    chosen = [modeling("linear"), modeling("exact", tolerance=1e-11),
              modeling("beam", "beam_400", elements=400, order=3),
              modeling("continuum", ends="contracting", tolerance=1e-7)]
    for t in (0.4, 1.0, 1.6, 2.0, 2.4):
        changed = {**model, "parameters": {"t": t}}
        moment = 1e-4 * t**3
        study = {**runs.study(model, "bend", modelings=chosen), "estimate": False,
                 "loads": [{"on": "tip", "moment": moment}]}
        turn = {label: run.table()[-1]["tip.rotation"] / moment
                for label, run in flexura.run(changed, study).items()}
        closed, fit = paros(t, 4.0), smith(t, 4.0)
        worst = max(worst, relative(turn["linear"], closed), relative(turn["exact"], closed))
        if 1.0 <= t <= 2.0:
            near = max(near, relative(turn["continuum"], fit))
        rows.append([f"{t / 4:.2g}", scientific(relative(turn["linear"], closed)),
                     scientific(relative(turn["exact"], closed)),
                     scientific(relative(turn["beam_400"], closed)),
                     share(turn["exact"] / fit - 1), share(turn["continuum"] / fit - 1),
                     share(turn["exact"] / turn["continuum"] - 1)])
    page.table(["t/R", "`linear` from Paros and Weisbord", "`exact`", "`beam`, 400 elements",
                "`exact` from Smith", "`continuum`", "`exact` from `continuum`"], rows)
    page.promise("rotation against the closed form", "linear, exact", worst, 1e-9)
    page.promise("rotation against Smith's fit, t/R from 0.25 to 0.5", "continuum", near, 2e-2)
    page.text("""So a notch is softer than the beam with its profile, the more the thicker it is:
    take `continuum` where that matters. Smith's fit is not meant for t/R = 0.1. At 0.6, where its
    range ends, it and the continuum are further apart than the per cent or two that is said of it;
    which of the two is off there, this page cannot say: the fit is the only outside value.""")
    return page
