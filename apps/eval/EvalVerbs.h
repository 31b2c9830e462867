#pragma once

#include <omnimapper/eval/ObjectTruth.h>

#include <string>
#include <vector>

#include "program/Program.h"

namespace omnimapper::evaluation {

struct Arguments {
  std::string estimate, reference, output_folder, json_file;
  double tolerance = 0.01, interpolate = 0;          // [s]
  std::vector<double> base_from_sensor = {0, 0, 0};  // x y [m] yaw [deg]
  std::string alignment = "none", unit = "frames";
  bool solves_offset = false;         // in the verb "ate"
  std::string map_alignment = "se3";  // in the verbs "map", "views" and "objects"
  double delta = 1;
  std::string log;                // log that the verb "views" reads
  std::size_t views = 200;        // largest number of depth images that the verb "views" uses
  int pixels = 300, images = 20;  // of an object, in the verbs "seen" and "objects"
  double distance = 0;            // of an object, in the verbs "seen" and "objects"; 0: any [m]
  std::string curve_file;         // that the verb "objects" writes
};

/// Runs the verb (ate, rpe, relations, map, views, seen or objects), prints and writes its result, and returns the exit
/// code.
int run(const std::string& verb, const Arguments& arguments);

/// Adds --solve-offset to the verb ate, and returns the verb.
CLI::App* addOffset(CLI::App* verb, Arguments& arguments);

/// The verb map: compares the surfaces of a map with the true ones.
int judgeMap(const Arguments& arguments);
/// The verb views: compares the surfaces of a map with the depth images of a log.
int judgeByViews(const Arguments& arguments);
/// The verb seen: counts the images of a simulated log that show each object.
void addSeen(CLI::App& app, Arguments& arguments);
int countSeen(const Arguments& arguments);
/// The verb objects: compares the objects of a map with the true ones.
void addObjects(CLI::App& app, Arguments& arguments);
int judgeObjects(const Arguments& arguments);
/// What an object must show to count as seen: the options, and what they are set to.
void addSeenLimits(CLI::App* verb, Arguments& arguments);
eval::SeenLimits seenLimits(const Arguments& arguments);

}  // namespace omnimapper::evaluation
