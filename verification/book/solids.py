"""The plane continuum where theory of elasticity has an answer: the thick curved bar."""

import math

import measure
import runs
from measure import Sweep, convergence, relative
from pages import Page, scientific, share, times
from pictures import picture
from runs import modeling


def golovin(a, b, moment, modulus=2100.0):
    """Turn of a quarter ring of radii a, b and unit width (Timoshenko and Goodier, art. 29)."""
    squares = b * b - a * a
    n = squares**2 - 4 * a * a * b * b * math.log(b / a) ** 2
    return 8 * moment * squares / (modulus * n) * 0.5 * math.pi


def turn(run):
    return run.table()[-1]["tip.rotation"]


def thick_ring(flexura):
    page = Page("thick_ring", "Thick curved bar", ["verification/cases/thick_ring.toml"])
    model = runs.load_model(page.models[0])
    page.text("""A quarter ring of radii 2 and 4 mm is bent by a moment, by so little that
    displacements are small. Sections stay plane, but the stress over them is a hyperbola, not a
    line.""")
    page.figure("picture", "The axis of the bar", picture(model))
    page.section("Source and reference")
    page.text("""Golovin's exact solution of plane elasticity (1881; Timoshenko and Goodier,
    *Theory of Elasticity*, art. 29): it turns by 4π M (b² − a²)/(E w N),
    N = (b² − a²)² − 4 a² b² ln²(b/a).""")
    truth = golovin(2.0, 4.0, 1e-5)
    chosen = [modeling("linear"), modeling("prbm"), modeling("beam"), modeling("exact"),
              modeling("continuum", "default", ends="contracting"),
              modeling("continuum", "order_8", ends="contracting", elements=8, across=2, order=8),
              modeling("continuum", "rigid_ends")]
    found = flexura.run(model, runs.study(model, "bend", modelings=chosen, estimate=False))
    page.section("Modelings")
    basis = found["exact"].summary["seconds"]
    page.table(["modeling", "turn, rad", "error", "unknowns", "cost by `exact`"], [
        [f"`{label}`", f"{turn(run):.10e}", share(relative(turn(run), truth)),
         run.summary["unknowns"], times(run.summary["seconds"] / basis)]
        for label, run in found.items()] + [["Golovin", f"{truth:.10e}", "", "", ""]])
    page.promise("turn against Golovin", "continuum", relative(turn(found["order_8"]), truth), 1e-7)
    thinner(page, flexura, model)
    page.text("""Beams of EA and EI about the centroid axis are off by an effect of second order in
    h/R, stiff ends by one of ν² h/L.""")
    order_of_elements(page, flexura, model)
    return page


def thinner(page, flexura, model):
    rows = []
    for thickness in (2.0, 1.0, 0.5, 0.25, 0.125):
        section = {"bar": {"rectangle": {"thickness": thickness, "width": 1}}}
        truth = golovin(3 - thickness / 2, 3 + thickness / 2, 1e-5 * thickness**3)
        study = runs.study(model, "bend", estimate=False, loads=[
            {"on": "tip", "moment": 1e-5 * thickness**3}],
            modelings=[modeling("exact"), modeling("continuum", ends="contracting", elements=8,
                                                   across=2, order=6)])
        found = flexura.run({**model, "sections": section}, study)
        rows.append([f"{thickness / 3:.3g}", share(turn(found["exact"]) / truth - 1),
                     scientific(relative(turn(found["continuum"]), truth))])
    page.table(["h/R", "`exact` from Golovin", "`continuum`"], rows)


def order_of_elements(page, flexura, model):
    def sweep(order, sizes):
        return Sweep(f"continuum order {order}", sizes, lambda n: {
            "name": "continuum", "elements": 2 * n, "across": n, "order": order,
            "ends": "contracting"})

    study = runs.study(model, "bend", loads=[{"on": "tip", "moment": 10.0}])
    finest = flexura.run(model, {**study, "estimate": False, "modelings": [modeling(
        "continuum", elements=10, across=3, order=8, ends="contracting")]})["continuum"]
    truth = turn(finest)
    page.text("""The series below is under a moment of 10 N mm, far above rounding, against order 8
    on 10 by 3 elements.""")
    sweeps = [sweep(1, [2, 4, 8, 16, 32]), sweep(2, [1, 2, 4, 8, 16]), sweep(3, [1, 2, 4, 8]),
              sweep(4, [1, 2, 4])]
    convergence(page, measure.run_sweeps(flexura, model, study, sweeps,
                                         lambda run: relative(turn(run), truth)), "the turn",
                {f"continuum order {p}": str(2 * p) for p in (1, 2, 3, 4)})
