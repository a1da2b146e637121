#pragma once

#include <string>
#include <vector>

#include "flexura/results/path_result.hpp"

namespace flexura {

/// Stress fields as an unstructured grid of VTK (XML, numbers in base64): quadrilaterals as drawn,
/// the displacement of the nodes, stress, principal stresses and von Mises stress there, and of
/// every quadrilateral its flexure (an index in file order) and its element's estimated error, of
/// the norm of the whole. `time` is what ParaView calls so: a load factor.
std::string make_vtu(const FieldState& fields, double time);

/// Files of fields as a series over time, or over what goes like it.
std::string make_pvd(const std::vector<std::string>& files, const std::vector<double>& times);

}  // namespace flexura
