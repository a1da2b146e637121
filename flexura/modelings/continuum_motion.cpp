#include <algorithm>
#include <cmath>

#include "flexura/modelings/continuum_law.hpp"
#include "flexura/modelings/continuum_port.hpp"
#include "flexura/modelings/motion_ports.hpp"

namespace flexura {
namespace {

/// A continuum in motion: masses at the quadrature points of its elements. Unknowns are those of
/// the base face, displacements of the nodes between the faces over the length, and those of the
/// action face, the pose of the tip first.
class ContinuumMotionPort final : public MotionPort {
 public:
  ContinuumMotionPort(std::shared_ptr<const ContinuumStrip> strip, double density)
      : strip_(std::move(strip)),
        density_(density),
        grid_(strip_->shape.axis, strip_->shape.breaks()) {
    const StripMesh& mesh = strip_->mesh;
    nodes_ = strip_->base_face.unknowns();
    tip_ = nodes_ + strip_->unknowns.base_face;
    size_ = tip_ + strip_->action_face.unknowns();
    for (std::size_t ex = 0; ex < mesh.along; ++ex)
      width_ = std::max(width_, range(ex).second - range(ex).first - 1);
    for (std::size_t e = 0; e < strip_->elements(); ++e) {
      const auto [first, end] = range(e / mesh.across);
      const std::size_t ex = e / mesh.across;
      for (std::size_t g = 0; g < mesh.points.size(); ++g) {
        const double s = mesh.stations[ex] + 0.5 * (1.0 + mesh.points[g].xi) *
                                                 (mesh.stations[ex + 1] - mesh.stations[ex]);
        points_.push_back({s,
                           density * mesh.maps[e * mesh.points.size() + g].volume,
                           false,
                           first,
                           end - first,
                           {}});
      }
    }
  }

  std::size_t internal_size() const override { return size_; }
  BandLayout layout() const override { return band_layout(size_, width_); }
  const std::vector<MassPoint>& points() const override { return points_; }
  /// The band, then the unknowns that it was worked out at.
  std::size_t scratch_size() const override { return size_ * (width_ + 1) + size_; }
  Answer evaluate(const Eigen::Vector3d& load, const double* y, const double* v, const double* a,
                  MemberWork& work) const override;
  void add_forces(const Vec2* forces, MemberWork& work, double* residual) const override;
  void linearize(const Eigen::Vector3d& load, const double* y, const Vec2* weights,
                 MemberWork& work) const override;
  std::vector<SectionState> sections(const Eigen::Vector3d& load, const double* y) const override;
  std::vector<double> adopt(std::span<const SectionState> sections,
                            std::span<const double> internal) const override;
  std::shared_ptr<const MotionPort> refined() const override {
    auto finer = strip_->finer();
    return finer ? std::make_shared<ContinuumMotionPort>(std::move(finer), density_) : nullptr;
  }
  void prolong(std::span<const double> internal, std::span<double> refined) const override;
  double error_ratio() const override { return strip_error_ratio(strip_->mesh); }

 private:
  struct Faces {
    StripFace base;
    StripFace action;
  };
  Faces faces_at(const double* y) const {
    Faces faces{strip_->base_face, strip_->action_face};
    faces.base.move(y);
    faces.action.move(y + tip_);
    return faces;
  }
  /// Unknowns that a column of elements depends on.
  std::pair<std::size_t, std::size_t> range(std::size_t ex) const {
    const StripMesh& mesh = strip_->mesh;
    const std::size_t p = mesh.line.order();
    return {ex == 0 ? 0 : nodes_ + strip_->unknowns.node(ex * p, 0),
            ex + 1 == mesh.along ? size_
                                 : nodes_ + strip_->unknowns.node((ex + 1) * p, 0) + 2 * mesh.rows};
  }
  /// An unknown that a node moves with, and how.
  struct Slope {
    std::size_t unknown;
    Vec2 by;
  };
  void slopes_of(const Faces& faces, std::size_t column, std::size_t row,
                 std::vector<Slope>& slopes) const;
  const StripFace* face_of(const Faces& faces, std::size_t column) const {
    if (column == 0) return &faces.base;
    return column + 1 == strip_->mesh.columns ? &faces.action : nullptr;
  }
  template <class Density, std::size_t Nodes>
  double assemble(const Density& density, const std::vector<Vec2>& places, const Faces& faces,
                  MemberWork& work) const;
  void add_element(std::size_t e, const ElementTangent& tangent, const Faces& faces,
                   MemberWork& work) const;
  void move_points(const Faces& faces, const double* v, const double* a,
                   const std::vector<Vec2>& places, MemberWork& work) const;
  std::size_t column_of(std::size_t e, std::size_t a) const {
    const StripMesh& mesh = strip_->mesh;
    return e / mesh.across * mesh.line.order() + a / (mesh.cross_line.order() + 1);
  }
  std::size_t row_of(std::size_t e, std::size_t a) const {
    const StripMesh& mesh = strip_->mesh;
    return e % mesh.across * mesh.cross_line.order() + a % (mesh.cross_line.order() + 1);
  }

  std::shared_ptr<const ContinuumStrip> strip_;
  double density_;
  StationGrid grid_;
  std::size_t nodes_ = 0;
  std::size_t tip_ = 0;
  std::size_t size_ = 0;
  std::size_t width_ = 0;
  std::vector<MassPoint> points_;
};

void ContinuumMotionPort::slopes_of(const Faces& faces, std::size_t column, std::size_t row,
                                    std::vector<Slope>& slopes) const {
  slopes.clear();
  const double length = strip_->mesh.length;
  if (const StripFace* face = face_of(faces, column)) {
    const std::size_t first = column == 0 ? 0 : tip_;
    for (std::size_t i = 0; i < face->unknowns(); ++i)
      slopes.push_back({first + i, face->slope(row, i)});
    return;
  }
  const std::size_t i = nodes_ + strip_->unknowns.node(column, row);
  slopes.push_back({i, {length, 0.0}});
  slopes.push_back({i + 1, {0.0, length}});
}

void ContinuumMotionPort::add_element(std::size_t e, const ElementTangent& tangent,
                                      const Faces& faces, MemberWork& work) const {
  const std::size_t per = strip_->mesh.nodes_per_element();
  const BandLayout rows = layout();
  std::vector<std::vector<Slope>> slopes(per);
  for (std::size_t a = 0; a < per; ++a) {
    const std::size_t column = column_of(e, a);
    slopes_of(faces, column, row_of(e, a), slopes[a]);
    const Vec2 force{tangent.forces[2 * a], tangent.forces[2 * a + 1]};
    for (const Slope& slope : slopes[a]) work.columns[4 * slope.unknown] += dot(slope.by, force);
    const StripFace* face = face_of(faces, column);
    for (std::size_t i = 0; face && i < face->unknowns(); ++i)
      for (std::size_t j = 0; j <= i; ++j)
        rows.row(work.scratch.data(), slopes[a][i].unknown)[slopes[a][j].unknown] +=
            dot(force, face->second(row_of(e, a), i, j));
    for (std::size_t b = 0; b <= a; ++b) {
      const double* k_x = tangent.stiffness.data() + 2 * a * 2 * per + 2 * b;
      const double* k_y = k_x + 2 * per;
      // the lower triangle of a node with itself stands for both
      const double k_xy = a == b ? k_y[0] : k_x[1];
      for (const Slope& left : slopes[a]) {
        const Vec2 along{left.by.x * k_x[0] + left.by.y * k_y[0],
                         left.by.x * k_xy + left.by.y * k_y[1]};
        for (const Slope& right : slopes[b]) {
          const double entry = dot(along, right.by);
          const auto [low, high] = std::minmax(left.unknown, right.unknown);
          // a pair of nodes is met once, and gives both entries where they fall on one unknown
          if (a != b && low == high)
            rows.row(work.scratch.data(), high)[low] += 2.0 * entry;
          else if (a != b || left.unknown >= right.unknown)
            rows.row(work.scratch.data(), high)[low] += entry;
        }
      }
    }
  }
}

template <class Density, std::size_t Nodes>
double ContinuumMotionPort::assemble(const Density& density, const std::vector<Vec2>& places,
                                     const Faces& faces, MemberWork& work) const {
  const StripMesh& mesh = strip_->mesh;
  const std::size_t per = mesh.nodes_per_element();
  ElementAssembly<Nodes, Density> element(mesh, density);
  ElementTangent tangent;
  std::vector<Vec2> here(per);
  double energy = 0.0;
  for (std::size_t e = 0; e < strip_->elements(); ++e) {
    for (std::size_t a = 0; a < per; ++a)
      here[a] = places[mesh.node(column_of(e, a), row_of(e, a))];
    if (strip_->enhanced) {
      const EnhancedStrains modes(mesh, e / mesh.across, e % mesh.across);
      element.settle(e, here.data(), &modes, tangent);
    } else {
      element.settle(e, here.data(), nullptr, tangent);
    }
    energy += tangent.energy;
    add_element(e, tangent, faces, work);
  }
  return energy;
}

/// Places of the quadrature points, first and second rates.
void ContinuumMotionPort::move_points(const Faces& faces, const double* v, const double* a,
                                      const std::vector<Vec2>& places, MemberWork& work) const {
  const StripMesh& mesh = strip_->mesh;
  std::vector<Vec2> rates(places.size()), seconds(places.size());
  std::vector<Slope> slopes;
  for (std::size_t c = 0; c < mesh.columns; ++c) {
    for (std::size_t r = 0; r < mesh.rows; ++r) {
      const std::size_t n = mesh.node(c, r);
      slopes_of(faces, c, r, slopes);
      for (const Slope& slope : slopes) {
        rates[n] = rates[n] + v[slope.unknown] * slope.by;
        seconds[n] = seconds[n] + a[slope.unknown] * slope.by;
      }
      const StripFace* face = face_of(faces, c);
      for (std::size_t i = 0; face && i < face->unknowns(); ++i)
        for (std::size_t j = 0; j < face->unknowns(); ++j)
          seconds[n] =
              seconds[n] + (v[slopes[i].unknown] * v[slopes[j].unknown]) * face->second(r, i, j);
    }
  }
  const std::size_t per = mesh.nodes_per_element();
  const std::size_t count = mesh.points.size();
  for (std::size_t e = 0; e < strip_->elements(); ++e) {
    for (std::size_t g = 0; g < count; ++g) {
      Vec2 place, rate, second;
      for (std::size_t k = 0; k < per; ++k) {
        const std::size_t n = mesh.node(column_of(e, k), row_of(e, k));
        const double value = mesh.values[g * per + k];
        place = place + value * places[n];
        rate = rate + value * rates[n];
        second = second + value * seconds[n];
      }
      work.places[e * count + g] = place;
      work.rates[e * count + g] = rate;
      work.seconds[e * count + g] = second;
    }
  }
}

MotionPort::Answer ContinuumMotionPort::evaluate(const Eigen::Vector3d& load, const double* y,
                                                 const double* v, const double* a,
                                                 MemberWork& work) const {
  const StripMesh& mesh = strip_->mesh;
  const Faces faces = faces_at(y);
  std::vector<Vec2> places = strip_displacements(*strip_, y + nodes_, y, y + tip_);
  for (std::size_t n = 0; n < places.size(); ++n) places[n] = mesh.nodes[n] + places[n];
  std::fill(work.columns.begin(), work.columns.end(), 0.0);
  std::fill(work.scratch.begin(), work.scratch.end(), 0.0);
  std::copy_n(y, size_, work.scratch.end() - static_cast<std::ptrdiff_t>(size_));
  Answer answer;
  with_density(strip_->material, strip_->settings, [&](const auto& density) {
    using Density = std::remove_cvref_t<decltype(density)>;
    answer.energy = mesh.nodes_per_element() == 4
                        ? assemble<Density, 4>(density, places, faces, work)
                        : assemble<Density, 0>(density, places, faces, work);
  });
  const double* tip = y + tip_;
  answer.tip = {mesh.chord.x + mesh.length * tip[0], mesh.chord.y + mesh.length * tip[1], tip[2]};
  const double lever[3] = {mesh.length, mesh.length, 1.0};
  for (std::size_t c = 0; c < 3; ++c) {
    work.columns[4 * (tip_ + c)] -= lever[c] * load[static_cast<Eigen::Index>(c)];
    work.columns[4 * (tip_ + c) + c + 1] = -lever[c];
  }
  move_points(faces, v, a, places, work);
  return answer;
}

void ContinuumMotionPort::add_forces(const Vec2* forces, MemberWork& work, double* residual) const {
  const StripMesh& mesh = strip_->mesh;
  const std::size_t per = mesh.nodes_per_element();
  const std::size_t count = mesh.points.size();
  std::vector<Vec2> nodal(mesh.nodes.size());
  for (std::size_t e = 0; e < strip_->elements(); ++e)
    for (std::size_t g = 0; g < count; ++g)
      for (std::size_t k = 0; k < per; ++k) {
        Vec2& sum = nodal[mesh.node(column_of(e, k), row_of(e, k))];
        sum = sum + mesh.values[g * per + k] * forces[e * count + g];
      }
  const Faces faces = faces_at(work.scratch.data() + size_ * (width_ + 1));
  std::vector<Slope> slopes;
  for (std::size_t c = 0; c < mesh.columns; ++c)
    for (std::size_t r = 0; r < mesh.rows; ++r) {
      slopes_of(faces, c, r, slopes);
      for (const Slope& slope : slopes)
        residual[slope.unknown] += dot(slope.by, nodal[mesh.node(c, r)]);
    }
}

void ContinuumMotionPort::linearize(const Eigen::Vector3d& /*load*/, const double* y,
                                    const Vec2* weights, MemberWork& work) const {
  const StripMesh& mesh = strip_->mesh;
  const std::size_t per = mesh.nodes_per_element();
  const std::size_t count = mesh.points.size();
  std::copy_n(work.scratch.begin(), work.tangent.size(), work.tangent.begin());
  std::fill(work.slopes.begin(), work.slopes.end(), Vec2{});
  const BandLayout rows = layout();
  const Faces faces = faces_at(y);
  Vec2* slope = work.slopes.data();
  std::vector<Slope> own;
  for (std::size_t e = 0; e < strip_->elements(); ++e) {
    const MassPoint& first = points_[e * count];
    for (std::size_t k = 0; k < per; ++k) {
      const std::size_t column = column_of(e, k);
      const std::size_t row = row_of(e, k);
      slopes_of(faces, column, row, own);
      Vec2 weight;
      for (std::size_t g = 0; g < count; ++g) {
        const double value = mesh.values[g * per + k];
        for (const Slope& by : own) {
          Vec2& entry = slope[g * first.count + by.unknown - first.first];
          entry = entry + value * by.by;
        }
        if (weights) weight = weight + value * weights[e * count + g];
      }
      const StripFace* face = weights ? face_of(faces, column) : nullptr;
      for (std::size_t i = 0; face && i < face->unknowns(); ++i)
        for (std::size_t j = 0; j <= i; ++j)
          rows.row(work.tangent.data(), own[i].unknown)[own[j].unknown] +=
              dot(weight, face->second(row, i, j));
    }
    slope += count * first.count;
  }
}

std::vector<SectionState> ContinuumMotionPort::sections(const Eigen::Vector3d& load,
                                                        const double* y) const {
  const Vec2 tip = strip_->mesh.chord + strip_->mesh.length * Vec2{y[tip_], y[tip_ + 1]};
  return strip_sections(strip_->mesh, grid_, strip_displacements(*strip_, y + nodes_, y, y + tip_),
                        tip, load);
}

std::vector<double> ContinuumMotionPort::adopt(std::span<const SectionState> /*sections*/,
                                               std::span<const double> internal) const {
  const ContinuumUnknowns& still = strip_->unknowns;
  const auto at = [&](std::size_t i) { return internal.begin() + static_cast<std::ptrdiff_t>(i); };
  std::vector<double> y(at(still.base_face), at(still.action_face));
  y.insert(y.end(), at(0), at(still.base_face));
  y.insert(y.end(), at(still.action_face), at(still.enhanced));
  return y;
}

void ContinuumMotionPort::prolong(std::span<const double> internal,
                                  std::span<double> refined) const {
  const auto finer = strip_->finer();
  const std::vector<Vec2> moved = strip_displacements(*strip_, internal.data() + nodes_,
                                                      internal.data(), internal.data() + tip_);
  std::fill(refined.begin(), refined.end(), 0.0);
  const std::size_t base = finer->base_face.unknowns();
  prolong_nodes(strip_->mesh, moved, *finer, refined.subspan(base));
  std::copy_n(internal.begin() + static_cast<std::ptrdiff_t>(tip_), 3,
              refined.begin() + static_cast<std::ptrdiff_t>(base + finer->unknowns.base_face));
}

}  // namespace

std::shared_ptr<const MotionPort> make_continuum_motion_port(const StripShape& shape,
                                                             const Material& material,
                                                             double density,
                                                             const ContinuumSettings& settings,
                                                             double tolerance) {
  return std::make_shared<ContinuumMotionPort>(
      std::make_shared<ContinuumStrip>(shape, material, settings, tolerance), density);
}

}  // namespace flexura
