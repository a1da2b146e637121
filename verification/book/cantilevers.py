"""Straight cantilevers: the elastica under a tip force, and rolled up by a moment."""

import math

import measure
import runs
from measure import TWICE, beam_sweep, convergence, modeling_table, named_sweep, path_error
from pages import Page, scientific
from pictures import picture
from plots import Series, plot
from runs import modeling

TIP = [("tip.x", "x_tip/L"), ("tip.y", "deflection w/L")]
MATTIASSON = [(1, 0.30172, 0.05643), (2, 0.49346, 0.16064), (5, 0.71379, 0.38763),
              (10, 0.81061, 0.55500)]
THEORIES = {"i": "i", "ii": "ii (EI/(EA L^2)=1e-4)",
            "iii": "iii (EI/(EA L^2)=1e-4, EI/(GAs L^2)=3.24e-4)"}


def all_modelings():
    return [modeling("linear"), modeling("scmbm"), modeling("prbm"),
            modeling("prbm", "prbm_su", parameters="su"),
            modeling("prbm", "prbm_howell", parameters="howell"),
            modeling("bcm"), modeling("bcm", "bcm_8", elements=8),
            modeling("beam", "von_karman", theory="von_karman"), modeling("beam"),
            modeling("beam", "beam_order_4", elements=8, order=4, tolerance=1e-11),
            modeling("exact")]


def theories_table(page, flexura, model):
    rows, worst = [], 0.0
    for theory, name in THEORIES.items():
        settings = {"tolerance": 1e-11, "axial": theory != "i", "shear": theory == "iii"}
        found = flexura.run(model, runs.study(
            model, "push", modelings=[modeling("exact", **settings)]))["exact"].table()
        truth = runs.reference_table("static/C_cantilever_tip_load.csv", theory=name)
        place = path_error(found, truth, TIP)
        turn = max(abs(a["tip.rotation"] - b["tip_rotation_rad"]) for a, b in zip(found, truth))
        worst = max(worst, place, turn)
        rows.append([theory, scientific(place), scientific(turn)])
    page.table(["theory", "place of the tip", "its rotation, rad"], rows)
    page.promise("tip over 41 loads, three theories", "exact", worst, 1e-10)


def mattiasson_table(page, flexura, model):
    settings = modeling("exact", axial=False, shear=False)
    found = flexura.run(model, runs.study(model, "push", modelings=[settings]))["exact"].table()
    rows, worst = [], 0.0
    for alpha, deflection, shortening in MATTIASSON:
        row = found[4 * alpha]
        off = max(abs(row["tip.y"] - deflection), abs(1.0 - row["tip.x"] - shortening))
        worst = max(worst, off)
        rows.append([alpha, f"{deflection:.5f}", f"{row['tip.y']:.8f}", f"{shortening:.5f}",
                     f"{1.0 - row['tip.x']:.8f}"])
    page.table(["P L²/EI", "w/L printed", "ours", "u/L printed", "ours"], rows)
    page.promise("Mattiasson's table, five digits", "exact", worst, 5e-6)


def tip_load(flexura):
    page = Page("tip_load", "Cantilever under a tip force", ["verification/cases/tip_load.toml"])
    model = runs.load_model(page.models[0])
    study = runs.study(model, "push")
    truth = runs.reference_table("static/C_cantilever_tip_load.csv", theory=THEORIES["iii"])
    found = flexura.run(model, runs.study(model, "push", modelings=all_modelings()), repeat=3)
    page.text("""A straight beam of length L, clamped at one end, carries a dead force P across the
    other, which grows to P L²/EI = 10 in 40 steps. The tip comes down by four fifths of the length
    and turns by 82 degrees. With EI/(EA L²) = 1e-4 and EI/(GA_s L²) = 3.24e-4 the beam also
    stretches and shears, by little.""")
    page.figure("picture", "Drawn, and under the full force",
                picture(model, found["exact"], study["loads"]))
    page.section("Source and reference")
    page.text("""The inextensible problem is Bisshopp and Drucker's (Q. Appl. Math. 3, 1945).
    Reference: [an independent solution](../../tests/data/reference/static/README.md) of the beam's
    differential equations in multiple precision (Taylor series and shooting), equal to the elliptic
    integrals in 33 digits, for three theories: inextensible (i), with axial strain (ii), with axial
    and shear strain (iii). Besides, Mattiasson's printed table (Int. J. Num. Meth. Eng. 17 (1981)
    145).""")
    page.section("The elastica")
    theories_table(page, flexura, model)
    mattiasson_table(page, flexura, model)
    page.section("Modelings")
    page.text("""Against theory iii: largest distance of the tip over the 40 loads, by its largest
    displacement.""")

    def error_of(run):
        return path_error(run.table(), truth, TIP)

    modeling_table(page, found, error_of)
    growth(page, found, truth)
    page.text("""Howell's pseudo-rigid-body model and Su's are fitted over large deflections and
    are not right for small ones; equal springs and `bcm` are right there and drift off. `bcm` is
    made for deflections up to a tenth of the length. `linear` knows nothing of the shortening.
    `prbm` and `bcm` have no shear strain, and `prbm` does not stretch: by that alone they are
    off by a little. The estimate of `beam_order_4` is far above its error: whatever the mesh,
    estimates of `beam` do not fall below that on this path. They err on the safe side.""")
    sweeps = measure.standard_sweeps() + [
        named_sweep("von_karman", [2, 4, 8, 16, 32, 64], name="beam", theory="von_karman")]
    convergence(page, measure.run_sweeps(flexura, model, study, sweeps, error_of),
                "the tip, theory iii", {**TWICE, "von_karman": "2"})
    return page


def growth(page, found, truth):
    """How the errors of the simple modelings grow with the load."""
    series = []
    simple = ["linear", "scmbm", "prbm", "prbm_su", "prbm_howell", "bcm", "bcm_8", "von_karman"]
    for k, label in enumerate(simple):
        points = []
        for row, b in list(zip(found[label].table(), truth))[1:]:
            apart = math.hypot(row["tip.x"] - b["x_tip/L"], row["tip.y"] - b["deflection w/L"])
            points.append((b["alpha=PL2/EI"], max(apart, 1e-9)))
        series.append(Series(label, points, "line", k + 1))
    page.figure("growth", "Distance of the tip from the truth, in lengths, against the load",
                plot(series, "P L²/EI", "distance/L", True, True))


def roll_up(flexura):
    page = Page("roll_up", "Cantilever rolled up by an end moment",
                ["verification/cases/roll_up.toml"])
    model = runs.load_model(page.models[0])
    truth = runs.reference_table("static/C_rollup_end_moment.csv")
    columns = [("tip.x", "x_tip/L"), ("tip.y", "y_tip/L")]
    chosen = [modeling("linear"), modeling("scmbm"), modeling("prbm"),
              modeling("prbm", "prbm_su", parameters="su"), modeling("bcm", "bcm_8", elements=8),
              modeling("bcm", "bcm_64", elements=64), modeling("beam"),
              modeling("beam", "beam_order_4", elements=16, order=4, tolerance=1e-11),
              modeling("exact")]
    found = flexura.run(model, runs.study(model, "roll", modelings=chosen), repeat=3)
    page.text("""A moment M at the end of a straight cantilever bends it to an arc of a circle of
    radius EI/M: one full circle at M L/EI = 2π, two at 4π. There is no force anywhere, so axial and
    shear stiffness do not matter.""")
    page.figure("picture", "Drawn, and rolled up twice", picture(
        model, found["exact"], [{"on": "tip", "moment": 1.0}]))
    page.section("Source and reference")
    page.text("""Closed form: tip at (sin φ, 1 − cos φ)/φ with φ = M L/EI, tabulated in
    [the reference data](../../tests/data/reference/static/README.md) at 41 loads.""")
    page.section("Modelings")

    def error_of(run):
        return path_error(run.table(), truth, columns)

    modeling_table(page, found, error_of)
    page.promise("tip over two turns", "exact", error_of(found["exact"]), 1e-10)
    stopped = [f"`{label}`: {run.summary['reason']}" for label, run in found.items()
               if not run.converged]
    page.text("""Bending is constant along the beam, which `exact` has with the fewest modes that
    it takes. Chains of rigid segments (`prbm`) cannot follow a full turn, and are not meant to."""
              + ("\n" + " ".join(stopped) if stopped else ""))
    sweeps = [beam_sweep(1, [4, 8, 16, 32, 64, 128, 256]), beam_sweep(2, [4, 8, 16, 32, 64]),
              beam_sweep(3, [4, 8, 16, 32]), beam_sweep(5, [2, 4, 8, 16]),
              named_sweep("bcm chain", [8, 16, 32, 64, 128], name="bcm"),
              named_sweep("von_karman", [16, 32, 64, 128], name="beam", theory="von_karman")]
    convergence(page, measure.run_sweeps(flexura, model, runs.study(model, "roll"), sweeps,
                                         error_of), "the tip",
                {**TWICE, "von_karman": "2", "bcm chain": "3"})
    return page
