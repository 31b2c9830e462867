#include "Images.h"

#include <omnimapper/source/ImageFile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace omnimapper::ros {

namespace {

struct PixelFormat {
  const char* encoding;
  int type;        // of OpenCV
  int conversion;  // to blue, green, red; -1: none
};
constexpr std::array<PixelFormat, 19> kPixelFormats{{{"mono8", CV_8UC1, -1},
                                                     {"8UC1", CV_8UC1, -1},
                                                     {"bgr8", CV_8UC3, -1},
                                                     {"8UC3", CV_8UC3, -1},
                                                     {"rgb8", CV_8UC3, cv::COLOR_RGB2BGR},
                                                     {"bgra8", CV_8UC4, cv::COLOR_BGRA2BGR},
                                                     {"8UC4", CV_8UC4, cv::COLOR_BGRA2BGR},
                                                     {"rgba8", CV_8UC4, cv::COLOR_RGBA2BGR},
                                                     {"bayer_rggb8", CV_8UC1, cv::COLOR_BayerBG2BGR},
                                                     {"bayer_bggr8", CV_8UC1, cv::COLOR_BayerRG2BGR},
                                                     {"bayer_gbrg8", CV_8UC1, cv::COLOR_BayerGR2BGR},
                                                     {"bayer_grbg8", CV_8UC1, cv::COLOR_BayerGB2BGR},
                                                     {"yuv422", CV_8UC2, cv::COLOR_YUV2BGR_UYVY},
                                                     {"uyvy", CV_8UC2, cv::COLOR_YUV2BGR_UYVY},
                                                     {"yuv422_yuy2", CV_8UC2, cv::COLOR_YUV2BGR_YUYV},
                                                     {"yuyv", CV_8UC2, cv::COLOR_YUV2BGR_YUYV},
                                                     {"16UC1", CV_16UC1, -1},
                                                     {"mono16", CV_16UC1, -1},
                                                     {"32FC1", CV_32FC1, -1}}};

const PixelFormat& formatOf(const std::string& encoding) {
  constexpr std::size_t kLongestShown = 40;  // [bytes]
  for (const auto& format : kPixelFormats)
    if (encoding == format.encoding) return format;
  throw BadBytes("is an image in the encoding '" + encoding.substr(0, kLongestShown) + "', which is not read");
}

// The pixels of an Image as they are; refers to the message.
cv::Mat pixelsOf(const Value& message, const PixelFormat& format) {
  constexpr std::int64_t kLargest = 1 << 15;  // pixels of a side
  const std::int64_t width = message["width"].integer(), height = message["height"].integer();
  const auto step = static_cast<std::size_t>(message["step"].integer());
  const std::string_view data = message["data"].bytes();
  const auto row = static_cast<std::size_t>(width) * CV_ELEM_SIZE(format.type);
  if (width <= 0 || height <= 0 || width > kLargest || height > kLargest || step < row || step > data.size() ||
      step * static_cast<std::size_t>(height - 1) + row > data.size())
    throw BadBytes("is an image whose size does not fit its data");
  auto* first = const_cast<char*>(data.data());
  // OpenCV wants rows that begin where a value may.
  cv::Mat pixels(static_cast<int>(height), static_cast<int>(width), format.type);
  for (int i = 0; i < pixels.rows; ++i) std::memcpy(pixels.ptr(i), first + static_cast<std::size_t>(i) * step, row);
  return pixels;
}

cv::Mat uncompressed(std::string_view data, int how) {
  if (data.empty()) throw BadBytes("is an image without data");
  if (const auto why = source::whyTooLargeImage(data)) throw BadBytes(*why);
  const cv::Mat bytes(1, static_cast<int>(data.size()), CV_8UC1, const_cast<char*>(data.data()));
  cv::Mat image;
  try {
    image = cv::imdecode(bytes, how);
  } catch (const cv::Exception&) {
  }
  if (image.empty()) throw BadBytes("is a compressed image that cannot be decoded");
  return image;
}

cv::Mat uncompressed16(std::string_view data) {
  const cv::Mat values = uncompressed(data, cv::IMREAD_UNCHANGED);
  if (values.type() != CV_16UC1) throw BadBytes("is a depth image without 16 bits for each pixel");
  return values;
}

cv::Mat colourful(const cv::Mat& pixels, int conversion) {
  cv::Mat picture;
  try {
    cv::cvtColor(pixels, picture, conversion);
  } catch (const cv::Exception&) {
    throw BadBytes("is an image whose colours cannot be converted");
  }
  return picture;
}

cv::Mat millimetresOf(const cv::Mat& metres) {
  constexpr float kPerMetre = 1000;
  cv::Mat depths(metres.size(), CV_16UC1);
  for (int row = 0; row < metres.rows; ++row) {
    for (int column = 0; column < metres.cols; ++column) {
      const float value = metres.at<float>(row, column) * kPerMetre;
      depths.at<std::uint16_t>(row, column) =
          value >= 0.5F && value < 65535.F ? static_cast<std::uint16_t>(std::lround(value)) : std::uint16_t{0};
    }
  }
  return depths;
}

// compressed_depth_image_transport: a head of 12 bytes with two parameters, then a PNG; of depths in metres it has
// quantized inverse depths.
cv::Mat uncompressedDepths(std::string_view data, bool are_metres) {
  constexpr std::size_t kHead = 12;
  if (data.size() <= kHead) throw BadBytes("is a depth image without data");
  const cv::Mat values = uncompressed16(data.substr(kHead));
  if (!are_metres) return values;
  float a = 0, b = 0;
  std::memcpy(&a, data.data() + 4, sizeof a);
  std::memcpy(&b, data.data() + 8, sizeof b);
  cv::Mat metres(values.size(), CV_32FC1);
  for (int row = 0; row < values.rows; ++row) {
    for (int column = 0; column < values.cols; ++column) {
      const auto value = values.at<std::uint16_t>(row, column);
      metres.at<float>(row, column) = value == 0 ? 0.F : a / (static_cast<float>(value) - b);
    }
  }
  return millimetresOf(metres);
}

}  // namespace

ImageContent imageContentOf(std::string_view encoding, std::string_view topic) {
  const std::string_view pixels = encoding.substr(0, encoding.find(';'));  // "16UC1; png compressed "
  const bool is_depth =
      pixels == "16UC1" || pixels == "32FC1" || encoding.find("compressedDepth") != std::string_view::npos;
  if (is_depth) return ImageContent::depths;
  if (pixels != "mono16") return ImageContent::picture;
  return topic.find("depth") != std::string_view::npos ? ImageContent::depths : ImageContent::deep_grey;
}

cv::Mat pictureOf(const Value& message) {
  if (!message.has("encoding")) return uncompressed(message["data"].bytes(), cv::IMREAD_COLOR);
  const PixelFormat& format = formatOf(std::string(message["encoding"].text()));
  if (CV_MAT_DEPTH(format.type) != CV_8U) throw BadBytes("is an image with more than 8 bits for each colour");
  const cv::Mat pixels = pixelsOf(message, format);
  if (format.conversion < 0) return pixels;
  if (format.type == CV_8UC2 && pixels.cols % 2 != 0) throw BadBytes("is an image with half a pair of pixels");
  return colourful(pixels, format.conversion);
}

cv::Mat depthsOf(const Value& message) {
  if (!message.has("encoding")) {
    const std::string_view format = message["format"].text();
    const std::string_view data = message["data"].bytes();
    if (format.find("compressedDepth") == std::string_view::npos) return uncompressed16(data);
    return uncompressedDepths(data, format.find("32FC1") != std::string_view::npos);
  }
  const PixelFormat& format = formatOf(std::string(message["encoding"].text()));
  cv::Mat pixels = pixelsOf(message, format);
  if (message["is_bigendian"].integer() != 0) throw BadBytes("is a depth image with its bytes in the other order");
  if (format.type == CV_32FC1) return millimetresOf(pixels);
  if (format.type != CV_16UC1) throw BadBytes("is no depth image");
  return pixels;
}

mrpt::img::TCamera cameraOf(const Value& info, bool is_rectified) {
  mrpt::img::TCamera camera;
  camera.ncols = static_cast<std::uint32_t>(info["width"].integer());
  camera.nrows = static_cast<std::uint32_t>(info["height"].integer());
  const Value &k = info.either("K", "k"), &p = info.either("P", "p"), &d = info.either("D", "d");
  const bool has_projection = is_rectified && p.number(0) > 0;
  const std::size_t row = has_projection ? 4 : 3;
  const Value& matrix = has_projection ? p : k;
  camera.setIntrinsicParamsFromValues(matrix.number(0), matrix.number(row + 1), matrix.number(2),
                                      matrix.number(row + 2));
  if (!(camera.fx() > 0) || !(camera.fy() > 0)) throw BadBytes("states no focal length");
  if (is_rectified || d.size() == 0) return camera;
  const auto model = info["distortion_model"].text();
  if (model != "plumb_bob" && model != "rational_polynomial" && !model.empty())
    throw BadBytes("states a lens '" + std::string(model) + "', which is not read");
  for (std::size_t i = 0; i < std::min<std::size_t>(d.size(), camera.dist.size()); ++i) camera.dist[i] = d.number(i);
  camera.distortion = std::any_of(camera.dist.begin(), camera.dist.end(), [](double value) { return value != 0; })
                          ? mrpt::img::DistortionModel::plumb_bob
                          : mrpt::img::DistortionModel::none;
  return camera;
}

}  // namespace omnimapper::ros
