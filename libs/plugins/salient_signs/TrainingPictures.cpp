#include "TrainingPictures.h"

#include <omnimapper/base/CsvTable.h>
#include <omnimapper/base/Error.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "Pixels.h"
#include "Plate.h"

namespace omnimapper::signs {

namespace {

namespace fs = std::filesystem;

constexpr char kMask[] = ".mask";
constexpr int kLeastMask = 50;  // smallest number of pixels of a sign in a mask

[[noreturn]] void refusePictures(const std::string& path, const std::string& why) {
  throw base::Error(base::ExitCode::unreadable_input, path + ": " + why);
}

mrpt::img::CImage load(const std::string& path) {
  mrpt::img::CImage image;
  if (!image.loadFromFile(path)) refusePictures(path, "is no picture that can be read");
  try {
    pixelsOf(image);
  } catch (const base::Error& error) {
    refusePictures(path, error.what());
  }
  return image;
}

// Whether the four corners go clockwise, as seen in the picture, around a convex region.
bool isQuadrilateral(const Corners& corners) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d side = (corners[(i + 1) % 4] - corners[i]).cast<double>();
    const Eigen::Vector2d next = (corners[(i + 2) % 4] - corners[(i + 1) % 4]).cast<double>();
    if (!(side.x() * next.y() - side.y() * next.x() > 0)) return false;
  }
  return true;
}

bool isPicture(const fs::path& path) {
  const std::string ending = path.extension().string();
  return (ending == ".jpg" || ending == ".jpeg" || ending == ".png") && path.stem().extension() != kMask;
}

std::vector<TrueSign> signsOfMask(const std::string& path) {
  const mrpt::img::CImage image = load(path);
  const auto picture = pixelsOf(image);
  cv::Mat labels, statistics, middles;
  const int count =
      cv::connectedComponentsWithStats(greyOf(matOf(picture), picture.order) > 127, labels, statistics, middles);
  std::vector<TrueSign> signs;
  for (int i = 1; i < count; ++i) {
    if (statistics.at<int>(i, cv::CC_STAT_AREA) < kLeastMask) continue;
    std::vector<cv::Point> points;
    cv::findNonZero(labels == i, points);
    signs.push_back({"", outermostCorners(points), 1});
  }
  return signs;
}

// Adds the signs of the table to their pictures. The table need not name every picture.
void addSigns(const std::string& path, std::vector<TrainingPicture>& pictures) {
  const base::CsvTable table(path, "table of signs");
  for (std::size_t row = 0; row < table.size(); ++row) {
    const std::string& name = table.text(row, "image");
    const auto picture =
        std::find_if(pictures.begin(), pictures.end(), [&](const auto& each) { return each.name == name; });
    if (picture == pictures.end()) table.refuse(row, "there is no picture '" + name + "' beside it");
    TrueSign sign;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::string number = std::to_string(i + 1);
      sign.corners_px[i] =
          Eigen::Vector2d(table.number(row, "x" + number), table.number(row, "y" + number)).cast<float>();
    }
    if (!isQuadrilateral(sign.corners_px)) {
      table.refuse(row,
                   "its corners form no convex region: give them in the order upper left, upper right, lower "
                   "right, lower left");
    }
    if (table.has("sign")) sign.sign = table.text(row, "sign");
    if (table.has("visible")) sign.visible = table.number(row, "visible");
    if (sign.visible < 0 || sign.visible > 1)
      table.refuse(row, "column visible: the share of the sign that is seen must be from 0 to 1");
    picture->signs.push_back(std::move(sign));
  }
}

}  // namespace

bool counts(const TrueSign& sign) {
  constexpr double kWhole = 0.9;
  constexpr float kLeastHeight = 24;  // [px]
  return sign.visible >= kWhole && boundsOf(sign.corners_px).height >= kLeastHeight;
}

TrainingSet readTrainingFolder(const std::string& folder) {
  std::error_code error;
  TrainingSet set;
  set.name = fs::path(folder).lexically_normal().filename().string();
  if (set.name.empty()) set.name = fs::path(folder).lexically_normal().parent_path().filename().string();
  const std::string table = folder + "/signs.csv";
  const bool has_table = fs::exists(table, error);
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string path = entry.path().string(),
                      mask = (fs::path(folder) / entry.path().stem()).string() + kMask + ".png";
    if (!isPicture(entry.path()) || (!has_table && !fs::exists(mask, error))) continue;
    set.pictures.push_back({entry.path().filename().string(), [path] { return load(path); },
                            has_table ? std::vector<TrueSign>{} : signsOfMask(mask)});
  }
  if (error) refusePictures(folder, "cannot be read (" + error.message() + "); name a folder of pictures");
  if (set.pictures.empty())
    refusePictures(folder,
                   "has no picture with its signs: put signs.csv beside the pictures, or NAME.mask.png beside each");
  std::sort(set.pictures.begin(), set.pictures.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  if (has_table) addSigns(table, set.pictures);
  return set;
}

}  // namespace omnimapper::signs
