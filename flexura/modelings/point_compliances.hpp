#pragma once

#include <vector>

#include "flexura/core/pack2.hpp"
#include "flexura/modelings/flexure_properties.hpp"

namespace flexura {

/// Axial and shear compliance at the points of an AngleField, read in pairs.
class PointCompliances {
 public:
  void add(const FlexureProperties::Local& local) {
    axial_.push_back(local.axial_compliance);
    shear_.push_back(local.shear_compliance);
  }
  Pack2 axial(std::size_t first) const { return pair(axial_, first); }
  Pack2 shear(std::size_t first) const { return pair(shear_, first); }

 private:
  static Pack2 pair(const std::vector<double>& values, std::size_t k) {
    return Pack2{values[k], k + 1 < values.size() ? values[k + 1] : 0.0};
  }

  std::vector<double> axial_;
  std::vector<double> shear_;
};

}  // namespace flexura
