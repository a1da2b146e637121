#pragma once

#include <Eigen/Dense>
#include <vector>

#include "flexura/model/model.hpp"
#include "flexura/results/linkage_result.hpp"
#include "flexura/studies/linkage_turn.hpp"

namespace flexura {

/// Names and the rigid motion over the turn: poses, driving torque, reactions, shaking forces.
/// Precondition: the turn visited its positions.
LinkageResult make_linkage_names(const Model& model, const LinkageStudy& study,
                                 const LinkageTurn& turn);
void record_rigid_motion(const Model& model, const LinkageStudy& study, const LinkageTurn& turn,
                         LinkageResult& result);

/// Strains, stresses and displacements from the states at all positions.
void record_elastic_motion(const Model& model, const LinkageStudy& study, const LinkageTurn& turn,
                           const std::vector<ElasticState>& states, LinkageMotion& motion);

/// Bending strains at mid-length alone, of all flexures.
Eigen::RowVectorXd strains_at(const LinkageStudy& study, const LinkageTurn& turn, double angle,
                              double speed, const ElasticState& state);
/// A row per position.
Eigen::MatrixXd middle_strains(const LinkageStudy& study, const LinkageTurn& turn, double speed,
                               const std::vector<ElasticState>& states);

/// Largest difference of such strains over the largest of their flexure.
double strain_distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace flexura
