#pragma once

#include <omnimapper/source/ObservationSource.h>

#include <string>
#include <vector>

namespace omnimapper::source {

struct ImageFolderOptions {
  std::string label = "camera";
  double rate = 1;      ///< of images whose names are no Unix times [1/s]
  double focal_px = 0;  ///< focal length; 0: as long as an image is wide
};

/// Streams the JPEG and PNG images of a folder as CObservationImage, in the order of their names; those called
/// NAME.mask.png, which tell what an image shows, are left out. Images of 16 bits, grey
/// ones and those with an alpha channel become three channels of 8 bits. Where all names are Unix times, in seconds or
/// nanoseconds, they are the stamps. The camera is a pinhole whose axis goes through the middle of the image, with
/// cameraPose level: z forward along the base's x.
class ImageFolder : public ObservationSource {
 public:
  /// Throws Error(unreadable_input) for a folder without such images.
  explicit ImageFolder(const std::string& folder, const ImageFolderOptions& options = {});

  /// Files that are no images, and those that say to be larger than any camera's, are left out and counted as missing
  /// images.
  mrpt::obs::CObservation::Ptr next() override;
  double progress() const override;
  SourceReport report() const override { return report_; }
  bool areNamesTimes() const { return !times_.empty(); }

 private:
  ImageFolderOptions options_;
  std::vector<std::string> files_;
  std::vector<double> times_;  // Unix times of the files, where their names are such
  std::size_t next_ = 0;
  SourceReport report_;
};

}  // namespace omnimapper::source
