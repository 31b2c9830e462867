// Planes in depth images by OpenCV: normals by the FALS method and then RgbdPlane, and RgbdPlane alone.
#include <opencv2/core.hpp>
#include <opencv2/rgbd.hpp>
#include <opencv2/rgbd/depth.hpp>

#include "PlanePeers.h"

namespace omnimapper::bench {

namespace {

cv::Matx33f matrixOf(const camera::Pinhole& c) {
  return {static_cast<float>(c.fx),
          0,
          static_cast<float>(c.cx),
          0,
          static_cast<float>(c.fy),
          static_cast<float>(c.cy),
          0,
          0,
          1};
}

cv::Mat metresOf(const DepthFrame& frame) {
  const cv::Mat units(frame.height, frame.width, CV_16U, const_cast<std::uint16_t*>(frame.units.data()));
  cv::Mat metres;
  units.convertTo(metres, CV_32F, frame.metres_per_unit);
  metres.setTo(std::numeric_limits<float>::quiet_NaN(), units == 0);
  return metres;
}

std::vector<std::uint16_t> labelsOf(const cv::Mat& mask) {
  std::vector<std::uint16_t> labels;
  labels.reserve(mask.total());
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      const auto plane = mask.at<std::uint8_t>(y, x);
      labels.push_back(plane == 255 ? std::uint16_t{0} : static_cast<std::uint16_t>(plane + 1));
    }
  }
  return labels;
}

std::vector<std::uint16_t> planes(const DepthFrame& frame, cv::rgbd::RgbdNormals* normals_of) {
  cv::Mat points, normals, mask, coefficients;
  cv::rgbd::depthTo3d(metresOf(frame), cv::Mat(matrixOf(frame.camera)), points);
  cv::rgbd::RgbdPlane find;
  find.setMinSize(1000);
  // The value that the class documents for a Kinect, whose depth error grows with the square of the depth.
  find.setSensorErrorA(0.0075);
  if (normals_of == nullptr) {
    find(points, mask, coefficients);
  } else {
    (*normals_of)(points, normals);
    find(points, normals, mask, coefficients);
  }
  return labelsOf(mask);
}

}  // namespace

std::vector<PlanePeer> openCvPlanes() {
  return {{"OpenCV FALS normals + RgbdPlane",
           [normals = cv::Ptr<cv::rgbd::RgbdNormals>()](const DepthFrame& frame) mutable {
             if (!normals) {
               normals = cv::makePtr<cv::rgbd::RgbdNormals>(frame.height, frame.width, CV_32F,
                                                            cv::Mat(matrixOf(frame.camera)), 5,
                                                            cv::rgbd::RgbdNormals::RGBD_NORMALS_METHOD_FALS);
               normals->initialize();
             }
             return planes(frame, normals.get());
           }},
          {"OpenCV RgbdPlane", [](const DepthFrame& frame) { return planes(frame, nullptr); }}};
}

}  // namespace omnimapper::bench
