"""The page of findings on the three sources, its figures from the pages and from runs."""

import runs
from pages import Page, share
from runs import modeling

FOUR_BAR = "[compliant four-bar](compliant_four_bar.md)"
PRINTED = "[as printed](printed_elements.md)"


def tests(*names):
    return "(tests " + ", ".join(f"`{name}`" for name in names) + ", [figures](tests.md))"


def measured(record, test, key):
    """The largest of the figures that tests of this name recorded as `key`."""
    found = [float(entry[key]) for suite in record["testsuites"] for entry in suite["testsuite"]
             if test in f"{suite['name']}.{entry['name']}" and key in entry]
    return max(found)


def first_source(page, pages, record):
    frame, printed = pages["compliant_four_bar"].facts, pages["printed_elements"].facts
    page.section("The first source: elements for compliant mechanisms")
    page.text(""""An Effective Finite Element Method for Beam Based Compliant Mechanism". More in
    [printed elements](../printed_elements.md) and
    [motion](../motion.md#findings-on-the-first-source-and-its-reference).""")
    page.table(["what it says", "what holds", "shown by"], [
        ["quintic interpolation, eq. 35 d", "misprinted powers; 10 x³ − 15 x⁴ + 6 x⁵",
         f"{PRINTED}: equal to an independent assembly of the corrected one"],
        ["linear u under a quintic w, eq. 30", f"locks: {printed['missing 1']} of the sway missing "
         f"with one element a link, {printed['off 16']} off with 16; with the same nodes and a "
         f"u that gives way {printed['von_karman 16']}", PRINTED],
        ["strains in axes fixed to the drawn member, eqs. 14 to 19",
         f"for small rotations only: a false limit load at {printed['limit']}; the true frame "
         "carries 28 N and stiffens", f"{PRINTED} "
         + tests("PrintedBeam.HasAFalseLimitLoad")],
        ["shear angle as an unknown of its own, eq. 21", "occurs in the shear energy alone, so it "
         "takes that energy out: the elements are Euler and Bernoulli's",
         "[derivation](../printed_elements.md#what-that-does); `shear` has no effect on `printed`"],
        ["shear factor q = 6/5", "5/6; could it act, 6/5 would hide 1 − 25/36 of the shear",
         tests("PrintedBeam.ItsShearFactorWouldHideAThirdOfTheShear")],
        ["a nonlinear element is needed at 0.28 N", f"for the drop of the corners, which is all of "
         f"the {frame['linear 0.28']} that the linear theory is off; at 5.6 N it is off by "
         f"{frame['linear 5.6']}", FOUR_BAR],
        ["shear matters on this frame", f"by {frame['exact_no_shear 0.28']}", FOUR_BAR],
        ["derivatives need not be written by hand", "yes: automatic differentiation of the energy",
         "[a new element](../new_element.md)"]])
    history(page, pages, record)


def history(page, pages, record):
    modes = pages["frame_frequencies"].facts
    page.text("""**Euler and Bernoulli's frame runs ahead of Timoshenko's**
    ([frequencies](frame_frequencies.md)). So over the 25 s of the source's figures 11 and 12
    histories by the two theories agree in shape, and in phase in the first mode alone.""")
    page.table(["mode", "with shear and rotary inertia, rad/s", "without", "ahead after 25 s, rad"],
               [[name.split()[1], *cells] for name, cells in modes.items()])
    off = pages["frame_history"].facts
    far = [measured(record, "TheReferenceIsItsTimeStepOff", f"reference_{axis}") for axis in "xy"]
    names = list(off)
    page.text(f"""**The history to compare with claims more than it holds**
    ([step response](frame_history.md)). It states 1e-4 along x and 2e-3 along y. Its own
    discretisation in Flexura differs from it by {off[names[4]]} over the first second. Its
    distance from the converged solution is {off[names[0]]}, while two other discretisations agree
    on that to {off[names[1]]}. So it is right for its mesh and its time step, and not beyond;
    over all 5 s it is {share(far[0])} off along x and {share(far[1])} along y
    {tests("FrameHistory.ConvergedSolutionsAgreeAndTheReferenceIsItsTimeStepOff")}.""")


def second_source(page, pages):
    facts = pages["arc_chain"].facts
    page.section("The second source: discrete modelings")
    page.text(""""Testings of discrete modelings of planar compliant mechanisms through flexible
    multibody simulations". More in [the continuum](../continuum.md#the-second-sources-comparison)
    and [pseudo-rigid-body models](../prbm.md).""")
    page.table(["E on [the arc chain](arc_chain.md), against the continuum", "load cases 1 to 3",
                "load case 4, + and −"],
               [[f"`{n}`", facts[n], facts[f"{n} lc4"]]
                for n in ("linear", "scmbm", "prbm", "exact")])
    page.text("""- **PRBM and SCMBM are near the full model** in load cases 1 to 3; in load case
    4, along the stiffest direction, neither is.
    - **Its full model of minutes is not needed**: `exact` is the continuum to a few 1e-4 here, at
    a cost that the arc chain's page gives.
    - **What it leaves open**: the loaded point and Poisson's ratio. Table 1's abscissa 9.093 is
    rounded: 9.093267 would make a link exactly 4 mm long. Both are ours to choose, and its
    printed paths cannot be compared to more than a reading.
    - **Where the compliance matrix is taken matters** as much as the method: at the elastic
    centre SCMBM is several times better than at the flexure's end.
    - **No chain of three springs is right to second order.** Matching the ellipse leaves one free
    number, and the best it can do is three equal springs
    ([derivation](../prbm.md#equal-springs-derivation)).""")


def prbm(page, flexura):
    page.section("Published pseudo-rigid-body models")
    model = runs.load_model("verification/cases/roll_up.toml")
    bent = {"kind": "path", "loads": [{"on": "tip", "moment": 0.25}], "steps": 4, "modelings": [
        modeling("exact"), *(modeling("prbm", label, parameters={
            "lengths": [0.2654, 0.7346], "stiffness": [spring]})
            for label, spring in (("as_k", 0.7346 * 1.5164), ("as_spring", 1.5164)))]}
    found = {label: run.table()[-1] for label, run in flexura.run(model, bent).items()}

    def off(label):
        a, b = found[label], found["exact"]
        return (((a["tip.x"] - b["tip.x"])**2 + (a["tip.y"] - b["tip.y"])**2)
                / ((b["tip.x"] - 1)**2 + b["tip.y"]**2))**0.5

    load = 1e-3
    soft = {"kind": "path", "loads": [{"on": "tip", "force": [0, load]}], "steps": 1,
            "modelings": [modeling("prbm", "howell", parameters="howell"),
                          modeling("prbm", "su", parameters="su"), modeling("prbm", "equal")]}
    stiff = {label: load / run.table()[-1]["tip.y"]
             for label, run in flexura.run(model, soft).items()}
    page.text(f"""- **1.5164 is the spring, not K_θ.** Some sources list it as K_θ for an end
    moment. With γ K_θ = 1.114 EI/L for the spring the end of a cantilever that is turned by a
    quarter of a radian is {share(off('as_k'))} off; with 1.5164 EI/L it is
    {share(off('as_spring'))}.
    - **Howell's and Su's models do not tend to the linear compliance**: for a small transverse
    force the stiffness is {stiff['howell']:.4g} and {stiff['su']:.4g} EI/L³, where equal springs
    have {stiff['equal']:.4g} and the truth is 3. They are fitted over large deflections
    ([tip load](tip_load.md)).
    - **A loop of three one-joint members does not move**: Howell's model for a cantilever is no
    model of a frame clamped at both ends ([compliant four-bar](compliant_four_bar.md)). Flexura
    takes the model and says nothing.""")


def third_source(page, pages, flexura):
    facts = pages["turcic_midha"].facts
    page.section("The third source: elastic linkages")
    page.text("""Turcic and Midha, "Dynamic Analysis of Elastic Mechanism Systems". More in
    [linkages](../linkages.md#findings-on-the-third-source).""")
    speeds = ", ".join(f"{off} % at {rpm} rpm" for off, rpm in facts["speeds"])
    page.text(f"""- **Linear theory (KED) fails below the speed at which the source runs its
    four-bar** ([the four-bar](turcic_midha.md)): strains are off by {speeds}.
    - **Continuity has to act on displacements.** Modes 1 and 2 veer twice in a turn; modal
    coordinates carried over by themselves give an answer that is {facts['modal 4']} off,
    displacements and velocities carried over one that is {facts['physical 4']} off, and more
    modes hardly help ({facts['physical 8']} with 8)
    {tests("FourBarMethods.MidhaConvergesToAPlateau")}.
    - **Its frequencies are in rad/s**: the bands over the turn, times 2π, fit the axes of its
    figures.""")
    punching(page, flexura)


def punching(page, flexura):
    model = runs.load_model("examples/punching_machine.toml")
    results = flexura.folder(model, {"case": runs.study(model, "idle")})
    summary = runs.json.loads((results / "summary.json").read_text())["studies"]["case"]
    peaks = {name: entry["peaks"] for name, entry in summary["modelings"].items()}

    def stress(method, link):
        return peaks[method][link]["stress"]["value"]

    ratios = ", ".join(f"{stress('periodic', link) / stress('quasi_static', link):.2g}"
                       for link in ("crank", "coupler", "follower"))
    bend = abs(peaks["periodic"]["coupler"]["deflection"]["value"]) / 7.0
    page.text(f"""- **The punching machine's second moment is garbled in print**; 5 in by 0.167
    in, I = 1.94e-3 in⁴, fits. At 5000 rpm vibration raises the largest stress of crank, coupler
    and plate to {ratios} times the quasi-static one, and the coupler deflects by {100 * bend:.2g}
    % of its length: linear theory is beyond its range there, and the command says so.""")


def beyond(page, pages, record):
    facts, columns = pages["cantilever_frequencies"].facts, "[columns](columns.md)"
    page.section("Other references, and Flexura itself")
    tapered = measured(record, "AbaqusTaperedFrequencies", "abaqus")
    page.text(f"""- **Published frequencies of cantilevers are Euler and Bernoulli's** without
    rotary inertia, to {facts['abaqus']} ([cantilevers](cantilever_frequencies.md)); with both the
    sixth lies {facts['sixth']} lower.
    - **Those of tapered cantilevers** lie {tapered:.1e} from ours, on which our modelings agree:
    how the taper was meshed is not stated {tests("AbaqusTaperedFrequencies")}.
    - **The parallelogram's solid elements** lie between beam and plate, as leaves ten times as
    wide as thick do ([parallelogram](parallelogram.md)).
    - **Flexura: buckling of columns drawn along y** is good to 1e-6 where those along x have
    1e-12 ({columns}).
    - **Flexura: buckling by many von Karman elements** finds no load where there is one
    ({columns}).""")


def findings(flexura, pages, record):
    page = Page("findings", "Findings on the sources")
    page.text("""What three sources print, what of it holds and what does not; figures are those
    of the pages of this book, made by the same run.""")
    first_source(page, pages, record)
    second_source(page, pages)
    prbm(page, flexura)
    third_source(page, pages, flexura)
    beyond(page, pages, record)
    return page
