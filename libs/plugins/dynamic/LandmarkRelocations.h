#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "DynamicLandmarksPlugin.h"
#include "StaticWeights.h"

namespace omnimapper::plugins {

/// The key frames that measurements were made at.
class MeasurementFrames {
 public:
  explicit MeasurementFrames(const map::KeyFrames& key_frames);
  /// None if it binds no pose.
  const map::KeyFrame* of(const graph::FactorRecord& measurement) const;

 private:
  std::map<base::VariableId, const map::KeyFrame*> of_poses_;
};

/// Measurements of one landmark that show it where it was at one time, in the order they were made.
struct SeenPlace {
  std::vector<base::FactorId> measurements;
};

/// Tells the measurements of landmarks apart into the places where they were. Measurements in a row that agree are a
/// visit; in a copy of `graph` each visit is a landmark of its own, with all that is known of the trajectory, and
/// visits are of one place where they differ by no more than their covariance allows, or by less than what counts as a
/// move. What is known of a landmark by itself holds in each visit; relations to others in none. None if a direction of
/// some other variable is determined by nothing.
std::optional<std::vector<std::vector<SeenPlace>>> clusterMeasurements(const map::Map& map, const graph::Graph& graph,
                                                                       const std::vector<WeighedLandmark>& landmarks,
                                                                       const DynamicLandmarksOptions& options);

/// Where those measurements alone show a landmark, with the poses held as they are in `graph`.
std::vector<Eigen::VectorXd> valuesSeenBy(const std::vector<base::FactorId>& measurements,
                                          const WeighedLandmark& landmark, const graph::Graph& graph);

/// Whether those measurements, with what is known of the landmark by itself, leave none of its directions open.
bool isDetermined(const WeighedLandmark& landmark, const std::vector<base::FactorId>& measurements,
                  const graph::Graph& graph);

/// The middle of a landmark that has these values [m], by the parts of its surface that were seen from these key
/// frames, or by all where none of those told anything new of it; none if its payload does not tell a shape.
std::optional<Eigen::Vector3d> middleOf(const map::Landmark& landmark, const std::vector<Eigen::VectorXd>& values,
                                        const map::KeyFrames& key_frames,
                                        const std::set<base::KeyFrameId>& seen_from = {});

}  // namespace omnimapper::plugins
