#include "flexura/io/starter.hpp"

namespace flexura {

std::string starter_model() {
  return R"(# A Flexura model: a stage on two parallel leaf flexures. Make it your own.
#
#   flexura check FILE     every mistake with its line and column
#   flexura run FILE       results as tables, pictures and report.html
#
# docs/model_file.md lists every key.
flexura = 1
title = "Parallel-leaf stage"

[units]                    # plain numbers below are in these; results come out in them
length = "mm"
force = "N"
time = "s"
# angle = "deg"            # plain angles are radians otherwise

[parameters]               # names for expressions; `flexura run FILE --set t=0.4` changes one
t = 0.3                    # thickness of the leaves
height = "40 mm"           # any quantity may be a text with its own unit ..
half = "= 30/2"            # .. or an expression of parameters

[materials.steel]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
# density = "7850 kg/m^3"

[sections.leaf]
rectangle = { thickness = "= t", width = 10 }  # thickness lies in the plane of motion
# circle = { diameter = .. }
# general = { area = .., second_moment = .., shear_area = .., depth = .. }

[bodies.ground]
fixed = true

[bodies.stage]             # rigid; moves and turns as its flexures let it
points = { P = [0, "= height + 5"] }

# A flexure joins two bodies: the first is its base, the second follows. Its ends are clamped
# to them; pinned = ["stage"] would hinge one. Bodies are rigid however far they reach.
[flexures.left]
between = ["ground", "stage"]
axis = { line = [["= -half", 0], ["= -half", "= height"]] }
material = "steel"
section = "leaf"
# axis = { arc = { centre = [0, 3], radius = 3, start = "-90 deg", sweep = "-240 deg" } }
# axis = { spline = [[0, 0], [1, 2], [3, 3]], start_tangent = [0, 1] }

[flexures.right]
between = ["ground", "stage"]
axis = { line = [["= half", 0], ["= half", "= height"]] }
material = "steel"
section = "leaf"

# Compliance matrices and ellipses of elasticity about the drawn state.
[studies.ellipse]
kind = "linear"
loads = [{ on = "stage.P", force = [1, 0] }]

# Push the stage sideways in 20 steps, by several modelings at once.
[studies.push]
kind = "path"
loads = [{ on = "stage.P", force = [10, 0] }]
steps = 20
modelings = ["linear", "scmbm", "prbm", "exact"]
# a modeling with settings: { name = "beam", elements = 16, order = 2, label = "fine" }

# Natural frequencies, once the material above has its density.
# [studies.sing]
# kind = "modes"
# about = { study = "push", load_factor = 1.0 }  # without it, of the stage as drawn
# modelings = ["exact"]
)";
}

}  // namespace flexura
