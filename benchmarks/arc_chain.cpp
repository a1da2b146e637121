#include "arc_chain.hpp"

#include <numbers>

namespace flexura::bench {

Model arc_chain() {
  constexpr double pi = std::numbers::pi;
  Model model;
  model.title = "Open chain of three circular-arc flexures";
  model.units = {"mm", "N", "s", "rad"};
  Material polymer;
  polymer.name = "polymer";
  polymer.youngs_modulus = 2100.0;
  polymer.poissons_ratio = 0.35;
  model.materials.push_back(polymer);
  model.sections.push_back({"strip", RectangleSection{0.1, 1.0}, {}});
  for (const char* name : {"ground", "link2", "link3", "link4"}) {
    Body body;
    body.name = name;
    body.fixed = model.bodies.empty();
    model.bodies.push_back(body);
  }
  model.bodies.back().points.push_back({"E", {19.093, 15.750}});
  const ArcAxis axes[] = {{{0.0, 3.0}, 3.0, -pi / 2.0, -4.0 * pi / 3.0},
                          {{9.093, 8.25}, 3.5, -5.0 * pi / 6.0, 5.0 * pi / 6.0},
                          {{12.593, 15.75}, 2.5, -pi / 2.0, -3.0 * pi / 2.0}};
  for (std::size_t k = 0; k < 3; ++k) {
    Flexure flexure;
    flexure.base = k;
    flexure.action = k + 1;
    flexure.axis = axes[k];
    model.flexures.push_back(flexure);
  }
  return model;
}

std::vector<Load> arc_chain_load() {
  Load load;
  load.body = 3;
  load.point = 0;
  load.force = {1e-3, 0.0};
  return {load};
}

}  // namespace flexura::bench
