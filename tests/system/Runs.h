#pragma once

#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/ChildProgram.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

/// Runs omnimapper-graphslam as a user does.
namespace runs {

namespace fs = std::filesystem;
using omnimapper::base::ExitCode;
using omnimapper::testing::Ended;
using omnimapper::testing::ProgramOptions;
using Texts = std::vector<std::string>;

/// The command line that maps the logs with ini/laser2d.ini.
inline Texts mappingCommand(const Texts& logs, const std::string& output_folder, const Texts& more = {}) {
  Texts words{omnimapper::testing::ownProgram("omnimapper-graphslam"), "-i",
              omnimapper::testing::sourceFile("ini/laser2d.ini")};
  for (const auto& log : logs) words.insert(words.end(), {"-r", log});
  words.insert(words.end(), {"-o", output_folder});
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

inline Ended map(const Texts& logs, const std::string& output_folder, const Texts& more = {},
                 const ProgramOptions& options = {}) {
  return omnimapper::testing::runProgram(mappingCommand(logs, output_folder, more), options);
}

inline Ended graphslam(const Texts& arguments) {
  Texts words{omnimapper::testing::ownProgram("omnimapper-graphslam")};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return omnimapper::testing::runProgram(words);
}

inline int number(ExitCode code) {
  return static_cast<int>(code);
}

/// Whether the program ended by itself with that code and printed all of the words to standard error.
inline ::testing::AssertionResult endedWith(ExitCode code, const Ended& ended, const Texts& words = {}) {
  if (ended.code != number(code)) {
    return ::testing::AssertionFailure() << "expected code " << number(code) << ", but it " << toString(ended);
  }
  for (const auto& word : words) {
    if (ended.err.find(word) != std::string::npos) continue;
    return ::testing::AssertionFailure() << "standard error lacks '" << word << "'; it " << toString(ended);
  }
  return ::testing::AssertionSuccess();
}

inline std::string readFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::string writeFile(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

/// Names of the files and folders in a folder as `ls` shows them. Empty if the folder does not exist.
inline std::set<std::string> filesIn(const std::string& folder) {
  std::set<std::string> names;
  if (!fs::exists(folder)) return names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  names.erase(".omnimapper");
  return names;
}

/// The bytes of every file directly in a folder, by name.
inline std::map<std::string, std::string> contentsOf(const std::string& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) contents[entry.path().filename()] = readFile(entry.path());
  }
  return contents;
}

/// Names of the files that a run with ini/laser2d.ini writes.
inline const std::set<std::string>& allOutputs() {
  static const std::set<std::string> names{"trajectory.tum", "graph.g2o",    "grid.pgm",        "grid.yaml",
                                           "grid.png",       "points.ply",   "map.omnimap",     "map.png",
                                           "scene.3Dscene",  "summary.json", "report.html",     "rooms.json",
                                           "rooms.png",      "plan.svg",     "scene_graph.json"};
  return names;
}

}  // namespace runs
