#include <omnimapper/base/CsvTable.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/interaction/PointingModel.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::interaction {

namespace {

constexpr double kDegree = M_PI / 180;

Eigen::Vector3d unitOf(const TargetDirection& d) {
  return {std::cos(d.altitude) * std::cos(d.azimuth), std::cos(d.altitude) * std::sin(d.azimuth), std::sin(d.altitude)};
}

// The columns of the statistics and where their values are in a row.
struct Column {
  const char* name;
  RayErrors PointingRow::*ray;
  AngleError RayErrors::*angle;
  double AngleError::*value;
};

constexpr Column kColumns[] = {
    {"elbow_hand_theta_mean_deg", &PointingRow::elbow_hand, &RayErrors::theta, &AngleError::mean},
    {"elbow_hand_theta_sigma_deg", &PointingRow::elbow_hand, &RayErrors::theta, &AngleError::sigma},
    {"elbow_hand_psi_mean_deg", &PointingRow::elbow_hand, &RayErrors::psi, &AngleError::mean},
    {"elbow_hand_psi_sigma_deg", &PointingRow::elbow_hand, &RayErrors::psi, &AngleError::sigma},
    {"head_hand_theta_mean_deg", &PointingRow::head_hand, &RayErrors::theta, &AngleError::mean},
    {"head_hand_theta_sigma_deg", &PointingRow::head_hand, &RayErrors::theta, &AngleError::sigma},
    {"head_hand_psi_mean_deg", &PointingRow::head_hand, &RayErrors::psi, &AngleError::mean},
    {"head_hand_psi_sigma_deg", &PointingRow::head_hand, &RayErrors::psi, &AngleError::sigma}};

std::vector<double> weightsOf(const PointingModel& model, const std::optional<TargetDirection>& direction) {
  std::vector<double> weights(model.rows.size(), 0.0);
  constexpr double kFarthest = 4;  // direction_sigma
  double nearest = kFarthest;
  for (std::size_t i = 0; direction && i < weights.size(); ++i) {
    if (!model.rows[i].direction) continue;
    const double off = angleBetween(*direction, *model.rows[i].direction) / model.direction_sigma;
    weights[i] = std::exp(-0.5 * off * off);
    nearest = std::min(nearest, off);
  }
  if (nearest >= kFarthest) weights.assign(weights.size(), 1.0);
  return weights;
}

AngleError mixture(const PointingModel& model, const std::vector<double>& weights, RayErrors PointingRow::*ray,
                   AngleError RayErrors::*angle) {
  double sum = 0, mean = 0, square = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const AngleError& error = model.rows[i].*ray.*angle;
    sum += weights[i];
    mean += weights[i] * error.mean;
    square += weights[i] * (error.sigma * error.sigma + error.mean * error.mean);
  }
  mean /= sum;
  return {mean, std::sqrt(std::max(0.0, square / sum - mean * mean))};
}

TargetDirection readDirection(const base::CsvTable& table, std::size_t row) {
  return {kDegree * table.number(row, "azimuth_deg"), kDegree * table.number(row, "altitude_deg")};
}

}  // namespace

double angleBetween(const TargetDirection& a, const TargetDirection& b) {
  return std::acos(std::clamp(unitOf(a).dot(unitOf(b)), -1.0, 1.0));
}

PointingRow errorsTowards(const PointingModel& model, const std::optional<TargetDirection>& direction) {
  const auto weights = weightsOf(model, direction);
  PointingRow row{"", direction, {}, {}};
  for (const auto ray : {&PointingRow::elbow_hand, &PointingRow::head_hand})
    for (const auto angle : {&RayErrors::theta, &RayErrors::psi}) row.*ray.*angle = mixture(model, weights, ray, angle);
  return row;
}

std::string tableOf(const PointingModel& model) {
  std::string text = "target,azimuth_deg,altitude_deg";
  for (const Column& column : kColumns) text += std::string(",") + column.name;
  text += ",theta_correlation,psi_correlation\n";
  const auto degrees = [](double angle) { return "," + base::fixed(angle / kDegree, 4); };
  for (const PointingRow& row : model.rows) {
    text += base::csvField(base::printable(row.target));
    text += row.direction ? degrees(row.direction->azimuth) + degrees(row.direction->altitude) : ",,";
    for (const Column& column : kColumns) text += degrees(row.*column.ray.*column.angle.*column.value);
    text += "," + base::fixed(model.theta_correlation, 4) + "," + base::fixed(model.psi_correlation, 4) + "\n";
  }
  return text;
}

PointingModel readPointingModel(const std::string& path) {
  const base::CsvTable table(path, "table of pointing errors");
  PointingModel model;
  for (std::size_t i = 0; i < table.size(); ++i) {
    PointingRow row;
    row.target = table.text(i, "target");
    if (!table.text(i, "azimuth_deg").empty()) row.direction = readDirection(table, i);
    for (const Column& column : kColumns) {
      double& value = row.*column.ray.*column.angle.*column.value;
      value = kDegree * table.number(i, column.name);
      if (column.value == &AngleError::sigma && !(value > 0))
        table.refuse(i, std::string(column.name) + " is not positive");
    }
    model.theta_correlation = table.number(i, "theta_correlation");
    model.psi_correlation = table.number(i, "psi_correlation");
    if (std::abs(model.theta_correlation) >= 1 || std::abs(model.psi_correlation) >= 1)
      table.refuse(i, "a correlation is not between -1 and 1");
    model.rows.push_back(std::move(row));
  }
  if (model.rows.empty())
    throw base::Error(base::ExitCode::unreadable_input,
                      path + ": the table of pointing errors has no row: make one by omnimapper-calibrate pointing");
  return model;
}

}  // namespace omnimapper::interaction
