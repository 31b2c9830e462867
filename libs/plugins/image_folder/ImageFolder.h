#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/source/FolderSource.h>
#include <omnimapper/source/LogLook.h>

#include <string>

namespace omnimapper::source {

struct ImageFolderOptions {
  std::string label = "camera";
  double rate = 1;      ///< images per second, if their names are no Unix times [1/s]
  double focal_px = 0;  ///< focal length; 0: the width of the image
  static const base::OptionTable<ImageFolderOptions>& table();
};

/// Streams the JPEG and PNG images of a folder as CObservationImage, except NAME.mask.png, which marks the signs in the
/// image NAME. Colours of 16 bits, grey images of 8 and those with an alpha channel become three channels of 8 bits.
/// Files that are no images, images with 16 bits of grey, which are depths, images that were cut off, and images whose
/// header states more pixels than any camera has are left out. The camera is a pinhole whose axis goes through the
/// middle of the image; cameraPose is level, with z forward along the base's x.
class ImageFolder : public FolderSource {
 public:
  static constexpr const char* kName = "image_folder";
  static constexpr const char* kSummary = "a folder of JPEG or PNG images of one camera";
  /// A folder of images that has no other files than texts beside them, and no depth images.
  static bool recognizes(const LogLook& look);

  /// Throws Error(unreadable_input) for a folder without such images.
  explicit ImageFolder(const std::string& folder, const ImageFolderOptions& options = {});

 private:
  mrpt::obs::CObservation::Ptr read(const std::string& file) override;
  void noteAtEnd(SourceReport& report) const override;

  double focal_px_;
};

}  // namespace omnimapper::source
