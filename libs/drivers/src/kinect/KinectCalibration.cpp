#include <omnimapper/drivers/KinectCalibration.h>

#include <cmath>

namespace omnimapper::drivers {

namespace {

mrpt::img::TCamera kinectCamera(double fx, double fy, double cx, double cy, const std::array<double, 5>& lens) {
  mrpt::img::TCamera camera;
  camera.ncols = kKinectWidth;
  camera.nrows = kKinectHeight;
  camera.setIntrinsicParamsFromValues(fx, fy, cx, cy);
  if (lens != std::array<double, 5>{}) {
    camera.distortion = mrpt::img::DistortionModel::plumb_bob;
    std::copy(lens.begin(), lens.end(), camera.dist.begin());
  }
  return camera;
}

}  // namespace

double KinectCalibration::depthOf(int raw) const {
  if (raw < 0 || raw >= kKinectNoDepth) return 0;
  const double inverse = inverse_depth_at_zero + inverse_depth_step * raw;
  return inverse > 0 ? 1 / inverse : 0;
}

int KinectCalibration::rawOf(double depth) const {
  if (!(depth > 0)) return kKinectNoDepth;
  const double raw = std::round((1 / depth - inverse_depth_at_zero) / inverse_depth_step);
  if (!(raw >= 0 && raw < kKinectNoDepth)) return kKinectNoDepth;
  return depthOf(static_cast<int>(raw)) > 0 ? static_cast<int>(raw) : kKinectNoDepth;
}

mrpt::img::TCamera KinectCalibration::depthCamera() const {
  return kinectCamera(depth_fx, depth_fy, depth_cx, depth_cy, {depth_k1, depth_k2, depth_p1, depth_p2, depth_k3});
}

mrpt::img::TCamera KinectCalibration::pictureCamera() const {
  return kinectCamera(picture_fx, picture_fy, picture_cx, picture_cy,
                      {picture_k1, picture_k2, picture_p1, picture_p2, picture_k3});
}

mrpt::poses::CPose3D KinectCalibration::depthFromPicture() const {
  return {picture_x, picture_y, picture_z, picture_yaw, picture_pitch, picture_roll};
}

}  // namespace omnimapper::drivers
