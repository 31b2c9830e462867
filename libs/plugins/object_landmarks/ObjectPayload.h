#pragma once

#include <omnimapper/map/PayloadRegistry.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ObjectEvidence.h"
#include "ObjectModel.h"

namespace omnimapper::plugins {

/// The picture of an object that shows most of it: its own pixels; all else is grey.
struct ObjectPicture {
  int pixels = 0;  ///< of the image that show the object
  std::shared_ptr<const map::Photograph> photograph;
};

/// What the map knows about an object beside the position of the middle of its box.
struct ObjectPayload : map::LandmarkPayload {
  std::shared_ptr<const ObjectModel> model = std::make_shared<const ObjectModel>();
  ObjectEvidence evidence;
  std::uint32_t measured_in = 0;                 ///< number of images in which it was found as an object of its own
  bool is_confirmed = false;                     ///< it was found often enough to be drawn
  std::map<std::string, double> classes;         ///< class labels, with the sums of their scores
  std::map<std::string, std::uint32_t> seen_by;  ///< sensor label: number of measurements
  std::optional<ObjectPicture> picture;
  /// The surface that carries it, and what it is a part of: the table whose leg it is, or the object of which an image
  /// shows it as a piece of its own. Both may have been merged into another landmark since.
  std::optional<base::LandmarkId> on, part_of;

  std::string_view kind() const override { return "object"; }
  void write(std::ostream& out) const override;
  bool fits(const std::vector<std::string_view>& kinds) const override;
  std::vector<base::KeyFrameId> keyFrames() const override;
  std::shared_ptr<const LandmarkPayload> seenFrom(const std::set<base::KeyFrameId>& frames) const override;
  map::LandmarkShape shape(const std::vector<Eigen::VectorXd>& values, const map::KeyFrames& key_frames) const override;
  static void addTo(map::PayloadRegistry& registry);

  /// Whether outputs draw it.
  bool isDrawn() const { return is_confirmed && !part_of; }
  /// The class with the largest sum, or "object" if none is known.
  std::string label() const;
  /// A copy without points and picture, which a candidate that was given up need not keep.
  std::shared_ptr<ObjectPayload> withoutModel() const;
  /// A copy with the measurements of another landmark. The points of both models are fused at the poses of the key
  /// frames.
  std::shared_ptr<ObjectPayload> with(const ObjectPayload& other, const map::KeyFrames& key_frames,
                                      const ModelLimits& limits) const;
};

}  // namespace omnimapper::plugins
