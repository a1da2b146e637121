#include "flexura/assembly/elastic_link.hpp"

namespace flexura {

LinkInertia link_inertia(const ElasticLink& link, Vec2 origin) {
  const Eigen::Index n = link.size();
  const auto count = static_cast<Eigen::Index>(link.places.size());
  Eigen::MatrixXd weighted(2 * count, n), turned(2 * count, n);
  Eigen::MatrixX2d one(2 * count, 2);
  Eigen::VectorXd place(2 * count), across(2 * count);
  for (Eigen::Index g = 0; g < count; ++g) {
    const auto k = static_cast<std::size_t>(g);
    weighted.middleRows<2>(2 * g) = link.masses[k] * link.slopes.middleRows<2>(2 * g);
    turned.row(2 * g) = -link.slopes.row(2 * g + 1);
    turned.row(2 * g + 1) = link.slopes.row(2 * g);
    one.middleRows<2>(2 * g).setIdentity();
    const Vec2 r = link.places[k] - origin;
    place.segment<2>(2 * g) << r.x, r.y;
    across.segment<2>(2 * g) << -r.y, r.x;
  }
  LinkInertia inertia;
  inertia.mass_places = weighted.transpose() * link.slopes;
  inertia.mass = inertia.mass_places;
  inertia.mass_turned = weighted.transpose() * turned;
  inertia.push = weighted.transpose() * one;
  inertia.pull = weighted.transpose() * place;
  inertia.twist = weighted.transpose() * across;
  inertia.rotary = Eigen::VectorXd::Zero(n);
  for (const ElasticLink::Slice& slice : link.slices) {
    if (slice.rotary_inertia == 0.0) continue;
    inertia.mass += slice.rotary_inertia * slice.rotation.transpose() * slice.rotation;
    inertia.rotary += slice.rotary_inertia * slice.rotation.transpose();
  }
  return inertia;
}

void attach_with_arms(ElasticLink& link, Vec2 base_arm, Vec2 action_arm) {
  if (base_arm == Vec2{} && action_arm == Vec2{}) return;
  // u = A (displacements of the bodies); all that is by u is so by A from the right
  const auto apply = [&](auto& rows) {
    Eigen::Index first = 0;
    for (const Vec2 arm : {base_arm, action_arm}) {
      const Vec2 moved = perp(arm);  // of the end, as the body turns by one
      rows.col(first + 2) += moved.x * rows.col(first) + moved.y * rows.col(first + 1);
      first += 3;
    }
  };
  const auto apply_to = [&](ElasticLink::Reading& reading) { apply(reading.by_u); };
  apply(link.stiffness);
  Eigen::MatrixXd transposed = link.stiffness.transpose();
  apply(transposed);
  link.stiffness = transposed;
  apply(link.slopes);
  for (ElasticLink::Slice& slice : link.slices) {
    apply(slice.rotation);
    apply(slice.normal_force);
  }
  for (ElasticLink::Element& element : link.elements)
    for (auto& rows : element.displacement) apply(rows);
  for (auto* reading : {&link.strain, &link.axial_strain, &link.deflection}) apply_to(*reading);
  if (link.field.stress.size() > 0) apply(link.field.stress);
  for (ElasticLink::Station& station : link.stations) {
    apply(station.displacement);
    apply_to(station.bending_stress);
    apply_to(station.axial_stress);
  }
}

}  // namespace flexura
