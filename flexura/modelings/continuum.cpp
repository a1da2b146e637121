#include "flexura/modelings/continuum.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "flexura/core/ldlt.hpp"
#include "flexura/modelings/continuum_law.hpp"
#include "flexura/modelings/continuum_port.hpp"

namespace flexura {
namespace {

constexpr std::size_t worth_two_threads = 2000;  // unknowns of nodes

/// Runs something for both halves of a strip.
template <class Task>
void for_both(std::size_t unknowns, const Task& task) {
  if (unknowns < worth_two_threads) {
    task(0);
    task(1);
  } else {
    tbb::parallel_invoke([&] { task(0); }, [&] { task(1); });
  }
}

}  // namespace

ContinuumUnknowns::ContinuumUnknowns(const StripMesh& mesh, std::size_t base, std::size_t action,
                                     bool with_enhanced)
    : rows(mesh.rows) {
  const std::size_t elements = mesh.along * mesh.across;
  base_face = 2 * (mesh.columns - 2) * rows;
  action_face = base_face + base;
  enhanced = action_face + action;
  strains = enhanced + (with_enhanced ? enhanced_modes * elements : 0);
  size = strains + 3 * mesh.points.size() * elements;
}

ContinuumStrip::ContinuumStrip(const StripShape& outline, const Material& of_what,
                               const ContinuumSettings& how, double accuracy)
    : shape(outline),
      material(of_what),
      settings(how),
      tolerance(accuracy),
      mesh(make_strip_mesh(shape, settings, tolerance)),
      enhanced(settings.enhanced && mesh.line.order() == 1 && mesh.cross_line.order() == 1),
      base_face(mesh, false, settings.contracting),
      action_face(mesh, true, settings.contracting),
      unknowns(mesh, base_face.unknowns(), action_face.unknowns(), enhanced) {}

ContinuumPort::ContinuumPort(std::shared_ptr<const ContinuumStrip> strip)
    : strip_(std::move(strip)),
      sides_{StripSide(strip_->mesh, false, strip_->base_face.unknowns()),
             StripSide(strip_->mesh, true, strip_->action_face.unknowns())},
      grid_(std::make_shared<StationGrid>(strip_->shape.axis, strip_->shape.breaks())) {
  const StripMesh& mesh = strip_->mesh;
  std::size_t next = 0;
  const auto take = [&next](std::size_t size) {
    const std::size_t at = next;
    next += size;
    return at;
  };
  places_ = take(2 * mesh.nodes.size());
  faces_ = take(strip_->base_face.unknowns() + strip_->action_face.unknowns());
  for (std::size_t side = 0; side < 2; ++side) {
    at_[side].matrix = take(sides_[side].shape.storage());
    at_[side].sides = take(columns(side) * sides_[side].size());
  }
  const std::size_t across = 2 * mesh.rows;
  middle_ = take(across * across + 4 * across);
  gaps_ = take(3 * mesh.points.size() * strip_->elements());
  follow_ = take(strip_->enhanced ? follow_size * strip_->elements() : 0);
  scratch_size_ = next;
}

template <class Density, std::size_t Nodes>
void ContinuumPort::assemble(std::size_t side, const Density& density, const StripFace& face,
                             Work& work) const {
  const StripMesh& mesh = strip_->mesh;
  const StripSide& half = sides_[side];
  const std::size_t per = mesh.nodes_per_element();
  const std::size_t strains_per = 3 * mesh.points.size();
  const auto* places = reinterpret_cast<const Vec2*>(work.scratch + places_);
  std::vector<Vec2> here(per);
  ElementTangent tangent;
  ElementAssembly<Nodes, Density> element(mesh, density);
  for (std::size_t ex = half.first_element; ex < half.end_element; ++ex) {
    for (std::size_t ey = 0; ey < mesh.across; ++ey) {
      const std::size_t e = mesh.element(ex, ey);
      for (std::size_t a = 0; a < per; ++a) here[a] = places[mesh.element_node(ex, ey, a)];
      const ElementState state{here.data(), work.y + strip_->unknowns.strains + strains_per * e,
                               work.y + strip_->unknowns.enhanced + enhanced_modes * e};
      double* gaps = work.scratch + gaps_ + strains_per * e;
      if (strip_->enhanced) {
        const EnhancedStrains modes(mesh, ex, ey);
        element.assemble(e, state, &modes, tangent, gaps);
        double* follow = work.scratch + follow_ + follow_size * e;
        std::copy(tangent.follow.begin(), tangent.follow.end(), follow);
        std::copy(tangent.rest.begin(), tangent.rest.end(), follow + tangent.follow.size());
      } else {
        element.assemble(e, state, nullptr, tangent, gaps);
      }
      work.energy[side] += tangent.energy;
      add_element(side, ex, ey, tangent, work.scratch);
      if (at_face(side, ex)) add_face(side, ex, ey, tangent, face, work.scratch);
    }
  }
}

std::pair<std::size_t, std::size_t> ContinuumPort::free_nodes(std::size_t side,
                                                              std::size_t ex) const {
  const StripMesh& mesh = strip_->mesh;
  const std::size_t per = mesh.nodes_per_element();
  const std::size_t in_column = mesh.cross_line.order() + 1;
  if (!at_face(side, ex)) return {0, per};
  return sides_[side].reversed ? std::pair{std::size_t{0}, per - in_column}
                               : std::pair{in_column, per};
}

/// What is between nodes that are not on the face. Unknowns are displacements over the length.
void ContinuumPort::add_element(std::size_t side, std::size_t ex, std::size_t ey,
                                const ElementTangent& tangent, double* scratch) const {
  const StripMesh& mesh = strip_->mesh;
  const StripSide& half = sides_[side];
  const std::size_t per = mesh.nodes_per_element();
  const double length = mesh.length;
  const double square = length * length;
  double* matrix = scratch + at_[side].matrix;
  double* forces = scratch + at_[side].sides;
  const auto [begin, end] = free_nodes(side, ex);
  for (std::size_t a = begin; a < end; ++a) {
    const std::size_t i = unknown_of(side, ex, ey, a);
    forces[columns(side) * i] += length * tangent.forces[2 * a];
    forces[columns(side) * (i + 1)] += length * tangent.forces[2 * a + 1];
    double* row_x = half.shape.row(matrix, i);
    double* row_y = half.shape.row(matrix, i + 1);
    const double* k_x = tangent.stiffness.data() + 2 * a * 2 * per;
    const double* k_y = k_x + 2 * per;
    row_x[i] += square * k_x[2 * a];
    row_y[i] += square * k_y[2 * a];
    row_y[i + 1] += square * k_y[2 * a + 1];
    for (std::size_t b = begin; b < a; ++b) {
      const std::size_t j = unknown_of(side, ex, ey, b);
      if (j < i) {
        row_x[j] += square * k_x[2 * b];
        row_x[j + 1] += square * k_x[2 * b + 1];
        row_y[j] += square * k_y[2 * b];
        row_y[j + 1] += square * k_y[2 * b + 1];
      } else {  // numbered from the other end
        double* other_x = half.shape.row(matrix, j);
        double* other_y = half.shape.row(matrix, j + 1);
        other_x[i] += square * k_x[2 * b];
        other_y[i] += square * k_x[2 * b + 1];
        other_x[i + 1] += square * k_y[2 * b];
        other_y[i + 1] += square * k_y[2 * b + 1];
      }
    }
  }
}

/// What nodes on the end face, which move with its unknowns, have among themselves and with the
/// others of an element.
void ContinuumPort::add_face(std::size_t side, std::size_t ex, std::size_t ey,
                             const ElementTangent& tangent, const StripFace& face,
                             double* scratch) const {
  const StripMesh& mesh = strip_->mesh;
  const StripSide& half = sides_[side];
  const std::size_t size = 2 * mesh.nodes_per_element();
  const std::size_t in_column = mesh.cross_line.order() + 1;
  const std::size_t first = half.reversed ? mesh.nodes_per_element() - in_column : 0;
  const auto stiffness = [&](std::size_t r, std::size_t c) {
    return tangent.stiffness[r >= c ? r * size + c : c * size + r];
  };
  const auto [begin, end] = free_nodes(side, ex);
  std::vector<double> forces(size);  // on all nodes, as one unknown of the face moves by 1
  for (std::size_t i = 0; i < face.unknowns(); ++i) {
    std::fill(forces.begin(), forces.end(), 0.0);
    double own = 0.0;
    for (std::size_t c = 0; c < in_column; ++c) {
      const std::size_t x = 2 * (first + c);
      const Vec2 slope = face.slope(ey * mesh.cross_line.order() + c, i);
      own += slope.x * tangent.forces[x] + slope.y * tangent.forces[x + 1];
      for (std::size_t r = 0; r < size; ++r)
        forces[r] += slope.x * stiffness(r, x) + slope.y * stiffness(r, x + 1);
    }
    scratch[at_[side].sides + columns(side) * i] += own;
    for (std::size_t b = begin; b < end; ++b) {
      const std::size_t j = unknown_of(side, ex, ey, b);
      half.shape.row(scratch + at_[side].matrix, j)[i] += mesh.length * forces[2 * b];
      half.shape.row(scratch + at_[side].matrix, j + 1)[i] += mesh.length * forces[2 * b + 1];
    }
    for (std::size_t c = 0; c < in_column; ++c) {
      const std::size_t row = ey * mesh.cross_line.order() + c, x = 2 * (first + c);
      const Vec2 force{tangent.forces[x], tangent.forces[x + 1]};
      for (std::size_t j = i; j < face.unknowns(); ++j)
        half.shape.row(scratch + at_[side].matrix, j)[i] +=
            dot(Vec2{forces[x], forces[x + 1]}, face.slope(row, j)) +
            dot(force, face.second(row, i, j));
    }
  }
}

void ContinuumPort::eliminate_side(std::size_t side, const StripFace& face,
                                   const Eigen::Vector3d& load, Work& work) const {
  const StripSide& half = sides_[side];
  double* matrix = work.scratch + at_[side].matrix;
  double* sides = work.scratch + at_[side].sides;
  std::fill_n(matrix, half.shape.storage(), 0.0);
  std::fill_n(sides, columns(side) * half.size(), 0.0);
  with_density(strip_->material, strip_->settings, [&](const auto& density) {
    using Density = std::remove_cvref_t<decltype(density)>;
    if (strip_->mesh.nodes_per_element() == 4)
      assemble<Density, 4>(side, density, face, work);
    else
      assemble<Density, 0>(side, density, face, work);
  });
  if (side == 1) {
    const double length = strip_->mesh.length;
    const double scale[3] = {length, length, 1.0};
    for (std::size_t i = 0; i < 3; ++i) {
      sides[4 * i] -= scale[i] * load[static_cast<Eigen::Index>(i)];
      sides[4 * i + 1 + i] = scale[i];
    }
  }
  work.pivots[side] = flexura::eliminate(half.shape, half.pivots(), matrix);
  if (!work.pivots[side].weak)
    substitute_forward(half.shape, half.pivots(), matrix, columns(side), 0, sides);
}

/// What both halves leave of the middle column, and its solution; the answer of the tip.
bool ContinuumPort::meet(Work& work, TipResponse& response) const {
  const std::size_t across = 2 * strip_->mesh.rows;
  double* middle = work.scratch + middle_;
  double* sides = middle + across * across;
  std::fill_n(middle, across * across + 4 * across, 0.0);
  for (std::size_t side = 0; side < 2; ++side) {
    const StripSide& half = sides_[side];
    const std::size_t from = half.pivots();
    for (std::size_t i = 0; i < across; ++i) {
      const double* row = half.shape.row(work.scratch + at_[side].matrix, from + i);
      for (std::size_t j = 0; j <= i; ++j)
        if (from + j >= half.shape.first(from + i)) middle[i * across + j] += row[from + j];
      for (std::size_t c = 0; c < columns(side); ++c)
        sides[4 * i + c] += work.scratch[at_[side].sides + columns(side) * (from + i) + c];
    }
  }
  std::vector<double> before(sides, sides + 4 * across);
  std::vector<double> column(across);
  const LdltInertia found = factorize_ldlt(middle, dense_layout(across), column.data());
  if (found.weak) return false;
  solve_ldlt<4>(middle, dense_layout(across), sides);
  response.negative = work.pivots[0].negative + work.pivots[1].negative + found.negative;

  Eigen::Matrix<double, 3, 4> products = Eigen::Matrix<double, 3, 4>::Zero();
  const auto add = [&products](const double* a, const double* b, double factor) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 4; ++c) products(r, c) += factor * a[1 + r] * b[c];
  };
  const StripSide& half = sides_[1];
  const double* rows = work.scratch + at_[1].sides;
  for (std::size_t i = 0; i < half.pivots(); ++i)
    add(rows + 4 * i, rows + 4 * i, 1.0 / half.shape.row(work.scratch + at_[1].matrix, i)[i]);
  for (std::size_t i = 0; i < across; ++i) add(before.data() + 4 * i, sides + 4 * i, 1.0);
  response.tip -= products.col(0);
  response.flexibility = products.rightCols<3>();
  return true;
}

TipResponse ContinuumPort::linearize(const Eigen::Vector3d& load, const double* internal,
                                     double* scratch) const {
  const StripMesh& mesh = strip_->mesh;
  const ContinuumUnknowns& unknowns = strip_->unknowns;
  StripFace faces[2] = {strip_->base_face, strip_->action_face};
  faces[0].move(internal + unknowns.base_face);
  faces[1].move(internal + unknowns.action_face);
  std::copy_n(internal + unknowns.base_face, unknowns.enhanced - unknowns.base_face,
              scratch + faces_);
  double* places = scratch + places_;
  for (std::size_t c = 0; c < mesh.columns; ++c) {
    for (std::size_t r = 0; r < mesh.rows; ++r, places += 2) {
      Vec2 place = mesh.nodes[mesh.node(c, r)];
      if (c == 0 || c + 1 == mesh.columns) {
        place = faces[c == 0 ? 0 : 1].place(r);
      } else {
        const double* u = internal + unknowns.node(c, r);
        place = place + mesh.length * Vec2{u[0], u[1]};
      }
      places[0] = place.x;
      places[1] = place.y;
    }
  }
  Work work{scratch, internal, {}, {}};
  for_both(nodal_size(), [&](std::size_t side) { eliminate_side(side, faces[side], load, work); });
  TipResponse response;
  response.strain_energy = work.energy[0] + work.energy[1];
  const double* tip = internal + unknowns.action_face;
  response.tip << mesh.chord.x + mesh.length * tip[0], mesh.chord.y + mesh.length * tip[1], tip[2];
  response.singular = work.pivots[0].weak || work.pivots[1].weak || !meet(work, response);
  return response;
}

/// One half: K d = -residual W_y + d(load) . W_y,load, its first substitution done.
void ContinuumPort::solve_side(std::size_t side, const double* scratch, double residual,
                               const Eigen::Vector3d& load, double* step) const {
  const StripSide& half = sides_[side];
  const ContinuumUnknowns& unknowns = strip_->unknowns;
  const double* matrix = scratch + at_[side].matrix;
  const double* sides = scratch + at_[side].sides;
  const std::size_t across = 2 * strip_->mesh.rows;
  const double* middle = scratch + middle_ + across * across;
  const auto combined = [&](const double* row, std::size_t count) {
    double sum = -residual * row[0];
    for (std::size_t c = 1; c < count; ++c) sum += row[c] * load[static_cast<Eigen::Index>(c - 1)];
    return sum;
  };
  std::vector<double> x(half.size());
  for (std::size_t i = 0; i < half.pivots(); ++i)
    x[i] = combined(sides + columns(side) * i, columns(side)) / half.shape.row(matrix, i)[i];
  for (std::size_t i = 0; i < across; ++i) x[half.pivots() + i] = combined(middle + 4 * i, 4);
  substitute_back(half.shape, half.pivots(), matrix, x.data());
  std::copy_n(x.begin(), half.face, step + (side == 0 ? unknowns.base_face : unknowns.action_face));
  const std::size_t own = side == 0 ? half.columns : half.columns - 1;  // the middle is in both
  for (std::size_t d = 1; d <= own; ++d)
    std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(half.face + (d - 1) * across), across,
                step + unknowns.node(half.column(d), 0));
}

void ContinuumPort::advance(const double* scratch, double residual, const Eigen::Vector3d& load,
                            double* step) const {
  for_both(nodal_size(),
           [&](std::size_t side) { solve_side(side, scratch, residual, load, step); });
  const std::vector<Vec2> changes = node_changes(scratch, step);
  for_both(nodal_size(),
           [&](std::size_t side) { follow_strains(side, scratch, residual, changes, step); });
}

Eigen::MatrixXd ContinuumPort::hessian(const Eigen::Vector3d& /*load*/,
                                       const double* /*internal*/) const {
  throw std::logic_error("a continuum's second derivatives are never laid out as one matrix");
}

std::shared_ptr<const TwoPort> make_continuum_port(const StripShape& shape,
                                                   const Material& material,
                                                   const ContinuumSettings& settings,
                                                   double tolerance) {
  return std::make_shared<ContinuumPort>(
      std::make_shared<ContinuumStrip>(shape, material, settings, tolerance));
}

}  // namespace flexura
