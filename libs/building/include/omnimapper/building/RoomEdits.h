#pragma once

#include <omnimapper/building/DoorSigns.h>
#include <omnimapper/building/Segmentation.h>

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::building {

/// A change of the rooms by a user. It names no ids but places, so that it also fits a map that was made anew.
struct RoomEdit {
  enum class Kind {
    rename,     ///< points: one in the room
    merge,      ///< points: one in each of two rooms; the lower id stays
    split,      ///< points: the ends of the line; the larger part keeps the id
    remove,     ///< points: one in the room, which becomes no room
    move_door,  ///< points: one at the door, then the ends of its new opening, which is near the old one
  };
  Kind kind = Kind::rename;
  std::string name;                     ///< of rename
  std::vector<Eigen::Vector2d> points;  ///< [m] in the frame of the map
};
std::string toString(RoomEdit::Kind kind);
/// "rename to 'Library' at 2.00 1.50".
std::string toString(const RoomEdit& edit);

/// The edits of a map in their order, and what its place looked like when they were made.
struct RoomEdits {
  std::vector<RoomEdit> edits;
  std::vector<std::vector<Eigen::Vector2d>> outlines;  ///< of the rooms
  std::map<std::string, Eigen::Vector2d> signs;        ///< by texts that only one sign has
  /// Edits whose place was not found in the map, each with what it looked like, in frames of their own. They have none
  /// of their own here.
  std::vector<RoomEdits> elsewhere = {};
};

/// The JSON document edits.json (doc/rooms.md describes it).
std::string encodeEdits(const RoomEdits& edits);
/// Throws Error(unreadable_input), naming file and reason, if it is missing, is no such document, is damaged, or was
/// written by a later version.
RoomEdits readEdits(const std::string& file);
/// Reads such a document; `what` names it in messages.
RoomEdits decodeEdits(const std::string& text, const std::string& what);

/// Applies one edit to the rooms of a grid. Returns why it cannot be applied, with the rooms unchanged; empty if it
/// was.
std::string applyEdit(const RoomEdit& edit, const grid::GridMap& grid, Segmentation& rooms);

/// The motion from the frame of the edits to that of `now`: by signs with the same text, if there are two, else the
/// motion by which most borders of rooms coincide. None if less than 70 % of the edits' rooms would be in rooms of now,
/// or fewer than 65 % of the borders coincide: they are of another place.
std::optional<geometry::Se2> alignEdits(const RoomEdits& edits, const Storey& now,
                                        const std::map<std::string, Eigen::Vector2d>& signs);

/// The edits in another frame; those elsewhere stay as they are. Coordinates of more than kFarthest become kFarthest.
RoomEdits moved(RoomEdits edits, const geometry::Se2& now_from_then);

/// The edits with the outlines and signs of now; those elsewhere stay as they are.
RoomEdits anchoredTo(RoomEdits edits, const Storey& now, const std::map<std::string, Eigen::Vector2d>& signs);

/// The places of those signs whose text no other sign has.
std::map<std::string, Eigen::Vector2d> uniqueSigns(const std::vector<DoorSign>& signs);

}  // namespace omnimapper::building
