#include "OdometryPlugin.h"

namespace omnimapper::plugins {

const base::OptionTable<OdometryOptions>& OdometryOptions::table() {
  static const auto table = [] {
    base::OptionTable<OdometryOptions> options;
    return declareIn(options).flag(
        "fallback", &OdometryOptions::fallback,
        "Uses the odometry only where no other source measures the motion. Set it where laser odometry runs, which "
        "already uses the wheels for its predictions: wheels that slip or freeze then cannot distort the map.");
  }();
  return table;
}

OdometryPlugin::Taken OdometryPlugin::add(const mrpt::obs::CObservation::ConstPtr& observation) {
  using Of = motion::WheelOdometry::Taken;
  switch (odometry_.add(*observation)) {
    case Of::taken:
      return Taken::taken;
    case Of::unusable:
      return Taken::unusable;
    case Of::not_mine:
      break;
  }
  return Taken::not_mine;
}

std::optional<OdometryPlugin::Span> OdometryPlugin::news() const {
  const auto news = odometry_.news();
  if (!news) return std::nullopt;
  return Span{news->begin, news->end};
}

}  // namespace omnimapper::plugins
