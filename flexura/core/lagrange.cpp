#include "flexura/core/lagrange.hpp"

#include <cstddef>

namespace flexura {

std::vector<double> lagrange_values(const std::vector<double>& places, double x) {
  std::vector<double> values(places.size(), 1.0);
  for (std::size_t a = 0; a < places.size(); ++a)
    for (std::size_t b = 0; b < places.size(); ++b)
      if (b != a) values[a] *= (x - places[b]) / (places[a] - places[b]);
  return values;
}

std::vector<double> lagrange_slopes(const std::vector<double>& places, double x) {
  std::vector<double> slopes(places.size(), 0.0);
  for (std::size_t a = 0; a < places.size(); ++a) {
    for (std::size_t left_out = 0; left_out < places.size(); ++left_out) {
      if (left_out == a) continue;
      double product = 1.0 / (places[a] - places[left_out]);
      for (std::size_t b = 0; b < places.size(); ++b)
        if (b != a && b != left_out) product *= (x - places[b]) / (places[a] - places[b]);
      slopes[a] += product;
    }
  }
  return slopes;
}

}  // namespace flexura
