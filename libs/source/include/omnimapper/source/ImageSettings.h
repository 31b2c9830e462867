#pragma once

#include <mrpt/img/CImage.h>

namespace omnimapper::source {

/// Encoding of colour images inside a rawlog.
enum class ColourImages {
  lossless,
  jpeg,  ///< quality 95; takes a twentieth of the space and time of lossless images
};

/// Sets how MRPT writes images in the whole process; the destructor restores the old settings.
class ImageSettings {
 public:
  explicit ImageSettings(ColourImages images)
      : was_lossless_(CImage::DISABLE_JPEG_COMPRESSION()), old_quality_(CImage::SERIALIZATION_JPEG_QUALITY()) {
    constexpr int kQuality = 95;
    CImage::DISABLE_JPEG_COMPRESSION(images == ColourImages::lossless);
    CImage::SERIALIZATION_JPEG_QUALITY(kQuality);
  }
  ~ImageSettings() {
    CImage::DISABLE_JPEG_COMPRESSION(was_lossless_);
    CImage::SERIALIZATION_JPEG_QUALITY(old_quality_);
  }
  ImageSettings(const ImageSettings&) = delete;
  ImageSettings& operator=(const ImageSettings&) = delete;

 private:
  using CImage = mrpt::img::CImage;
  bool was_lossless_;
  int old_quality_;
};

}  // namespace omnimapper::source
