#include "flexura/geometry/section_profile.hpp"

#include <algorithm>
#include <cmath>

namespace flexura {
namespace {

/// How much a circle of radius r has receded at x from where it is lowest.
double recess(double x, double r) { return r - std::sqrt(std::max(0.0, (r - x) * (r + x))); }

struct Size {
  double t;
  double s;
  double length;

  double operator()(const LeafProfile&) const { return t; }
  double operator()(const TaperProfile& taper) const { return t + s / length * (taper.end - t); }
  double operator()(const PiecewiseProfile& table) const {
    const double at = s / length;
    std::size_t k = 1;
    while (k + 1 < table.points.size() && at > table.points[k].x) ++k;
    const Vec2 a = table.points[k - 1];
    const Vec2 b = table.points[k];
    return t * (a.y + (at - a.x) / (b.x - a.x) * (b.y - a.y));
  }
  double operator()(const NotchProfile& notch) const {
    const double x = std::min(std::abs(s - 0.5 * length), notch.a);
    return t + 2.0 * notch.b / notch.a * recess(x, notch.a);
  }
  double operator()(const FilletProfile& fillet) const {
    const double x = std::clamp(fillet.radius - std::min(s, length - s), 0.0, fillet.radius);
    return t + 2.0 * recess(x, fillet.radius);
  }
};

struct Breaks {
  double length;

  std::vector<double> operator()(const LeafProfile&) const { return {0.0, length}; }
  std::vector<double> operator()(const TaperProfile&) const { return {0.0, length}; }
  std::vector<double> operator()(const PiecewiseProfile& table) const {
    std::vector<double> breaks;
    for (const Vec2 point : table.points) breaks.push_back(point.x * length);
    breaks.front() = 0.0;
    breaks.back() = length;
    return breaks;
  }
  std::vector<double> operator()(const NotchProfile& notch) const {
    const double middle = 0.5 * length;
    return inside({middle - notch.a, middle, middle + notch.a});
  }
  std::vector<double> operator()(const FilletProfile& fillet) const {
    return inside({fillet.radius, length - fillet.radius});
  }

  std::vector<double> inside(const std::vector<double>& kinks) const {
    std::vector<double> breaks{0.0};
    for (const double kink : kinks)
      if (kink > breaks.back() + 1e-12 * length && kink < length * (1.0 - 1e-12))
        breaks.push_back(kink);
    breaks.push_back(length);
    return breaks;
  }
};

}  // namespace

double profile_size(const Profile& profile, double t, double s, double length) {
  return std::visit(Size{t, s, length}, profile);
}

std::vector<double> profile_breaks(const Profile& profile, double length) {
  return std::visit(Breaks{length}, profile);
}

}  // namespace flexura
