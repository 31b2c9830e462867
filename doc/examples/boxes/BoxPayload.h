#pragma once

#include <omnimapper/map/PayloadRegistry.h>

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "Box.h"

namespace boxes {

/// The payload: what is known of a box beside the position of its middle.
struct BoxPayload : omnimapper::map::LandmarkPayload {
  std::map<std::string, double> classes;           ///< with the sums of their scores
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< [m] the mean of all measurements
  omnimapper::base::KeyFrameId frame;              ///< which measured the axes
  Eigen::Quaterniond base_from_box{1, 0, 0, 0};    ///< the axes in the base of that key frame
  std::uint32_t measurements = 0;

  std::string_view kind() const override { return "box"; }
  void write(std::ostream& out) const override;
  std::vector<omnimapper::base::KeyFrameId> keyFrames() const override { return {frame}; }
  omnimapper::map::LandmarkShape shape(const std::vector<Eigen::VectorXd>& values,
                                       const omnimapper::map::KeyFrames& key_frames) const override;
  /// Registers the reader of what write() wrote.
  static void addTo(omnimapper::map::PayloadRegistry& registry);

  /// The class with the largest sum; empty if none is known.
  std::string classLabel() const;
  /// A copy with one more measurement.
  std::shared_ptr<const BoxPayload> with(const Box& box, omnimapper::base::KeyFrameId seen_from) const;
  /// A copy with the measurements of another landmark.
  std::shared_ptr<const BoxPayload> with(const BoxPayload& other) const;
};

}  // namespace boxes
