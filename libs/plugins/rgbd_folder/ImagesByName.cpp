#include "ImagesByName.h"

#include <omnimapper/source/ImageFile.h>
#include <omnimapper/source/NamedTimes.h>
#include <omnimapper/source/refuse.h>

#include <algorithm>

#include "cameraByName.h"
#include "pairImages.h"

namespace omnimapper::source {

namespace fs = std::filesystem;

namespace {

constexpr const char *kPictures = ".png .jpg .jpeg .bmp .ppm", *kDepths = ".png .pgm .tif .tiff",
                     *kTexts = ".txt .csv .json .yaml .yml .md";

// A folder of PNGs with 16 bits of grey and of texts. Only the first thousand are looked at.
bool holdsDepthsAlone(const LogLook& look) {
  constexpr int kMostLooks = 1000;
  int depths = 0;
  for (const auto& entry : look.entries) {
    if (endsAsOneOf(entry, kTexts)) continue;
    if (depths < kMostLooks && !isDeepGrey((fs::path(look.path) / entry).string())) return false;
    ++depths;
  }
  return depths > 0;
}

// The images with the times that they are named by; empty if a name is no time.
std::vector<StampedImage> stampedByName(const FilesByStem& files) {
  std::vector<std::string> paths;
  for (const auto& stem_and_path : files) paths.push_back(stem_and_path.second);
  const auto times = timesOfNames(paths);
  std::vector<StampedImage> stamped;
  for (std::size_t i = 0; i < times.size(); ++i) stamped.emplace_back(base::stampFromUnix(times[i]), paths[i]);
  return stamped;
}

std::optional<fs::path> folderOfPictures(const LogLook& look) {
  for (const char* name : {"rgb", "color", "colour", "image", "images"})
    if (look.has(name)) return fs::path(look.path) / name;
  return std::nullopt;
}

std::vector<RgbdPair> pairsOfEqualNames(const FilesByStem& depths, const FilesByStem& colours,
                                        const RgbdFolderOptions& options) {
  const auto stamped = stampedByName(depths);
  std::vector<RgbdPair> pairs;
  for (const auto& [stem, depth] : depths) {
    const auto colour = colours.find(stem);
    const auto stamp = stamped.empty() ? stampOfImage(pairs.size(), options) : stamped[pairs.size()].first;
    pairs.push_back({stamp, depth, colour == colours.end() ? "" : colour->second});
  }
  return pairs;
}

bool isWithoutColour(const std::vector<RgbdPair>& pairs) {
  return std::all_of(pairs.begin(), pairs.end(), [](const auto& pair) { return pair.colour.empty(); });
}

}  // namespace

std::optional<fs::path> folderOfDepths(const LogLook& look) {
  for (const char* name : {"depth", "depths"})
    if (look.has(name) && fs::is_directory(fs::path(look.path) / name)) return fs::path(look.path) / name;
  if (look.is_folder && holdsDepthsAlone(look)) return fs::path(look.path);
  return std::nullopt;
}

bool hasDepthsByName(const LogLook& look) {
  return folderOfDepths(look).has_value();
}

RgbdFolderContent readImagesByName(const LogLook& look, const RgbdFolderOptions& options) {
  RgbdFolderContent content;
  const fs::path folder_of_depths = folderOfDepths(look).value();
  const auto folder_of_pictures = folderOfPictures(look);
  const auto depths = filesByStem(folder_of_depths, kDepths);
  if (depths.empty()) refuse(folder_of_depths, "holds no depth images");
  const auto colours = folder_of_pictures ? filesByStem(*folder_of_pictures, kPictures) : FilesByStem();
  content.pairs = pairsOfEqualNames(depths, colours, options);
  if (!colours.empty() && isWithoutColour(content.pairs))
    content.pairs = pairImages({}, stampedByName(depths), stampedByName(colours), options.largest_difference);
  if (!colours.empty() && isWithoutColour(content.pairs)) {
    refuse(look.path,
           "no image in " + folder_of_depths.filename().string() + "/ has the name of one in " +
               folder_of_pictures->filename().string() +
               "/, or a time near that of one; in a TUM RGB-D folder depth.txt and rgb.txt list which ones belong "
               "together: are they missing?");
  }
  content.usual_intrinsics = cameraByName(look.path);
  const std::string& camera = options.intrinsics.empty() ? content.usual_intrinsics : options.intrinsics;
  const bool is_of_benchmark = camera == "icl_nuim" || camera.rfind("freiburg", 0) == 0;
  content.usual_depth_units = look.has("rgb") && is_of_benchmark ? 5000 : 1000;
  return content;
}

}  // namespace omnimapper::source
