#pragma once

#include <omnimapper/building/Storey.h>
#include <omnimapper/geometry/Se2.h>
#include <omnimapper/map/KeyFrames.h>
#include <omnimapper/map/Labels.h>
#include <omnimapper/map/Places.h>

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::plugins {

/// What one map of a place tells another one of its labels, and of how both lie.
struct LabelledMap {
  map::Labels labels;
  map::Places places;
  std::optional<building::Storey> rooms;
};

/// Reads a map file, or that of a folder. Throws Error(unreadable_input) if it is none, is damaged, or has no places.
LabelledMap readLabelledMap(const std::string& path);

/// The labels of an earlier map in a map of the same place that was made anew.
struct CarriedLabels {
  struct Outcome {
    std::string text;     ///< of the label
    std::string why_not;  ///< it is not carried; empty if it is
  };
  std::vector<map::Label> labels;  ///< on landmarks and key frames of the new map, in the order of the earlier one
  std::vector<Outcome> outcomes;   ///< for each label of the earlier map
};

/// The motion from the frame of the earlier map to that of the new one: that by which edits of rooms are taken over
/// (building::alignEdits()). None if the rooms are not the same, or a map has none.
std::optional<geometry::Se2> motionBetweenMaps(const LabelledMap& earlier, const LabelledMap& now);

/// Carries each label to the landmark of the new map that has about the same class, size, heights and free side at
/// about the same place. A label that fits no landmark, or two about equally well, is not carried. A label of a place
/// is anchored to the key frame nearest to the place, if there is one within 3 m.
CarriedLabels carryLabels(const LabelledMap& earlier, const LabelledMap& now, const geometry::Se2& now_from_earlier,
                          const map::KeyFrames& key_frames);

}  // namespace omnimapper::plugins
