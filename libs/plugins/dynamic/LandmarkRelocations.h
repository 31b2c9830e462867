#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "DynamicLandmarksPlugin.h"
#include "StaticWeights.h"

namespace omnimapper::plugins {

/// Finds the key frames at which measurements were made.
class MeasurementFrames {
 public:
  explicit MeasurementFrames(const map::KeyFrames& key_frames);
  /// Null if the measurement binds no pose of a key frame.
  const map::KeyFrame* of(const graph::FactorRecord& measurement) const;

 private:
  std::map<base::VariableId, const map::KeyFrame*> of_poses_;
};

/// The measurements of one landmark at one of its places, in the order of visits.
struct MeasuredPlace {
  std::vector<base::FactorId> measurements;
};

/// Clusters the measurements of each landmark by the places where it was. Consecutive measurements that agree are a
/// visit. In a copy of `graph`, each visit gets its own copy of the landmark, which is estimated together with the
/// trajectory. Two visits are at one place if their copies differ by no more than their covariance allows, or by less
/// than `min_move`. Factors on the landmark alone apply to the copy of each visit; relations to other landmarks are
/// left out. None if some direction of another variable, such as a pose, is undetermined.
std::optional<std::vector<std::vector<MeasuredPlace>>> clusterMeasurements(
    const map::Map& map, const graph::Graph& graph, const std::vector<WeighedLandmark>& landmarks,
    const DynamicLandmarksOptions& options);

/// The values of a landmark's variables that follow from these measurements and from the factors on the landmark alone,
/// with all other variables fixed at their values in `graph`.
std::vector<Eigen::VectorXd> valuesSeenBy(const std::vector<base::FactorId>& measurements,
                                          const WeighedLandmark& landmark, const graph::Graph& graph);

/// Whether these measurements and the factors on the landmark alone determine all directions of its variables.
bool isDetermined(const WeighedLandmark& landmark, const std::vector<base::FactorId>& measurements,
                  const graph::Graph& graph);

/// The middle [m] of a landmark whose variables have these values: that of the part of its surface that was seen from
/// the key frames `seen_from`, or, if its payload has no such part (LandmarkPayload::seenFrom()), that of the whole
/// surface. None if the landmark has no shape.
std::optional<Eigen::Vector3d> middleOf(const map::Landmark& landmark, const std::vector<Eigen::VectorXd>& values,
                                        const map::KeyFrames& key_frames,
                                        const std::set<base::KeyFrameId>& seen_from = {});

}  // namespace omnimapper::plugins
