#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/source/ExternalImages.h>

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

}  // namespace

void moveImagesToFiles(mrpt::obs::CObservation& observation, const std::string& folder, const std::string& stem) {
  if (auto* image = dynamic_cast<mrpt::obs::CObservationImage*>(&observation)) {
    moveImage(image->image, folder, stem + ".jpg");
  } else if (auto* scan = dynamic_cast<mrpt::obs::CObservation3DRangeScan*>(&observation)) {
    if (scan->hasIntensityImage) moveImage(scan->intensityImage, folder, stem + "_colour.jpg");
    if (scan->hasRangeImage) scan->rangeImage_convertToExternalStorage(stem + "_range.bin", folder + "/");
  }
}

}  // namespace omnimapper::source
