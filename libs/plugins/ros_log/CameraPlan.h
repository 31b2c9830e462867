#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "Survey.h"

namespace omnimapper::ros {

/// How the images of a topic are used.
struct CameraUse {
  bool is_depth = false;
  mrpt::img::TCamera camera;
  std::string frame;              ///< the optical frame: z ahead, x to the right
  std::string picture;            ///< of depths: the topic of the pictures that belong to them; empty: none
  std::string problem;            ///< why the images are left out; empty if they are used
  bool is_part_of_depth = false;  ///< the pictures come with depths and not by themselves
};

/// Finds the camera of each topic of images, by its name or its frame, and the pictures that belong to depths: those in
/// the same frame, else those of a camera that transforms connect and whose name begins like that of the depths.
class CameraPlan {
 public:
  explicit CameraPlan(const Survey& survey);
  /// None for a topic without images.
  const CameraUse* use(const std::string& topic) const;

 private:
  CameraUse useOf(const SensorKey& sensor, const SeenSensor& seen, const Survey& survey) const;
  std::string pictureOfDepths(const std::string& depths, const Survey& survey) const;

  std::map<std::string, CameraUse> uses_;
};

}  // namespace omnimapper::ros
