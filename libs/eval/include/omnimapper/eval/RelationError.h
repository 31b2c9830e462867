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

/// Reads relations in the format of Kuemmerle et al.: t1 t2 [s] x y z [m] roll pitch yaw [rad], one relation a line;
/// '#' begins a comment. Throws Error(unreadable_input) that names file:line.
std::vector<Relation> readRelations(const std::string& path);

struct RelationOptions {
  base::Duration tolerance{0};         ///< largest difference between a stamp of a relation and that of its pose
  geometry::Se3 base_from_sensor;      ///< pose of the relations' sensor on the base, if the estimate is of the base
  double translation_threshold = 0.5;  ///< [m] for share_within
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
  std::vector<double> translation_errors;  ///< of each judged relation [m]
  std::vector<double> rotation_errors;     ///< of each judged relation [rad], in [0, pi]
};

/// For each relation, E = from_from_to^-1 * estimated, where `estimated` is the same relative pose according to the
/// estimate. The errors are the length of E's translation and the angle of E's rotation. This metric needs no common
/// frame and is not affected by distortion of the map between places that no relation connects. Source: Kuemmerle et
/// al., On Measuring the Accuracy of SLAM Algorithms, Autonomous Robots 27(4), 2009. Throws Error(unreadable_input) if
/// there is no relation for which the estimate has both poses.
RelationError relationError(const Trajectory& estimate, const std::vector<Relation>& relations,
                            const RelationOptions& options = {});

}  // namespace omnimapper::eval
