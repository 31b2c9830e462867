#pragma once

#include <filesystem>
#include <string>

namespace omnimapper::source {

/// The camera of a public data set that a folder is a part of, by the words of its path: freiburg1, freiburg2,
/// freiburg3 (also by the heading of its depth.txt), icl_nuim or 7_scenes (also by the names of its scenes). Empty if
/// no word names one.
std::string cameraByName(const std::filesystem::path& folder);

}  // namespace omnimapper::source
