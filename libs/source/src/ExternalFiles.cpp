#include "ExternalFiles.h"

#include <mrpt/io/lazy_load_path.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/source/ImageFile.h>

#include <filesystem>
#include <mutex>
#include <vector>

#include "PayloadSize.h"

namespace omnimapper::source {

namespace fs = std::filesystem;
using namespace mrpt::obs;

namespace {

class FolderForProcess {
 public:
  explicit FolderForProcess(const std::string& folder) : old_(mrpt::io::getLazyLoadPathBase()) {
    mrpt::io::setLazyLoadPathBase(folder);
  }
  ~FolderForProcess() { mrpt::io::setLazyLoadPathBase(old_); }

 private:
  std::string old_;
};

// MRPT reads the first characters of a name without checking its length.
std::string inFolder(const std::string& file) {
  return file.size() > 2 ? mrpt::io::lazy_load_absolute_path(file) : file;
}

std::vector<std::string> externalFilesOf(const CObservation& observation) {
  std::vector<std::string> files;
  for (const auto* image : imagesOf(observation))
    if (image->isExternallyStored()) files.push_back(inFolder(image->getExternalStorageFile()));
  if (const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation)) {
    if (scan->hasPoints3D && scan->points3D_isExternallyStored())
      files.push_back(inFolder(scan->points3D_getExternalStorageFile()));
    if (scan->hasRangeImage && scan->rangeImage_isExternallyStored()) {
      files.push_back(inFolder(scan->rangeImage_getExternalStorageFile("")));
      for (const auto& layer : scan->rangeImageOtherLayers)
        files.push_back(inFolder(scan->rangeImage_getExternalStorageFile(layer.first)));
    }
  }
  if (const auto* cloud = dynamic_cast<const CObservationPointCloud*>(&observation))
    if (cloud->isExternallyStored()) files.push_back(inFolder(cloud->getExternalStorageFile()));
  return files;
}

}  // namespace

std::optional<std::string> loadExternalFiles(const CObservation& observation, const std::string& folder) {
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  const FolderForProcess folder_for_process(folder);
  const auto files = externalFilesOf(observation);
  for (const auto& file : files) {
    if (!fs::is_regular_file(file)) return file;
    if (const auto reason = whyTooLarge(file)) return file + " (" + *reason + ")";
  }
  try {
    observation.load();
    for (const auto* image : imagesOf(observation)) image->forceLoad();
  } catch (const std::exception& error) {
    return files.empty() ? std::string(error.what()) : files.front();
  }
  return std::nullopt;
}

std::string externalFolderOf(const std::string& rawlog) {
  fs::path stem = fs::path(rawlog).replace_extension();
  if (stem.extension() == ".rawlog") stem.replace_extension();  // x.rawlog.gz
  for (const char* suffix : {"_Images", "_images", "_IMAGES"})
    if (fs::is_directory(stem.string() + suffix)) return stem.string() + suffix;
  const auto shared = fs::path(rawlog).parent_path() / "Images";
  return fs::is_directory(shared) ? shared.string() : stem.string() + "_Images";
}

}  // namespace omnimapper::source
