#pragma once

#include <omnimapper/map/Places.h>
#include <omnimapper/query/Goal.h>
#include <omnimapper/query/MapToAsk.h>
#include <omnimapper/query/RoomsAsked.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "PlaceJson.h"

namespace omnimapper::query {

/// What a text of a route stands for: "here" or "X,Y" for a point; else a room, an unseen room, a door or a landmark.
struct Target {
  std::string title;         ///< "kitchen (room 3)"
  Eigen::Vector2d position;  ///< [m] its middle
  const building::Room* room = nullptr;
  const map::Place* place = nullptr;
  bool is_near = false;  ///< the name is only similar to the text
};

/// The best match of a text, rooms before landmarks of an equally good name; none if nothing is called so. Throws
/// Error(command_line) if the text cannot be that of anything, or is "here" and the map has no last pose.
std::optional<Target> targetCalled(const MapToAsk& map, const std::string& text);

/// "kitchen (room 3)", "room 3"; of an unseen room: "118 (not seen)".
std::string titleOf(const building::Room& room);
std::string titleOf(const FoundRoom& found);

/// A point of the target at which a robot can stand: of a room its centre, of a region of labels the middle of it, of
/// a landmark the goal before it, of a point itself. None if there is none.
std::optional<Eigen::Vector2d> standAt(const Target& target, const Eigen::Vector2d& from, const RoomToMove& room,
                                       const GridMap& grid);

/// The words before and after the first `between` ("to", "and"), or if there is none, the two words. Throws
/// Error(command_line) for any other number of words.
std::pair<std::string, std::string> twoTexts(const std::vector<std::string>& words, const std::string& between);

Json jsonOf(const building::Room& room, const building::Storey& storey);
Json jsonOf(const building::UnseenRoom& room);
/// Its id and name, or null.
Json briefJson(const building::Room* room);
Json jsonOf(const Target& target);

}  // namespace omnimapper::query
