#pragma once

#include <JointCompatibility.h>
#include <mrpt/slam/data_association.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "PointScene.h"
#include "Timing.h"

namespace omnimapper::bench {

inline constexpr double kConfidence = 0.999;

/// Association of the measurements of a scene with its landmarks.
struct Answer {
  std::vector<std::optional<std::size_t>> landmark_of;
  bool complete = true;
  double milliseconds = 0;
};

/// Whether all matches together pass the gate.
inline bool passTogether(const PointScene& scene, const Answer& answer) {
  std::vector<std::pair<std::size_t, std::size_t>> matches;
  for (std::size_t m = 0; m < answer.landmark_of.size(); ++m)
    if (answer.landmark_of[m]) matches.emplace_back(m, *answer.landmark_of[m]);
  const auto rows = static_cast<Eigen::Index>(2 * matches.size());
  Eigen::VectorXd residual(rows);
  Eigen::MatrixXd covariance(rows, rows);
  for (std::size_t a = 0; a < matches.size(); ++a) {
    const auto& [measurement, landmark] = matches[a];
    const auto row = static_cast<Eigen::Index>(2 * a);
    residual.segment<2>(row) = scene.measured_in_base[measurement] - scene.predicted_in_base[landmark];
    for (std::size_t b = 0; b < matches.size(); ++b)
      covariance.block<2, 2>(row, static_cast<Eigen::Index>(2 * b)) = scene.covarianceOf(landmark, matches[b].second);
  }
  return rows == 0 || residual.dot(covariance.llt().solve(residual)) <= mapper::chi2Limit(kConfidence, rows);
}

/// Joint innovation of all pairs of a measurement and a landmark that pass their individual gates.
inline mapper::JointInnovation innovationOf(const PointScene& scene, double sigma) {
  mapper::JointInnovation innovation;
  const double limit = mapper::chi2Limit(kConfidence, 2);
  std::vector<Eigen::Vector2d> residuals;
  for (std::size_t i = 0; i < scene.predicted_in_base.size(); ++i) {
    const Eigen::LLT<Eigen::Matrix2d> root(scene.covarianceOf(i, i) / (sigma * sigma));
    const double log_determinant = 2 * Eigen::Matrix2d(root.matrixL()).diagonal().array().log().sum();
    for (std::size_t m = 0; m < scene.measured_in_base.size(); ++m) {
      const Eigen::Vector2d residual = (scene.measured_in_base[m] - scene.predicted_in_base[i]) / sigma;
      const double chi2 = residual.dot(root.solve(residual));
      if (chi2 > limit) continue;
      const auto row = static_cast<Eigen::Index>(2 * residuals.size());
      innovation.pairings.push_back({m, i, row, 2, chi2, limit, chi2 + log_determinant});
      residuals.push_back(residual);
    }
  }
  const auto rows = static_cast<Eigen::Index>(2 * residuals.size());
  innovation.residual.resize(rows);
  innovation.covariance.resize(rows, rows);
  for (std::size_t a = 0; a < residuals.size(); ++a) {
    innovation.residual.segment<2>(innovation.pairings[a].first) = residuals[a];
    for (std::size_t b = 0; b < residuals.size(); ++b) {
      innovation.covariance.block<2, 2>(innovation.pairings[a].first, innovation.pairings[b].first) =
          scene.covarianceOf(innovation.pairings[a].landmark, innovation.pairings[b].landmark) / (sigma * sigma);
    }
  }
  return innovation;
}

/// Our association, gating included. A `min_likelihood_ratio` of 0 means nearest neighbour.
inline Answer ours(const PointScene& scene, double sigma, double min_likelihood_ratio, int max_nodes) {
  Answer answer;
  const double from = processorTime();
  const std::size_t measurements = scene.measured_in_base.size();
  const auto innovation = innovationOf(scene, sigma);
  const double margin = 2 * std::log(min_likelihood_ratio);
  const auto found = min_likelihood_ratio > 0
                         ? mapper::searchJointly(innovation, measurements, {kConfidence, margin, max_nodes})
                         : mapper::matchNearest(innovation, measurements);
  answer.landmark_of.resize(measurements);
  for (std::size_t m = 0; m < measurements; ++m) {
    const bool is_unambiguous = found.pairing_of[m] && !(found.rival_of[m] && found.rival_of[m]->dearer < margin);
    if (is_unambiguous) answer.landmark_of[m] = innovation.pairings[*found.pairing_of[m]].landmark;
  }
  answer.complete = found.complete;
  answer.milliseconds = processorTime() - from;
  return answer;
}

inline mrpt::math::CMatrixDouble rowsOf(const std::vector<Eigen::Vector2d>& points) {
  mrpt::math::CMatrixDouble rows(points.size(), 2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    rows(static_cast<int>(i), 0) = points[i].x();
    rows(static_cast<int>(i), 1) = points[i].y();
  }
  return rows;
}

/// MRPT's association with its defaults: it finds the pairs to gate by a KD-tree.
inline Answer mrpts(const PointScene& scene, mrpt::slam::TDataAssociationMethod method,
                    mrpt::slam::TDataAssociationMetric metric) {
  const auto measured = rowsOf(scene.measured_in_base), predicted = rowsOf(scene.predicted_in_base);
  const mrpt::math::CMatrixDouble covariance(scene.covariance);
  mrpt::slam::TDataAssociationResults results;
  Answer answer;
  const double from = processorTime();
  mrpt::slam::data_association_full_covariance(measured, predicted, covariance, results, method, metric, kConfidence);
  answer.milliseconds = processorTime() - from;
  answer.landmark_of.resize(scene.measured_in_base.size());
  for (const auto& [measurement, landmark] : results.associations) answer.landmark_of[measurement] = landmark;
  return answer;
}

}  // namespace omnimapper::bench
