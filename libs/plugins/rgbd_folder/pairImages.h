#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "RgbdFolderForms.h"

namespace omnimapper::source {

/// An image and its stamp.
using StampedImage = std::pair<base::Stamp, std::string>;

/// Pairs each depth image with the colour image nearest in time, if it is at most `largest_difference` [s] away. A
/// colour image is paired with its nearest depth image only; the others stay without colour. Paths of
/// images are relative to `folder`, which may be empty.
std::vector<RgbdPair> pairImages(const std::filesystem::path& folder, const std::vector<StampedImage>& depths,
                                 const std::vector<StampedImage>& colours, double largest_difference);

/// Sorts names that are numbers by their value: 2 before 10.
struct ByNumber {
  bool operator()(const std::string& a, const std::string& b) const;
};
/// Paths of files by their names without ending.
using FilesByStem = std::map<std::string, std::string, ByNumber>;
/// The files of a folder that end in one of the words of `endings`, as ".png .jpg", whatever their case.
FilesByStem filesByStem(const std::filesystem::path& folder, const std::string& endings);
/// Whether a file ends in one of these words.
bool endsAsOneOf(const std::filesystem::path& file, const std::string& endings);

/// The stamp of an image without one, by its number and the rate.
base::Stamp stampOfImage(std::size_t index, const RgbdFolderOptions& options);

}  // namespace omnimapper::source
