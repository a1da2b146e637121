#include "flexura/report/data_json.hpp"

namespace flexura::report_data {
namespace {

Json record_json(const ElasticityRecord& record) {
  static constexpr const char* kinds[] = {"flexure", "body", "point"};
  Json matrix = Json::array();
  for (const auto& row : record.compliance) {
    matrix.push_back({rounded(row[0]), rounded(row[1]), rounded(row[2])});
  }
  Json json = {
      {"of", kinds[static_cast<int>(record.of)]},
      {"name", record.name},
      {"at", pair(record.at)},
      {"compliance", std::move(matrix)},
      {"principal_compliances",
       {rounded(record.principal_compliances[0]), rounded(record.principal_compliances[1])}},
      {"principal_directions",
       {pair(record.principal_directions[0]), pair(record.principal_directions[1])}}};
  if (record.ellipse) {
    const Ellipse& e = *record.ellipse;
    json["ellipse"] = {{"weight", rounded(e.weight)},
                       {"centre", pair(e.centre)},
                       {"major", rounded(e.major)},
                       {"minor", rounded(e.minor)},
                       {"orientation", rounded(e.orientation)}};
  }
  if (record.antipolar) {
    const Line2& line = *record.antipolar;
    json["antipolar"] = {{"point", pair(line.origin + line.offset * line.normal)},
                         {"direction", pair(perp(line.normal))}};
  }
  return json;
}

}  // namespace

Json make_linear_json(const LinearResult& linear) {
  Json records = Json::array();
  for (const ElasticityRecord& record : linear.records) records.push_back(record_json(record));
  Json poles = Json::array();
  for (const PoleRecord& p : linear.poles) {
    poles.push_back({{"load", p.load},
                     {"force", pair(p.force)},
                     {"moment", rounded(p.moment)},
                     {"displacement", pair(p.displacement)},
                     {"rotation", rounded(p.rotation)},
                     {"pole", p.pole ? pair(*p.pole) : Json(nullptr)}});
  }
  return {{"records", std::move(records)}, {"poles", std::move(poles)}};
}

}  // namespace flexura::report_data
