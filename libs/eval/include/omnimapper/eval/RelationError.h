#pragma once

#include <omnimapper/eval/Statistics.h>
#include <omnimapper/eval/Trajectory.h>

#include <string>
#include <vector>

namespace omnimapper::eval {

/// A relative pose that was checked by hand: where the sensor was at `to`, seen from where it was at `from`.
struct Relation {
  base::Stamp from;
  base::Stamp to;
  geometry::Se3 from_from_to;
};

/// Reads the relations of Kuemmerle et al.: t1 t2 [s] x y z [m] roll pitch yaw [rad], one a line, '#' comments.
/// Throws Error(unreadable_input) that names file:line.
std::vector<Relation> readRelations(const std::string& path);

struct RelationOptions {
  base::Duration tolerance{0};     ///< largest difference of stamps of a relation and of the pose that is used for it
  geometry::Se3 base_from_sensor;  ///< applied to the estimate if that is of the base
  double translation_threshold = 0.5;                    ///< [m] for share_within
  double rotation_threshold = 10 * geometry::kPi / 180;  ///< [rad] for share_within
};

struct RelationError {
  Statistics translation;                  ///< [m]
  Statistics rotation;                     ///< [rad]
  Statistics squared_translation;          ///< [m^2]
  Statistics squared_rotation;             ///< [rad^2]
  double share_within = 0;                 ///< share of all judged relations within both thresholds
  std::size_t missed = 0;                  ///< relations for whose stamps the estimate has no pose
  std::vector<base::Stamp> stamps;         ///< `to` of each judged relation, rising
  std::vector<double> translation_errors;  ///< of each [m]
  std::vector<double> rotation_errors;     ///< of each [rad], in [0, pi]
};

/// The relation metric: E = from_from_to^-1 (est_from^-1 est_to), its length and its angle, over all relations.
/// It needs no common frame and is not affected by distortion of the map between places that no relation connects.
/// Source: Kuemmerle et al., On Measuring the Accuracy of SLAM Algorithms, Autonomous Robots 27(4), 2009.
/// Throws Error(unreadable_input) if the estimate has both poses for none of the relations.
RelationError relationError(const Trajectory& estimate, const std::vector<Relation>& relations,
                            const RelationOptions& options = {});

}  // namespace omnimapper::eval
