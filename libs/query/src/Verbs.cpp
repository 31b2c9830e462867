#include <omnimapper/base/Error.h>
#include <omnimapper/query/Verbs.h>

#include "Answers.h"
#include "CorrectionAnswers.h"
#include "RoomAnswers.h"
#include "SurfaceAnswers.h"

namespace omnimapper::query {

const std::vector<Verb>& verbs() {
  using Range = NumberOption::Range;
  static const std::vector<Verb> all{
      {"find",
       "where the landmarks of that name are; the word find may be left out",
       "TEXT",
       "text on the landmark, its kind, or words of its properties",
       1,
       -1,
       {},
       answerFind,
       {{"on", "name of a table or another surface: only what stands on it"}}},
      {"near",
       "landmarks nearest to a point, by the distance to their extents",
       "X Y",
       "the point, in the frame of the map [m]",
       2,
       2,
       {{"within", "largest distance [m]; default: the five nearest", 1, Range::not_negative}},
       answerNear},
      {"goal",
       "a free pose in the room of that name, or in front of the landmark, facing it",
       "TEXT",
       "name of the room or landmark to go to, as for find",
       1,
       -1,
       {{"from", "X Y of the start [m]; default: the last pose of the base", 2, Range::any},
        {"radius", "radius of the robot [m]; default 0.25", 1, Range::not_negative},
        {"distance", "distance from the target [m]; default 1", 1, Range::positive}},
       answerGoal},
      {"list",
       "all landmarks of a kind, or how many there are of each kind",
       "KIND",
       "such as sign or wall",
       0,
       -1,
       {},
       answerList},
      {"looked",
       "what was seen on the surface of that name, what is gone from it, and when it was looked at last",
       "SURFACE",
       "name of a table or another surface, as for find",
       1,
       -1,
       {},
       answerLooked},
      {"rooms", "all rooms, and the rooms behind known doors that were not seen", "", "", 0, 0, {}, answerRooms},
      {"where",
       "the room at a point: where am i X Y; without a point that of the last pose. where is TEXT is find TEXT",
       "am i [X Y]",
       "the point, in the frame of the map [m]",
       0,
       -1,
       {},
       answerWhere},
      {"in", "what is in the room of that name", "ROOM", "name of a room, or room and its number", 1, -1, {}, answerIn},
      {"which",
       "the room that the landmark of that name is in: which room is TEXT in",
       "TEXT",
       "name of the landmark, as for find",
       1,
       -1,
       {},
       answerWhich},
      {"path",
       "the shortest way for a robot, and the rooms and doors on it: path kitchen to 213",
       "A to B",
       "names of rooms or landmarks, points as X,Y, or here",
       2,
       -1,
       {{"radius", "radius of the robot [m]; default 0.25", 1, Range::not_negative}},
       answerPath},
      {"between",
       "doors, rooms on the way and landmarks between two places: between kitchen and 213",
       "A and B",
       "names of rooms or landmarks, points as X,Y, or here",
       2,
       -1,
       {{"radius", "radius of the robot [m]; default 0.25", 1, Range::not_negative}},
       answerBetween},
      {"loops", "the loop closures that the map rests on", "", "", 0, 0, {}, answerLoops},
      {"deleted", "the landmarks that people deleted (omnimapper-edit)", "", "", 0, 0, {}, answerDeleted},
      {"layers", "what the map holds beside key frames and landmarks", "", "", 0, 0, {}, answerLayers}};
  return all;
}

void expectWords(const Verb& verb, const Request& request) {
  if (request.words.size() < static_cast<std::size_t>(verb.least_words))
    throw base::Error(base::ExitCode::command_line,
                      "after MAP, " + verb.name + " needs " + verb.words + ": " + verb.words_help + "; see --help");
}

}  // namespace omnimapper::query
