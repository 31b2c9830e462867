#pragma once

#include <omnimapper/building/Storey.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::building {

/// How often each class of surface (surfaces::SurfaceClass) was seen in a room: {"bed", 2}.
using RoomContents = std::map<std::string, int>;

/// A property of rooms that differs between kinds, in a few bins: the number of surfaces of a class, or the shape.
struct KindFeature {
  std::string name;  ///< "bed", ..., or "area", "squares", "doors"
  std::size_t bins;
};
const std::vector<KindFeature>& kindFeatures();
/// The bin of each feature, in their order. "squares" is the number of squares as wide as the room that cover it.
std::vector<std::size_t> kindBins(const Room& room, std::size_t doors, const RoomContents& contents);

/// For each kind of room and each feature the logarithm of the probability of each bin.
struct KindModel {
  std::vector<std::string> kinds;
  std::vector<std::vector<std::vector<double>>> log_likelihood;  ///< by kind, feature and bin
  /// Features are not independent; the sum of their logarithms is multiplied with this.
  double tempering = 0.6;
};
/// The model that bench-room_kinds learned on simulated plans (doc/results/rooms.md).
const KindModel& learnedKinds();

/// Each kind with its probability, the likeliest first; all kinds are equally frequent before. If no camera saw what is
/// in the rooms, only the shape counts.
std::vector<std::pair<std::string, double>> likelyKinds(const KindModel& model, const std::vector<std::size_t>& bins,
                                                        bool sees_things);

/// Sets kind and its evidence of each room by its contents. `contents` is by the ids of the rooms; `sees_things` is
/// false for a map in which nothing but walls can be seen, such as that of a laser.
void nameByContents(Storey& storey, const std::map<int, RoomContents>& contents, bool sees_things);

}  // namespace omnimapper::building
