#include "flexura/studies/linear_study.hpp"

#include <cmath>

#include "flexura/assembly/system.hpp"
#include "flexura/modelings/compliance.hpp"
#include "flexura/modelings/ellipse.hpp"
#include "flexura/modelings/make_system.hpp"
#include "flexura/studies/singular_mechanism.hpp"

namespace flexura {
namespace {

PoleRecord find_pole(const Model& model, const Load& load, const Eigen::Matrix3d& at_centre) {
  const Body& body = model.bodies[load.body];
  const Vec2 centre = body_centre(model, load.body);
  const Vec2 at = load.point ? body.points[*load.point].position : centre;
  const Eigen::Matrix3d compliance = shift_compliance(at_centre, centre, at);
  const Eigen::Vector3d d = compliance * Eigen::Vector3d(load.force.x, load.force.y, load.moment);
  PoleRecord record;
  record.load = load.point ? body.name + "." + body.points[*load.point].name : body.name;
  record.force = load.force;
  record.moment = load.moment;
  record.displacement = {d[0], d[1]};
  record.rotation = d[2];
  // u = rotation x (at - pole); a rotation that is rounding has no pole
  const double lever =
      std::sqrt(compliance.topLeftCorner<2, 2>().norm() / std::max(compliance(2, 2), 1e-300));
  if (std::abs(d[2]) * lever > 1e-12 * norm(record.displacement))
    record.pole = at + (1.0 / d[2]) * perp(record.displacement);
  return record;
}

}  // namespace

LinearResult run_linear(const Model& model, const LinearStudy& study, Termination& termination) {
  LinearResult result;
  for (const Flexure& flexure : model.flexures) {
    const FlexureProperties properties =
        flexure_properties(model, flexure, study.axial, study.shear);
    const Vec2 end = properties.axis.position(properties.axis.length());
    result.records.push_back(make_elasticity_record(ElasticityRecord::Of::flexure, flexure.name,
                                                    end, compliance_matrix(properties, end)));
  }
  ModelingSettings settings;
  settings.kind = LinearSettings{};
  settings.axial = study.axial;
  settings.shear = study.shear;
  System system(make_layout(model, {}, settings));
  if (!system.linearize(system.initial_state()) || system.is_singular()) {
    termination = {Status::stopped, describe_singular(model, system.softest_body())};
    return result;
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body& body = model.bodies[b];
    if (body.fixed) continue;
    const Vec2 centre = body_centre(model, b);
    const Eigen::Matrix3d compliance = system.body_compliance(b);
    result.records.push_back(
        make_elasticity_record(ElasticityRecord::Of::body, body.name, centre, compliance));
    for (const Point& point : body.points)
      result.records.push_back(make_elasticity_record(
          ElasticityRecord::Of::point, body.name + "." + point.name, point.position,
          shift_compliance(compliance, centre, point.position)));
  }
  for (const Load& load : study.loads)
    result.poles.push_back(find_pole(model, load, system.body_compliance(load.body)));
  termination.status = Status::converged;
  return result;
}

}  // namespace flexura
