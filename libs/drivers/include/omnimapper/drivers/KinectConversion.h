#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/drivers/KinectOptions.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace omnimapper::drivers {

/// Converts a Kinect's raw depths of 11 bits and its pictures, both of 640 x 480 pixels, to observations.
class KinectConversion {
 public:
  explicit KinectConversion(const KinectOptions& options);

  /// `depths`: row by row, raw values or, with Registration::device, millimetres and 0 for none. `picture`: red, green
  /// and blue, three bytes a pixel, row by row; null: there is none. The observation has depths along the optical axis
  /// in rangeUnits of 0.2 mm, 0 for none; the caller sets stamp and label.
  mrpt::obs::CObservation3DRangeScan::Ptr observation(const std::uint16_t* depths, const std::uint8_t* picture) const;

  /// The pixel in which the colour camera sees what the depth camera sees in one of its pixels.
  struct Place {
    int column, row;
    double depth;  ///< [m] along the colour camera's optical axis
  };
  /// None if the colour camera does not see it, or the depth camera's lens images nothing in that pixel. `depth` is in
  /// [m].
  std::optional<Place> placeInPicture(int column, int row, double depth) const;

 private:
  struct Ray {
    float x, y, z;
  };
  bool isMoved() const;
  Ray rayOf(int column, int row) const;
  std::optional<Place> placeOf(Ray ray, double depth) const;
  void fillCameras(mrpt::obs::CObservation3DRangeScan& scan) const;
  void moveIntoPicture(const std::uint16_t* depths, mrpt::math::CMatrix_u16& image) const;

  KinectOptions options_;
  mrpt::img::TCamera depth_camera_, picture_camera_;
  std::vector<double> metres_;        // by value of the device; 0: no depth
  std::vector<std::uint16_t> units_;  // the same in rangeUnits
  /// picture_from_depth, of optical frames.
  std::array<std::array<double, 3>, 3> rotation_;
  std::array<double, 3> translation_;  // [m]
  std::vector<Ray> rays_;  // of the depth camera's pixels in the colour camera's frame, if depths are registered here
};

}  // namespace omnimapper::drivers
