#include "RgbdFolderForms.h"

#include <omnimapper/base/InputFile.h>
#include <omnimapper/source/describeInput.h>
#include <omnimapper/source/refuse.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <sstream>

#include "ImagesByName.h"
#include "cameraByName.h"
#include "pairImages.h"

namespace omnimapper::source {

namespace fs = std::filesystem;

namespace {

/// Reads a list of "stamp ..." lines; '#' begins a comment.
std::vector<std::pair<base::Stamp, std::string>> readList(const fs::path& path) {
  auto in = base::openInput(path);
  std::vector<std::pair<base::Stamp, std::string>> list;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::string stamp, rest;
    if (!(words >> stamp) || stamp.front() == '#') continue;
    std::getline(words >> std::ws, rest);
    while (!rest.empty() && std::isspace(static_cast<unsigned char>(rest.back()))) rest.pop_back();
    try {
      list.emplace_back(base::parseUnix(stamp), rest);
    } catch (const base::Error&) {
      refuse(path, "line " + std::to_string(number) + " begins with '" + stamp + "', which is no stamp in seconds");
    }
  }
  return list;
}

geometry::Se3 parsePose(const std::string& text, const fs::path& path) {
  std::istringstream in(text);
  double v[7];
  for (double& value : v) {
    if (!(in >> value)) refuse(path, "'" + text + "' is no pose x y z qx qy qz qw");
  }
  const Eigen::Quaterniond rotation(v[6], v[3], v[4], v[5]);
  if (!(rotation.norm() > 0.5)) refuse(path, "'" + text + "' has no unit quaternion qx qy qz qw at its end");
  return {rotation.normalized(), {v[0], v[1], v[2]}};
}

std::vector<std::pair<base::Stamp, geometry::Se3>> readPoses(const fs::path& path) {
  std::vector<std::pair<base::Stamp, geometry::Se3>> poses;
  for (const auto& [stamp, text] : readList(path)) poses.emplace_back(stamp, parsePose(text, path));
  return poses;
}

RgbdFolderContent readTum(const fs::path& folder, const RgbdFolderOptions& options) {
  RgbdFolderContent content;
  auto depths = readList(folder / "depth.txt"), colours = readList(folder / "rgb.txt");
  const fs::path key_frame_poses = folder / "truth_cam_poses.txt", poses = folder / "groundtruth.txt";
  if (fs::exists(poses)) {
    content.world_from_optical = readPoses(poses);
  } else if (fs::exists(key_frame_poses)) {
    content.world_from_optical = readPoses(key_frame_poses);
    const auto& known = content.world_from_optical;
    if (known.size() != depths.size() || known.size() != colours.size())
      refuse(key_frame_poses, "must have as many lines as depth.txt and rgb.txt, one for each image");
    for (std::size_t i = 0; i < known.size(); ++i) depths[i].first = colours[i].first = known[i].first;
  }
  content.pairs = pairImages(folder, depths, colours, options.largest_difference);
  content.usual_intrinsics = cameraByName(folder);
  return content;
}

// A line of ICL-NUIM's own list: "1 depth/1.png 1 rgb/1.png", or the colour first; running numbers, or stamps.
RgbdFolderContent readAssociations(const fs::path& path, const RgbdFolderOptions& options) {
  RgbdFolderContent content;
  auto in = base::openInput(path);
  const fs::path folder = path.parent_path();
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    std::string stamp, first, other_stamp, second;
    if (!(words >> stamp) || stamp.front() == '#') continue;
    if (!(words >> first >> other_stamp >> second))
      refuse(path, "line " + std::to_string(number) + " is not of the form \"1 depth/1.png 1 rgb/1.png\"");
    const bool depth_first = first.find("depth") != std::string::npos;
    const bool is_number = std::all_of(stamp.begin(), stamp.end(), [](unsigned char c) { return std::isdigit(c); });
    try {
      const auto own = base::parseUnix(depth_first ? stamp : other_stamp);
      content.pairs.push_back({is_number ? stampOfImage(content.pairs.size(), options) : own,
                               (folder / (depth_first ? first : second)).string(),
                               (folder / (depth_first ? second : first)).string()});
    } catch (const base::Error&) {
      refuse(path,
             "line " + std::to_string(number) + " has '" + stamp + "', which is no number and no stamp in seconds");
    }
  }
  if (content.pairs.empty()) refuse(path, "lists no images");
  content.usual_intrinsics = cameraByName(folder);
  return content;
}

geometry::Se3 readMatrix(const fs::path& path) {
  auto in = base::openInput(path);
  Eigen::Matrix4d m;
  for (int i = 0; i < 16; ++i) {
    if (!(in >> m(i / 4, i % 4))) refuse(path, "holds no 4 x 4 matrix of a pose");
  }
  return {Eigen::Quaterniond(m.topLeftCorner<3, 3>()).normalized(), m.topRightCorner<3, 1>()};
}

RgbdFolderContent readSevenScenes(const fs::path& folder, const RgbdFolderOptions& options) {
  RgbdFolderContent content;
  content.usual_intrinsics = cameraByName(folder);
  content.usual_depth_units = 1000;
  std::vector<std::string> stems;
  for (const auto& [stem, path] : filesByStem(folder, ".png")) {
    const std::string end = ".depth";
    if (stem.size() > end.size() && stem.compare(stem.size() - end.size(), end.size(), end) == 0)
      stems.push_back(stem.substr(0, stem.size() - end.size()));
  }
  for (std::size_t i = 0; i < stems.size(); ++i) {
    const std::string stem = (folder / stems[i]).string();
    std::string colour;
    for (const char* form : {".color.png", ".color.jpg"}) {
      if (colour.empty() && fs::exists(stem + form)) colour = stem + form;
    }
    content.pairs.push_back({stampOfImage(i, options), stem + ".depth.png", colour});
    if (fs::exists(stem + ".pose.txt"))
      content.world_from_optical.emplace_back(content.pairs.back().stamp, readMatrix(stem + ".pose.txt"));
  }
  return content;
}

bool isSevenScenes(const LogLook& look) {
  return std::any_of(look.entries.begin(), look.entries.end(), [](const std::string& entry) {
    return entry.rfind("frame-", 0) == 0 && entry.find(".depth.png") != std::string::npos;
  });
}

}  // namespace

bool RgbdFolder::recognizes(const LogLook& look) {
  return look.has("depth.txt") || look.has("associations.txt") || isSevenScenes(look) || hasDepthsByName(look);
}

RgbdFolderContent readRgbdFolder(const fs::path& folder, const RgbdFolderOptions& options) {
  std::error_code error;
  if (fs::is_regular_file(folder, error)) refuse(folder, "is no folder: it " + describeInput(folder));
  if (!fs::is_directory(folder, error)) refuse(folder, "there is no such folder; is the path right?");
  const auto look = LogLook::at(folder);
  RgbdFolderContent content;
  if (look.has("depth.txt"))
    content = readTum(folder, options);
  else if (look.has("rgb.txt"))
    refuse(folder, "has rgb.txt but no depth.txt: a TUM RGB-D folder needs both");
  else if (look.has("associations.txt"))
    content = readAssociations(folder / "associations.txt", options);
  else if (isSevenScenes(look))
    content = readSevenScenes(folder, options);
  else if (hasDepthsByName(look))
    content = readImagesByName(look, options);
  else
    refuse(folder,
           "is no folder of RGB-D images in a known form. Known are depth.txt with rgb.txt (TUM), associations.txt, "
           "depth/ or depths/ alone or with rgb/, color/ or image/, a folder of nothing but depth images (PNG with 16 "
           "bits of grey), and frame-*.depth.png (7-Scenes); it " +
               describeInput(folder));
  std::stable_sort(content.pairs.begin(), content.pairs.end(),
                   [](const RgbdPair& a, const RgbdPair& b) { return a.stamp < b.stamp; });
  return content;
}

}  // namespace omnimapper::source
