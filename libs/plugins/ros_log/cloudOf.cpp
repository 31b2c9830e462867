#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "CameraObservations.h"

namespace omnimapper::ros {

namespace {

// A field of each point: where it is, and whether it has 4 or 8 bytes.
struct PointCoordinate {
  std::size_t offset = 0;
  bool is_double = false;
  double at(const char* point) const {
    if (is_double) {
      double value = 0;
      std::memcpy(&value, point + offset, sizeof value);
      return value;
    }
    float value = 0;
    std::memcpy(&value, point + offset, sizeof value);
    return static_cast<double>(value);
  }
};

PointCoordinate coordinateCalled(std::string_view name, const Value& fields, std::size_t step) {
  constexpr std::int64_t kFloat32 = 7, kFloat64 = 8;  // as PointField numbers them
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i]["name"].text() != name) continue;
    const std::int64_t type = fields[i]["datatype"].integer();
    const auto offset = static_cast<std::size_t>(fields[i]["offset"].integer());
    const std::size_t size = type == kFloat64 ? 8 : 4;
    if ((type != kFloat32 && type != kFloat64) || offset > step || offset + size > step) break;
    return {offset, type == kFloat64};
  }
  throw BadBytes("is a cloud whose points have no usable " + std::string(name));
}

}  // namespace

Converted cloudOf(const Value& message) {
  const auto step = static_cast<std::size_t>(message["point_step"].integer());
  const auto row_step = static_cast<std::size_t>(message["row_step"].integer());
  const auto width = static_cast<std::size_t>(message["width"].integer());
  const auto height = static_cast<std::size_t>(message["height"].integer());
  const std::string_view data = message["data"].bytes();
  if (message["is_bigendian"].integer() != 0) throw BadBytes("is a cloud with its bytes in the other order");
  const bool fits =
      step > 0 && width <= data.size() / step &&
      (height <= 1 || (row_step >= width * step && height <= data.size() / std::max<std::size_t>(1, row_step)));
  if (!fits) throw BadBytes("is a cloud whose size does not fit its data");
  const Value& fields = message["fields"];
  const auto x = coordinateCalled("x", fields, step), y = coordinateCalled("y", fields, step),
             z = coordinateCalled("z", fields, step);
  auto points = mrpt::maps::CSimplePointsMap::Create();
  points->reserve(width * height);
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      const char* point = data.data() + row * row_step + column * step;
      const double px = x.at(point), py = y.at(point), pz = z.at(point);
      if (std::isfinite(px) && std::isfinite(py) && std::isfinite(pz))
        points->insertPointFast(static_cast<float>(px), static_cast<float>(py), static_cast<float>(pz));
    }
  }
  auto cloud = mrpt::obs::CObservationPointCloud::Create();
  cloud->pointcloud = points;
  return {cloud, headerOf(message).frame, {}};
}

}  // namespace omnimapper::ros
