#pragma once

#include <omnimapper/base/Id.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/map/Layers.h>
#include <omnimapper/map/MapSection.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::map {

/// A name that somebody gave to something in the map.
struct Label {
  std::string text;  ///< printable UTF-8, not empty
  /// The landmark that has the name, by the id that it had then (Map::landmark() follows merges). None: the name is
  /// that of a place.
  std::optional<base::LandmarkId> landmark;
  /// The named point: where the landmark was pointed at, or where the robot stood. It moves with the map.
  base::KeyFrameId frame;
  Eigen::Vector3d in_frame = Eigen::Vector3d::Zero();  ///< [m] in the base frame of the key frame
  std::string who;                                     ///< origin of the command; may be empty
  base::Stamp when;                                    ///< of the command
  double probability = 1;                              ///< that this was meant
};

/// Somebody who pointed was not understood, and is asked which of these was meant.
struct LabelQuestion {
  std::string text, who;
  base::Stamp when;
  base::KeyFrameId frame;
  struct Choice {
    base::LandmarkId landmark;
    Eigen::Vector3d in_frame = Eigen::Vector3d::Zero();
    double probability = 0;
  };
  std::vector<Choice> choices;  ///< the likeliest first; at least one
};

/// What people named, in the order of the commands, and the question that waits for an answer: the layer "labels" of a
/// map. Several labels with one text are one region (thesis 6.2.2.1).
struct Labels {
  static constexpr char kLayer[] = "labels";
  static constexpr std::uint32_t kLayerVersion = 1;
  /// The kinds of the places (map::Place) that are several landmarks of one label, and of those that have no landmark.
  static constexpr char kRegion[] = "region", kPlace[] = "place";

  std::vector<Label> labels;
  std::optional<LabelQuestion> question;

  std::string toBytes() const;
  /// Throws Error(unreadable_input) if the section is another one, of a later version or damaged: a number that is not
  /// finite, a probability outside of 0 to 1, a label without text, a question without choices.
  static Labels fromSection(const MapSection& section);
  LayerReferences references() const;
};

}  // namespace omnimapper::map
