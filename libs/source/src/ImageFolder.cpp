#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/source/ImageFolder.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "ImageSize.h"
#include "NamedTimes.h"
#include "describeInput.h"
#include "refuse.h"

namespace omnimapper::source {

namespace {

namespace fs = std::filesystem;

constexpr double kFirstImage = 1e9;  // [s] stamp of images whose names tell none

constexpr int kInColour = 1;  // MRPT: three channels of 8 bits, whatever the file has

bool isImage(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  const bool is_mask = file.stem().extension() == ".mask";
  return !is_mask && (extension == ".jpg" || extension == ".jpeg" || extension == ".png");
}

mrpt::obs::CObservationImage::Ptr imageIn(const std::string& file, double focal_px) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) refuse(file, "is no file");
  if (const auto why = whyTooLarge(file)) refuse(file, *why);
  auto image = mrpt::obs::CObservationImage::Create();
  bool is_decoded = false;
  try {
    is_decoded = image->image.loadFromFile(file, kInColour) && !image->image.isEmpty();
  } catch (const std::exception&) {  // OpenCV's, for a file without bytes, which MRPT passes on
  }
  if (!is_decoded) refuse(file, "cannot be decoded");
  const double width = static_cast<double>(image->image.getWidth());
  const double height = static_cast<double>(image->image.getHeight());
  const double focal = focal_px > 0 ? focal_px : width;
  image->cameraParams.ncols = static_cast<std::uint32_t>(width);
  image->cameraParams.nrows = static_cast<std::uint32_t>(height);
  image->cameraParams.setIntrinsicParamsFromValues(focal, focal, 0.5 * (width - 1), 0.5 * (height - 1));
  image->cameraPose = mrpt::poses::CPose3D(0, 0, 0, -M_PI / 2, 0, -M_PI / 2);
  return image;
}

}  // namespace

ImageFolder::ImageFolder(const std::string& folder, const ImageFolderOptions& options) : options_(options) {
  std::error_code error;
  if (fs::is_regular_file(folder, error)) refuse(folder, "is no folder: it " + describeInput(folder));
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (isImage(entry.path())) files_.push_back(entry.path());
  if (error) refuse(folder, error.message());
  if (files_.empty()) refuse(folder, "holds no JPEG or PNG images: it " + describeInput(folder));
  std::sort(files_.begin(), files_.end());
  times_ = timesOfNames(files_);
}

mrpt::obs::CObservation::Ptr ImageFolder::next() {
  while (next_ < files_.size()) {
    const std::string& file = files_[next_];
    const double stamp = times_.empty() ? kFirstImage + static_cast<double>(next_) / options_.rate : times_[next_];
    ++next_;
    try {
      auto image = imageIn(file, options_.focal_px);
      image->timestamp = base::stampFromUnix(stamp);
      image->sensorLabel = options_.label;
      ++report_.objects;
      report_.count(image->sensorLabel, image->GetRuntimeClass()->className, image->timestamp);
      return image;
    } catch (const base::Error& error) {
      if (report_.missing_images++ == 0) report_.first_missing_image = error.what();
    }
  }
  report_.ending = SourceReport::Ending::complete;
  return nullptr;
}

double ImageFolder::progress() const {
  return static_cast<double>(next_) / static_cast<double>(files_.size());
}

}  // namespace omnimapper::source
