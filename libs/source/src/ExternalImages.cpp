#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/source/ExternalImages.h>

#include <array>

#include "PayloadSize.h"

namespace omnimapper::source {

namespace {

constexpr int kJpegQuality = 95;

void moveImage(mrpt::img::CImage& image, const std::string& folder, const std::string& name) {
  const std::string path = folder + "/" + name;
  if (!image.saveToFile(path, kJpegQuality)) {
    throw base::Error(base::ExitCode::disk_full, path + ": cannot be written whole; is the disk full?");
  }
  image.setExternalStorage(name);
}

// MRPT does not notice if its compressed file cannot be written whole, so the bytes in the file are counted.
void moveRanges(mrpt::obs::CObservation3DRangeScan& scan, const std::string& folder, const std::string& name) {
  const std::size_t expected = sizeof(std::uint16_t) * static_cast<std::size_t>(scan.rangeImage.size());
  scan.rangeImage_convertToExternalStorage(name, folder + "/");
  const std::string path = folder + "/" + name;
  mrpt::io::CFileGZInputStream file;
  std::size_t held = 0;
  if (file.open(path)) {
    std::array<char, 1 << 16> part;
    for (std::size_t size = 1; size > 0; held += size) size = file.Read(part.data(), part.size());
  }
  if (held < expected)
    throw base::Error(base::ExitCode::disk_full, path + ": cannot be written whole; is the disk full?");
}

}  // namespace

void moveImagesToFiles(mrpt::obs::CObservation& observation, const std::string& folder, const std::string& name) {
  const std::string stem = base::asFileName(name);
  if (auto* image = dynamic_cast<mrpt::obs::CObservationImage*>(&observation)) {
    moveImage(image->image, folder, stem + ".jpg");
  } else if (auto* scan = dynamic_cast<mrpt::obs::CObservation3DRangeScan*>(&observation)) {
    if (scan->hasIntensityImage) moveImage(scan->intensityImage, folder, stem + "_colour.jpg");
    if (scan->hasRangeImage) moveRanges(*scan, folder, stem + "_range.bin");
  }
}

mrpt::obs::CObservation::Ptr withImagesInside(const mrpt::obs::CObservation::Ptr& observation) {
  auto copy = mrpt::ptr_cast<mrpt::obs::CObservation>::from(observation->duplicateGetSmartPtr());
  bool had_files = false;
  for (const auto* image : imagesOf(*copy)) {
    if (!image->isExternallyStored()) continue;
    had_files = true;
    mrpt::img::CImage inside;  // in MRPT only a new image is independent of the file
    image->scaleImage(inside, image->getWidth(), image->getHeight(), mrpt::img::IMG_INTERP_NN);
    const_cast<mrpt::img::CImage&>(*image) = inside;  // the copy is ours
  }
  if (auto* scan = dynamic_cast<mrpt::obs::CObservation3DRangeScan*>(copy.get())) {
    had_files = had_files || scan->rangeImage_isExternallyStored() || scan->points3D_isExternallyStored();
    scan->rangeImage_forceResetExternalStorage();
    scan->points3D_overrideExternalStoredFlag(false);
  }
  if (auto* cloud = dynamic_cast<mrpt::obs::CObservationPointCloud*>(copy.get())) {
    had_files = had_files || cloud->isExternallyStored();
    cloud->setAsExternalStorage("", mrpt::obs::CObservationPointCloud::ExternalStorageFormat::None);
  }
  return had_files ? copy : observation;
}

}  // namespace omnimapper::source
