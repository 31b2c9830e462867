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

  /// `depths`: row by row, raw values; with Registration::device, millimetres, where 0 means no depth. `picture`: row
  /// by row, three bytes a pixel: red, green and blue; null if there is no picture. The observation has depths along
  /// the optical axis in rangeUnits of 0.2 mm, where 0 means no depth. The caller sets stamp and label.
  mrpt::obs::CObservation3DRangeScan::Ptr observation(const std::uint16_t* depths, const std::uint8_t* picture) const;

  /// The pixel of the colour camera that shows what a certain pixel of the depth camera shows.
  struct Place {
    int column, row;
    double depth;  ///< [m] along the colour camera's optical axis
  };
  /// Takes a pixel of the depth camera and the depth [m] in it. None if the colour camera does not see this point, or
  /// if the depth camera, by the model of its lens, sees nothing in that pixel.
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
  std::vector<double> metres_;        // [m] depth by value of the device; 0: no depth
  std::vector<std::uint16_t> units_;  // depth in rangeUnits by value of the device
  /// picture_from_depth, between the optical frames.
  std::array<std::array<double, 3>, 3> rotation_;
  std::array<double, 3> translation_;  // [m]
  // Rays of the depth camera's pixels in the colour camera's frame; empty unless this class registers the depths.
  std::vector<Ray> rays_;
};

}  // namespace omnimapper::drivers
