#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/pictures/PerceptionPictures.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>

#include "CameraPicture.h"
#include "LaserPicture.h"

namespace omnimapper::pictures {

namespace {

std::optional<draw::Image> draw(const mrpt::obs::CObservation& raw,
                                const std::vector<mrpt::obs::CObservation::Ptr>& derived) {
  if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&raw)) {
    if (scan->rangeImage.size() > 0) return drawCameraPicture(*scan, derived);
  }
  if (const auto* picture = dynamic_cast<const mrpt::obs::CObservationImage*>(&raw))
    return drawCameraPicture(*picture, derived);
  if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&raw))
    return drawLaserPicture(*scan, derived);
  return std::nullopt;
}

// Labels may contain characters that file names cannot have.
std::string fileName(const mrpt::obs::CObservation& raw) {
  std::string name = raw.sensorLabel + "_" + base::formatUnix(raw.timestamp, 6);
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c) && c != '.' && c != '-' && c != '_'; },
      '_');
  return name + ".png";
}

}  // namespace

PerceptionPictures::PerceptionPictures(const std::string& folder, int every)
    : folder_(folder), every_(every), is_new_(!std::filesystem::exists(folder)) {
  base::makeWritableFolder(folder);
}

PerceptionPictures::~PerceptionPictures() {
  std::error_code is_not_empty;
  if (is_new_) std::filesystem::remove(folder_, is_not_empty);
}

void PerceptionPictures::add(const mrpt::obs::CObservation& raw,
                             const std::vector<mrpt::obs::CObservation::Ptr>& derived) {
  if (derived.empty() || seen_[raw.sensorLabel]++ % every_ != 0) return;
  const auto picture = draw(raw, derived);
  if (!picture) return;
  base::writeFile(folder_ + "/" + fileName(raw), [&](std::ostream& out) { out << draw::encodePng(*picture); });
  ++count_;
}

}  // namespace omnimapper::pictures
