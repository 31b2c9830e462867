#include <omnimapper/interaction/PointingTables.h>

#include <array>
#include <cmath>

namespace omnimapper::interaction {

namespace {

constexpr int kTargets = 8;

// As printed: mean and standard deviation of theta, then of psi [deg], elbow-hand, then head-hand.
using Printed = std::array<double, 8>;

constexpr std::array<Printed, kTargets> kMsSdk{{{-11.3, 7.7, 8.5, 4.5, -1.1, 8.5, -10.7, 4.8},
                                                {-15.7, 2.9, 5.5, 6.1, 7.7, 2.6, -12.0, 5.3},
                                                {-4.3, 6.6, 7.8, 3.1, 10.8, 6.4, -9.1, 3.2},
                                                {-3.7, 2.4, 7.4, 3.1, 2.2, 2.0, -8.3, 3.2},
                                                {-3.6, 1.9, 11.5, 2.9, -4.0, 1.7, -4.3, 3.2},
                                                {-14.5, 4.1, 11.6, 3.7, -9.4, 1.9, -11.6, 3.0},
                                                {-16.6, 3.3, 9.9, 3.7, -7.1, 4.7, -13.8, 1.8},
                                                {-20.8, 3.7, 5.7, 3.4, -8.0, 5.5, -15.6, 2.9}}};

constexpr std::array<Printed, kTargets> kOpenNi{{{-11.2, 7.6, 9.6, 6.3, -2.4, 9.6, -5.3, 6.4},
                                                 {-16.4, 2.9, 4.3, 7.0, 8.5, 2.6, -11.7, 6.1},
                                                 {-3.8, 6.6, 11.3, 10.9, 10.2, 6.7, -5.7, 8.0},
                                                 {-4.8, 2.6, 9.7, 3.4, 2.0, 2.3, -2.9, 4.7},
                                                 {-4.0, 4.7, 12.4, 2.5, -3.2, 2.5, 1.45, 4.8},
                                                 {-12.9, 4.2, 9.7, 5.1, -11.5, 1.5, -4.7, 4.8},
                                                 {-16.2, 2.6, 11.7, 3.7, -11.2, 4.8, -4.9, 2.9},
                                                 {-20.2, 4.5, 8.1, 3.0, -12.3, 5.2, -8.9, 2.5}}};

RayErrors rayErrors(const Printed& printed, std::size_t first) {
  constexpr double kDegree = M_PI / 180;
  return {{kDegree * printed[first], kDegree * printed[first + 1]},
          {kDegree * printed[first + 2], kDegree * printed[first + 3]}};
}

}  // namespace

PointingRow thesisRow(SkeletonSoftware software, int target) {
  const Printed& printed =
      (software == SkeletonSoftware::ms_sdk ? kMsSdk : kOpenNi).at(static_cast<std::size_t>(target));
  return {target == 0 ? "all targets" : "target " + std::to_string(target),
          {},
          rayErrors(printed, 0),
          rayErrors(printed, 4)};
}

PointingModel thesisModel(SkeletonSoftware software) {
  PointingModel model;
  for (int target = 1; target < kTargets; ++target) model.rows.push_back(thesisRow(software, target));
  return model;
}

}  // namespace omnimapper::interaction
