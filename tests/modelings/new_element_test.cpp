// docs/new_element.md, done: the page's own blocks, a cantilever bent by a moment, and a check that
// page and test are the same.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "flexura/assembly/system.hpp"
#include "flexura/modelings/flexure_properties.hpp"
#include "flexura/modelings/lagrange_beam.hpp"
#include "flexura/modelings/make_system.hpp"
#include "flexura/solvers/newton.hpp"
#include "tests/support/mechanism.hpp"
#include "tests/support/modelings.hpp"

namespace flexura::testing {
namespace {

struct StiffeningDensity {
  double axial, shear, bending, beta;  // EA, GA_s, EI, and how much it stiffens

  template <class Scalar>
  Scalar operator()(const Scalar& dx, const Scalar& dy, const Scalar& theta, const Scalar& kappa,
                    double stretch) const {
    const auto [along, gamma] = in_turned_axes(theta, dx, dy);
    const Scalar bent = kappa * kappa;
    return half_square(axial, along - stretch) + half_square(shear, gamma) +
           0.5 * bending * bent * (1.0 + 0.5 * beta * bent);
  }
};

SystemLayout stiffen(SystemLayout layout, const FlexureProperties& flexure, double beta) {
  const StiffeningDensity density{1.0 / flexure.axial_compliance, 1.0 / flexure.shear_compliance,
                                  flexure.bending_stiffness, beta};
  const BeamSettings mesh{4, 3, BeamSettings::Theory::exact};  // elements, order
  for (auto& member : layout.members)
    member.port = std::make_shared<LagrangeBeamPort<StiffeningDensity>>(flexure, mesh, density);
  return layout;
}

TEST(NewElement, BendsByItsOwnLaw) {
  const Mechanism beam = cantilever({1e4, 1.0, 1e4}, 1.0);
  const double kappa = 5.0;
  const double beta = 0.02;
  const double moment = kappa + beta * kappa * kappa * kappa;
  const Load load = beam.load("tip", {0.0, 0.0}, moment);
  const FlexureProperties flexure = flexure_properties(beam, beam.model().flexures[0], true, true);
  System system(stiffen(make_layout(beam, {load}, testing::beam(4, 3)), flexure, beta));
  std::vector<double> z = system.initial_state();
  Newton newton;
  for (int step = 1; step <= 10; ++step) {
    system.set_load_factor(0.1 * step);
    ASSERT_EQ(newton.solve(system, z).outcome, NewtonOutcome::converged) << step;
  }
  EXPECT_NEAR(system.pose(1, z).rotation, kappa, 1e-10);
  ASSERT_TRUE(system.linearize(z));
  EXPECT_EQ(system.unstable_directions(), 0);
  EXPECT_NEAR(system.strain_energy(), 0.5 * kappa * kappa * (1.0 + 0.5 * beta * kappa * kappa),
              1e-8);
}

TEST(NewElement, IsWhatThePageShows) {
  const auto read = [](const std::string& path) {
    std::ifstream file(FLEXURA_SOURCE_DIR "/" + path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  };
  const std::string page = read("docs/new_element.md");
  const std::string test = read("tests/modelings/new_element_test.cpp");
  std::size_t blocks = 0;
  const std::string open = "```cpp\n";
  for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
    at += open.size();
    const std::string block = page.substr(at, page.find("```", at) - at);
    EXPECT_NE(test.find(block), std::string::npos) << block;
    ++blocks;
  }
  EXPECT_EQ(blocks, 2U);
}

}  // namespace
}  // namespace flexura::testing
