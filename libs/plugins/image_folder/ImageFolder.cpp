#include "ImageFolder.h"

#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/source/ImageFile.h>
#include <omnimapper/source/refuse.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace omnimapper::source {

namespace {

namespace fs = std::filesystem;

constexpr int kInColour = 1;  // for MRPT: three channels of 8 bits, whatever the file has

std::string extensionOf(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

bool isPicture(const std::string& path) {
  const std::string extension = extensionOf(path);
  return extension == ".jpg" || extension == ".jpeg" || extension == ".png";
}

bool isImage(const std::string& path) {
  return isPicture(path) && fs::path(path).stem().extension() != ".mask";
}

bool isText(const std::string& path) {
  const std::string extension = extensionOf(path);
  return extension == ".txt" || extension == ".csv" || extension == ".json" || extension == ".md";
}

mrpt::obs::CObservationImage::Ptr imageIn(const std::string& file, double focal_px) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) refuse(file, "is no regular file");
  if (const auto why = whyTooLarge(file)) refuse(file, *why);
  if (isDeepGrey(file))
    refuse(file,
           "has 16 bits of grey, as depth images have, and is no photograph; folders of such images are read as the "
           "format rgbd_folder");
  if (isCutOff(file)) refuse(file, "its end is missing, so it was cut off; copy it again");
  auto image = mrpt::obs::CObservationImage::Create();
  bool is_decoded = false;
  try {
    is_decoded = image->image.loadFromFile(file, kInColour) && !image->image.isEmpty();
  } catch (const std::exception&) {  // OpenCV throws for a file without bytes, and MRPT passes that on
  }
  if (!is_decoded) refuse(file, "cannot be decoded as an image");
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

const base::OptionTable<ImageFolderOptions>& ImageFolderOptions::table() {
  static const auto table = base::OptionTable<ImageFolderOptions>()
                                .text("label", &ImageFolderOptions::label, "Sensor label.")
                                .number("rate_hz", &ImageFolderOptions::rate, base::Range::positive(),
                                        "Rate of images whose names are no Unix times.")
                                .number("focal_px", &ImageFolderOptions::focal_px, base::Range::notNegative(),
                                        "Focal length; 0: the width of an image, which is a view of 53 deg.");
  return table;
}

bool ImageFolder::recognizes(const LogLook& look) {
  const auto& entries = look.entries;
  return look.is_folder && std::any_of(entries.begin(), entries.end(), isImage) &&
         std::all_of(entries.begin(), entries.end(),
                     [&](const std::string& entry) {
                       return (isPicture(entry) && entry.find(".depth.") == std::string::npos) || isText(entry);
                     }) &&
         !holdsDeepGrey(look);
}

void ImageFolder::noteAtEnd(SourceReport& report) const {
  if (focal_px_ == 0)
    report.notes.emplace_back("camera: assumed, with a view of 53 deg; focal_px sets its focal length");
}

ImageFolder::ImageFolder(const std::string& folder, const ImageFolderOptions& options)
    : FolderSource(folder, isImage, "JPEG or PNG images", options.label, options.rate), focal_px_(options.focal_px) {}

mrpt::obs::CObservation::Ptr ImageFolder::read(const std::string& file) {
  return imageIn(file, focal_px_);
}

}  // namespace omnimapper::source
