#include "RgbdFolderForms.h"

#include <omnimapper/base/InputFile.h>
#include <omnimapper/source/describeInput.h>
#include <omnimapper/source/refuse.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <sstream>

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

using Image = std::pair<base::Stamp, std::string>;

/// Pairs each depth image with the colour image nearest in time. A colour image is paired with its nearest depth image
/// only; the others stay without colour.
std::vector<RgbdPair> pairImages(const fs::path& folder, const std::vector<Image>& depths,
                                 const std::vector<Image>& colours, double largest_difference) {
  struct Candidate {
    double difference;
    std::size_t depth, colour;
  };
  std::vector<Candidate> candidates;
  for (std::size_t d = 0; d < depths.size(); ++d) {
    for (std::size_t c = 0; c < colours.size(); ++c) {
      const double difference = std::abs(base::secondsBetween(depths[d].first, colours[c].first));
      if (difference <= largest_difference) candidates.push_back({difference, d, c});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.difference < b.difference; });
  std::vector<bool> colour_taken(colours.size(), false);
  std::vector<std::string> colour_of(depths.size());
  for (const Candidate& candidate : candidates) {
    if (colour_taken[candidate.colour] || !colour_of[candidate.depth].empty()) continue;
    colour_taken[candidate.colour] = true;
    colour_of[candidate.depth] = (folder / colours[candidate.colour].second).string();
  }
  std::vector<RgbdPair> pairs;
  for (std::size_t d = 0; d < depths.size(); ++d)
    pairs.push_back({depths[d].first, (folder / depths[d].second).string(), colour_of[d]});
  return pairs;
}

// Whether a folder's path contains `word` as a whole word, with no letter beside it and no digit beside its number:
// "vehicles" and "iclr" do not contain "icl", and "fr12" does not contain "fr1".
bool hasWord(const fs::path& folder, const std::string& word) {
  const std::string name = fs::absolute(folder).lexically_normal().string();
  const auto goesOn = [](char inside, char beside) {
    const auto of = [](char c, auto is) { return is(static_cast<unsigned char>(c)) != 0; };
    const auto isDigit = [](int c) { return std::isdigit(c); };
    const auto isLetter = [](int c) { return std::isalpha(c); };
    return of(beside, isLetter) || (of(inside, isDigit) && of(beside, isDigit));
  };
  for (std::size_t at = name.find(word); at != std::string::npos; at = name.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || !goesOn(word.front(), name[at - 1]);
    if (begins && (end == name.size() || !goesOn(word.back(), name[end]))) return true;
  }
  return false;
}

std::string freiburgOf(const fs::path& folder) {
  for (const char number : {'1', '2', '3'}) {
    for (const char* word : {"freiburg", "fr"}) {
      if (hasWord(folder, word + std::string(1, number))) return std::string("freiburg") + number;
    }
  }
  // A renamed folder still names the camera at the top of its lists: "# file: 'rgbd_dataset_freiburg1_rpy.bag'".
  std::ifstream list(folder / "depth.txt");
  constexpr int kHeading = 3;
  std::string line;
  for (int i = 0; i < kHeading && std::getline(list, line); ++i) {
    const std::size_t at = line.find("freiburg");
    if (line.rfind('#', 0) != 0 || at == std::string::npos || at + 8 >= line.size()) continue;
    const char number = line[at + 8];
    if (number >= '1' && number <= '3') return std::string("freiburg") + number;
  }
  return "";
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
  content.usual_intrinsics = freiburgOf(folder);
  return content;
}

// Sorts names that are numbers by their value: 2 before 10.
struct ByNumber {
  bool operator()(const std::string& a, const std::string& b) const {
    const auto isNumber = [](const std::string& name) {
      return std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c); });
    };
    const bool a_is_number = isNumber(a), b_is_number = isNumber(b);
    if (a_is_number != b_is_number) return a_is_number;
    const auto digits = [](const std::string& name) {
      return name.substr(std::min(name.find_first_not_of('0'), name.size()));
    };
    const std::string a_digits = digits(a), b_digits = digits(b);
    if (!a_is_number || a_digits == b_digits) return a < b;
    return a_digits.size() != b_digits.size() ? a_digits.size() < b_digits.size() : a_digits < b_digits;
  }
};

std::map<std::string, std::string, ByNumber> filesByStem(const fs::path& folder) {
  std::map<std::string, std::string, ByNumber> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) files[entry.path().stem().string()] = entry.path().string();
  }
  return files;
}

base::Stamp stampOfImage(std::size_t index, const RgbdFolderOptions& options) {
  constexpr double kFirst = 1e9;  // [s] an arbitrary time, as the images have none
  return base::stampFromUnix(kFirst) + base::durationFromSeconds(static_cast<double>(index) / options.rate);
}

RgbdFolderContent readEqualNames(const fs::path& folder, const RgbdFolderOptions& options) {
  RgbdFolderContent content;
  const auto depths = filesByStem(folder / "depth");
  const bool has_rgb = fs::is_directory(folder / "rgb");
  const auto colours = filesByStem(folder / (has_rgb ? "rgb" : "image"));
  content.usual_depth_units = has_rgb ? 5000 : 1000;
  std::size_t index = 0;
  for (const auto& [stem, depth] : depths) {
    const auto colour = colours.find(stem);
    content.pairs.push_back({stampOfImage(index++, options), depth, colour == colours.end() ? "" : colour->second});
  }
  if (std::all_of(content.pairs.begin(), content.pairs.end(), [](const auto& pair) { return pair.colour.empty(); })) {
    refuse(folder,
           "no image in depth/ has the name of one in rgb/ or image/; in a TUM RGB-D folder, where images are named by "
           "their stamps, depth.txt and rgb.txt list which ones belong together: are they missing?");
  }
  if (hasWord(folder, "icl") || hasWord(folder, "ICL")) content.usual_intrinsics = "icl_nuim";
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
  content.usual_intrinsics = freiburgOf(folder);
  if (hasWord(folder, "icl") || hasWord(folder, "ICL")) content.usual_intrinsics = "icl_nuim";
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
  content.usual_intrinsics = "7_scenes";
  content.usual_depth_units = 1000;
  std::vector<std::string> stems;
  for (const auto& [stem, path] : filesByStem(folder)) {
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

bool isOfEqualNames(const LogLook& look) {
  return look.has("depth") && (look.has("rgb") || look.has("image"));
}

}  // namespace

bool RgbdFolder::recognizes(const LogLook& look) {
  return look.has("depth.txt") || look.has("associations.txt") || isOfEqualNames(look) || isSevenScenes(look);
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
  else if (isOfEqualNames(look))
    content = readEqualNames(folder, options);
  else if (isSevenScenes(look))
    content = readSevenScenes(folder, options);
  else
    refuse(folder,
           "is no folder of RGB-D images in a known form. Known are depth.txt with rgb.txt (TUM), associations.txt, "
           "depth/ with rgb/ or image/ (ICL-NUIM), and frame-*.depth.png (7-Scenes); it " +
               describeInput(folder));
  std::stable_sort(content.pairs.begin(), content.pairs.end(),
                   [](const RgbdPair& a, const RgbdPair& b) { return a.stamp < b.stamp; });
  return content;
}

}  // namespace omnimapper::source
