#include "flexura/io/write_linkage.hpp"

#include <cmath>
#include <numbers>

namespace flexura {
namespace {

class LinkageFiles {
 public:
  LinkageFiles(const LinkageResult& linkage, const std::string& angle_unit)
      : linkage_(linkage), per_radian_(angle_unit == "deg" ? 180.0 / std::numbers::pi : 1.0) {}

  CsvText frequencies(const std::vector<std::vector<double>>& rows) const;
  CsvText response() const;
  CsvText rigid() const;
  CsvText speeds() const;
  CsvText stresses(const LinkageMotion& motion, std::size_t flexure) const;
  CsvText places(const LinkageMotion& motion) const;

 private:
  double angle(std::size_t position) const {
    return per_radian_ * linkage_.positions[position].angle;
  }
  void add_places(CsvWriter& csv, std::size_t position, const LinkageMotion* motion) const;
  std::vector<std::string> place_columns() const;

  const LinkageResult& linkage_;
  double per_radian_;
};

CsvText LinkageFiles::frequencies(const std::vector<std::vector<double>>& rows) const {
  std::vector<std::string> columns{"angle"};
  for (std::size_t k = 1; k <= rows.front().size(); ++k) columns.push_back("w" + std::to_string(k));
  CsvWriter csv(std::move(columns));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    csv.number(angle(i));
    for (std::size_t k = 0; k < rows.front().size(); ++k)
      k < rows[i].size() ? csv.number(rows[i][k]) : csv.word("");
    csv.end_row();
  }
  return std::move(csv).result();
}

CsvText LinkageFiles::response() const {
  std::vector<std::string> columns{"angle"};
  for (const LinkageMotion& motion : linkage_.modelings)
    for (std::size_t k = 0; k < motion.flexures.size(); ++k)
      for (const char* what : {".strain", ".deflection", ".axial_strain", ".stress"})
        columns.push_back(motion.label + "." + linkage_.flexures[k] + what);
  CsvWriter csv(std::move(columns));
  for (std::size_t i = 0; i < linkage_.positions.size(); ++i) {
    csv.number(angle(i));
    for (const LinkageMotion& motion : linkage_.modelings)
      for (const FlexureCurves& flexure : motion.flexures)
        csv.number(flexure.strain[i])
            .number(flexure.deflection[i])
            .number(flexure.axial_strain[i])
            .number(flexure.stress[i]);
    csv.end_row();
  }
  return std::move(csv).result();
}

std::vector<std::string> LinkageFiles::place_columns() const {
  std::vector<std::string> columns{"angle"};
  for (const std::string& body : linkage_.bodies)
    for (const char* what : {".x", ".y"}) columns.push_back(body + what);
  for (const std::string& point : linkage_.points)
    for (const char* what : {".x", ".y"}) columns.push_back(point + what);
  return columns;
}

void LinkageFiles::add_places(CsvWriter& csv, std::size_t i, const LinkageMotion* motion) const {
  const RigidPosition& position = linkage_.positions[i];
  for (std::size_t b = 0; b < position.bodies.size(); ++b)
    csv.vector(position.bodies[b].position + (motion ? motion->bodies[i][b] : Vec2{}));
  for (std::size_t p = 0; p < position.points.size(); ++p)
    csv.vector(position.points[p] + (motion ? motion->points[i][p] : Vec2{}));
}

CsvText LinkageFiles::places(const LinkageMotion& motion) const {
  CsvWriter csv(place_columns());
  for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
    csv.number(angle(i));
    add_places(csv, i, &motion);
    csv.end_row();
  }
  return std::move(csv).result();
}

CsvText LinkageFiles::rigid() const {
  std::vector<std::string> columns = place_columns();
  for (const std::string& body : linkage_.bodies) columns.push_back(body + ".rotation");
  for (const char* what : {"torque", "shaking_force.x", "shaking_force.y", "shaking_moment"})
    columns.push_back(what);
  for (const std::string& pin : linkage_.pins)
    for (const char* what : {".force.x", ".force.y"}) columns.push_back(pin + what);
  const bool transmits = linkage_.positions.front().transmission_angle.has_value();
  if (transmits) columns.push_back("transmission_angle");
  CsvWriter csv(std::move(columns));
  for (std::size_t i = 0; i < linkage_.positions.size(); ++i) {
    const RigidPosition& position = linkage_.positions[i];
    csv.number(angle(i));
    add_places(csv, i, nullptr);
    for (const Pose& body : position.bodies) csv.number(per_radian_ * body.rotation);
    csv.number(position.torque).vector(position.shaking_force).number(position.shaking_moment);
    for (const Vec2 force : position.reactions) csv.vector(force);
    if (transmits) csv.number(per_radian_ * *position.transmission_angle);
    csv.end_row();
  }
  return std::move(csv).result();
}

CsvText LinkageFiles::speeds() const {
  std::vector<std::string> columns{"angular_speed", "largest_multiplier", "buckles"};
  for (const std::string& flexure : linkage_.flexures) columns.push_back(flexure + ".peak_strain");
  CsvWriter csv(std::move(columns));
  for (const SpeedState& state : linkage_.speeds) {
    csv.number(state.speed);
    csv.number(state.multipliers.empty() ? 0.0 : std::abs(state.multipliers.front()))
        .word(state.buckles ? "yes" : "no");
    for (const double strain : state.peak_strain) csv.number(strain);
    csv.end_row();
  }
  return std::move(csv).result();
}

CsvText LinkageFiles::stresses(const LinkageMotion& motion, std::size_t k) const {
  CsvWriter csv({"angle", "s", "upper_stress", "lower_stress"});
  const FlexureCurves& curves = motion.flexures[k];
  for (std::size_t i = 0; i < curves.upper_stress.size(); ++i)
    for (std::size_t j = 0; j < linkage_.stations[k].size(); ++j)
      csv.number(angle(i))
          .number(linkage_.stations[k][j])
          .number(curves.upper_stress[i][j])
          .number(curves.lower_stress[i][j])
          .end_row();
  return std::move(csv).result();
}

}  // namespace

std::vector<std::pair<std::string, CsvText>> make_linkage_files(const LinkageResult& linkage,
                                                                const std::string& angle_unit) {
  std::vector<std::pair<std::string, CsvText>> files;
  if (linkage.positions.empty()) return files;
  const LinkageFiles make(linkage, angle_unit);
  files.emplace_back("frequencies.csv", make.frequencies(linkage.frequencies));
  files.emplace_back("followed.csv", make.frequencies(linkage.followed));
  files.emplace_back("response.csv", make.response());
  files.emplace_back("rigid.csv", make.rigid());
  if (!linkage.speeds.empty()) files.emplace_back("speeds.csv", make.speeds());
  for (const LinkageMotion& motion : linkage.modelings) {
    if (motion.flexures.empty()) continue;
    files.emplace_back(motion.label + ".csv", make.places(motion));
    for (std::size_t k = 0; k < linkage.flexures.size(); ++k)
      files.emplace_back(motion.label + "." + linkage.flexures[k] + ".stress.csv",
                         make.stresses(motion, k));
  }
  return files;
}

}  // namespace flexura
