"""Motion in time: the step response of the compliant four-bar, the spin-up of a beam."""

import math

import runs
from pages import Page, scientific, share, times
from plots import Series, plot
from runs import modeling

FRAME = "examples/compliant_four_bar_dynamics.toml"


def coupler_middle(run):
    return [(r["coupler.mid.x"] - 0.2, r["coupler.mid.y"] - 0.7) for r in run.table()]


def history_difference(found, truth):
    """Along x and y: largest difference by the largest value of the truth."""
    pairs = list(zip(found, truth))
    return tuple(max(abs(a[i] - b[i]) for a, b in pairs) / max(abs(b[i]) for _, b in pairs)
                 for i in (0, 1))


def history_study(model, method, seconds, modelings, **settings):
    return {"kind": "transient", "duration": seconds, "outputs": round(seconds / 5e-3),
            "loads": model["studies"]["step_response"]["loads"], "method": method,
            "estimate": False, "modelings": modelings, **settings}


def frame_history(flexura):
    page = Page("frame_history", "Step response of the compliant four-bar", [FRAME])
    model = runs.load_model(FRAME)
    rows = runs.reference_table("dynamics/case4_frame_nonlinear_history.csv")
    table = [(0.0, 0.0)] + [(r["ux"], r["uy"]) for r in rows]
    page.text("""0.28 N act suddenly on the upper left corner of the frame, which then swings for
    good: nothing damps it. Displacements are those of the coupler's middle. Runs here are of one
    second (the reference has five).""")
    page.section("Source and reference")
    page.text("""The first source's figures 11 and 12. Reference: [an independent
    history](../../tests/data/reference/dynamics/README.md), cubic elements and the midpoint rule
    with steps of 6.25e-4 s, which states an accuracy of 1e-4 (x) and 2e-3 (y).""")
    exact = modeling("exact", modes=8)
    same = modeling("beam", elements=4, order=3)
    found = flexura.run(model, history_study(model, "radau", 1.0, [
        exact, modeling("beam", "beam_order_5", elements=3, order=5),
        modeling("beam", "timoshenko", theory="timoshenko", elements=4),
        modeling("exact", "exact_no_shear", modes=8, shear=False)], tolerance=1e-6))
    truth = coupler_middle(found["exact"])
    copied = flexura.run(model, history_study(model, "energy_momentum", 1.0, [same],
                                              step=6.25e-4))["beam"]
    page.section("Comparisons")
    off = {"the reference, from `exact` (8 modes, `radau`)": history_difference(table, truth),
           "`beam` of order 5, from `exact`": history_difference(
               coupler_middle(found["beam_order_5"]), truth),
           "linear theory (`timoshenko`), from `exact`": history_difference(
               coupler_middle(found["timoshenko"]), truth),
           "without shear and rotary inertia, from `exact`": history_difference(
               coupler_middle(found["exact_no_shear"]), truth),
           "the reference's own discretisation in Flexura, from the reference":
               history_difference(coupler_middle(copied), table)}
    for step in (1.25e-3, 6.25e-4, 3.125e-4):
        run = flexura.run(model, history_study(model, "energy_momentum", 1.0, [exact],
                                               step=step))["exact"]
        off[f"`exact` by the midpoint rule, steps of {step:g} s, from `radau`"] = (
            history_difference(coupler_middle(run), truth))
    page.table(["over one second", "along x", "along y"],
               [[name, share(x), share(y)] for name, (x, y) in off.items()])
    own = list(off.values())[4]
    page.promise("the reference by its own discretisation, along x", "beam", own[0], 1e-4)
    page.promise("the reference by its own discretisation, along y", "beam", own[1], 2e-3)
    agreed = list(off.values())[1]
    page.facts.update({name: f"{share(off[name][0])} along x, {share(off[name][1])} along y"
                       for name in off})
    page.promise("two discretisations by `radau`, along x", "exact, beam", agreed[0], 1e-4)
    page.text("""**The reference is off, not Flexura.** Its own discretisation, in Flexura, gives
    its figures; modal beams and high-order elements by an integrator of order 5 agree on another
    history. What lies between is the phase of the higher modes by the midpoint rule: half the
    step, a third of it. The accuracy that the reference states holds for its mesh and its step.""")
    history_plots(page, found, copied, truth, table)
    return page


def history_plots(page, found, copied, truth, table):
    times_of = [r["time"] for r in found["exact"].table()]
    page.figure("history", "Displacement of the coupler's middle along y", plot(
        [Series("exact", list(zip(times_of, [y for _, y in truth])), "line", 1)],
        "time, s", "y, m"))
    largest = max(abs(y) for _, y in truth)
    others = [("reference", table, 2), ("same in Flexura", coupler_middle(copied), 5),
              ("beam order 5, radau", coupler_middle(found["beam_order_5"]), 1)]
    page.figure("difference", "How far others are from `exact` along y, by its largest", plot(
        [Series(name, [(t, (a[1] - b[1]) / largest) for t, a, b in zip(times_of, rows_, truth)],
                "thick" if k == 0 else "line", colour)
         for k, (name, rows_, colour) in enumerate(others)], "time, s", "difference"))


def seen_from_hub(row):
    t = row["time"]
    w = 2 * math.pi / 15
    psi = 6 * t - 45 if t >= 15 else 0.4 * (t * t / 2 + (math.cos(w * t) - 1) / (w * w))
    x, y = row["tip.x"], row["tip.y"]
    return (math.cos(psi) * x + math.sin(psi) * y - 10, math.cos(psi) * y - math.sin(psi) * x,
            row["tip.rotation"] - psi)


def spin_study(modelings, **settings):
    return {"kind": "transient", "duration": 20, "outputs": 200, "estimate": False,
            "modelings": modelings, **settings}


def spin_up(flexura):
    page = Page("spin_up", "Spin-up of a flexible beam", ["examples/spin_up.toml"])
    model = runs.load_model(page.models[0])
    page.text("""A beam of length 10 is turned about one end, from rest to 6 rad/s within 15 s. It
    bends back by up to 0.57, is straightened by its centrifugal force, and swings about a shape a
    little longer than drawn.""")
    page.section("Source and reference")
    page.text("""Simo and Vu-Quoc (J. Appl. Mech. 53 (1986) 855), EI = 1.4e4, EA = 2.8e7, GA = 1e7,
    1.2 per length. Reference: [an independent
    solution](../../tests/data/reference/dynamics/README.md), right to 2e-8; the steady extension in
    closed form.""")
    truth = [(r["u1_axial"], r["u2_transverse"], r["alpha_rel_rotation"])
             for r in runs.reference_table("dynamics/case5_spinup_tip.csv")]
    chosen = [modeling("bcm", "bcm_4", elements=4),
              modeling("beam", "timoshenko", theory="timoshenko", elements=8),
              modeling("beam", "beam_two_node", elements=16),
              modeling("beam", "beam_order_3", elements=8, order=3),
              modeling("exact", "exact_4", modes=4), modeling("exact", modes=8)]
    found = flexura.run(model, spin_study(chosen, tolerance=1e-7))
    page.section("Modelings")
    rows, basis = [], found["exact"].summary["seconds"]
    for label, run in found.items():
        if not run.converged:
            rows.append([f"`{label}`", "stopped", "", "", "", "", ""])
            continue
        off = tip_errors(run, truth)
        rows.append([f"`{label}`", *map(scientific, off), run.summary["unknowns"],
                     run.summary["steps"], times(run.summary["seconds"] / basis)])
    page.table(["modeling", "axial", "transverse", "rotation, rad", "unknowns", "steps",
                "cost by `exact`"], rows)
    off = tip_errors(found["exact"], truth)
    page.promise("deflection of the tip over 20 s, by its largest", "exact", off[1] / 0.574, 1e-6)
    page.promise("steady extension, absolute", "exact", steady(page, flexura, model), 2e-9)
    page.text("""Largest differences over 200 times. The linear theory (`timoshenko`) is about the
    drawn state and knows neither large turns nor centrifugal stiffening: it is not for this.""")
    spin_plot(page, found, truth)
    integrators(page, flexura, model, truth)
    return page


def tip_errors(run, truth):
    pairs = list(zip(map(seen_from_hub, run.table()[1:]), truth))
    return [max(abs(a[i] - b[i]) for a, b in pairs) for i in range(3)]


def steady(page, flexura, model):
    k = 6 * math.sqrt(1.2 / 2.8e7)
    truth = math.tan(10 * k) / k - 10
    run = flexura.run(model, {**spin_study([modeling("exact", modes=6)], tolerance=1e-7),
                              "duration": 40, "outputs": 40,
                              "damping": {"stiffness": 0.1}})["exact"]
    found = seen_from_hub(run.table()[-1])[0]
    page.text(f"""Steady extension, with the swinging damped out: {found:.10e}; closed form
    tan(kL)/k − L = {truth:.10e}.""")
    return abs(found - truth)


def spin_plot(page, found, truth):
    series = [Series("reference", [(0.1 * (k + 1), b[1]) for k, b in enumerate(truth)], "thick", 0)]
    series += [Series(label, [(r["time"], seen_from_hub(r)[1]) for r in found[label].table()],
                      "line", k + 1) for k, label in enumerate(["exact", "beam_two_node"])]
    page.figure("tip", "Deflection of the tip across the turning line",
                plot(series, "time, s", "deflection"))


def integrators(page, flexura, model, truth):
    page.section("Convergence")
    page.text("Of the integrators, by `exact` with 8 modes and fixed steps.")
    series, rows = [], []
    for k, (method, steps) in enumerate({"radau": [0.1, 0.05, 0.025],
                                         "generalized_alpha": [0.04, 0.02, 0.01],
                                         "energy_momentum": [0.04, 0.02, 0.01]}.items()):
        points = []
        for step in steps:
            run = flexura.run(model, spin_study([modeling("exact", modes=8)], method=method,
                                                step=step))["exact"]
            points.append((step, tip_errors(run, truth)[1] / 0.574))
        series.append(Series(method, points, "marks", k + 1))
        order = math.log(points[0][1] / points[1][1]) / math.log(points[0][0] / points[1][0])
        rows.append([f"`{method}`", f"{points[-1][0]:g}", scientific(points[-1][1]),
                     f"{order:.2f}"])
    page.figure("steps", "Error of the deflection over the time step",
                plot(series, "step, s", "error", True, True))
    page.table(["method", "finest step", "its error", "observed order"], rows)
    page.text("""Orders are those of the two coarser steps. `radau` is of order 5 for what its steps
    resolve, and here meets the reference's own 2e-8 and the modes' share at once.""")
