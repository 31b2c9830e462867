#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/eval/Plot.h>
#include <omnimapper/eval/Report.h>

#include <cstdio>
#include <nlohmann/json.hpp>

namespace omnimapper::eval {

namespace {

constexpr double kDegrees = 180 / geometry::kPi;

std::string row(const char* name, const Statistics& s, double unit, const char* unit_name) {
  char text[160];
  std::snprintf(text, sizeof text, "%-14s %10.4f %10.4f %10.4f %10.4f %10.4f  %s\n", name, s.rmse * unit, s.mean * unit,
                s.std * unit, s.median * unit, s.max * unit, unit_name);
  return text;
}

std::string head(const std::string& title) {
  char text[160];
  std::snprintf(text, sizeof text, "%-14s %10s %10s %10s %10s %10s\n", "", "rmse", "mean", "std", "median", "max");
  return title + "\n" + text;
}

nlohmann::ordered_json object(const Statistics& s, double unit) {
  return {{"rmse", s.rmse * unit},     {"mean", s.mean * unit}, {"std", s.std * unit},
          {"median", s.median * unit}, {"max", s.max * unit},   {"count", s.count}};
}

template <class Result>
void saveNumbersAndCurves(const std::string& folder, const std::string& title, const Result& result,
                          const std::vector<base::Stamp>& stamps) {
  base::makeWritableFolder(folder);
  base::writeFile(folder + "/numbers.json", [&](std::ostream& out) { out << json(result); });
  base::writeFile(folder + "/errors.svg", [&](std::ostream& out) {
    plotErrors(out, stamps, result.translation_errors, result.rotation_errors, title);
  });
}

}  // namespace

std::string table(const AbsoluteTrajectoryError& error) {
  std::string title = "absolute trajectory error: " + base::counted(error.translation.count, "pair") + ", " +
                      base::counted(error.paired.unpaired, "unpaired pose");
  if (error.paired.reference_from_estimate.scale != 1) {
    title += ", scale " + std::to_string(error.paired.reference_from_estimate.scale);
  }
  return head(title) + row("translation", error.translation, 1, "m") + row("rotation", error.rotation, kDegrees, "deg");
}

std::string table(const RelativePoseError& error) {
  return head("relative pose error: " + base::counted(error.translation.count, "span") + ", " +
              base::counted(error.unpaired, "unpaired pose")) +
         row("translation", error.translation, 1, "m") + row("rotation", error.rotation, kDegrees, "deg");
}

std::string table(const RelationError& error) {
  char share[80];
  std::snprintf(share, sizeof share, "%.2f %% within both thresholds\n", 100 * error.share_within);
  return head("relation metric: " + base::counted(error.translation.count, "relation") + " judged, " +
              std::to_string(error.missed) + " missed") +
         row("translation", error.translation, 1, "m") + row("rotation", error.rotation, kDegrees, "deg") +
         row("translation^2", error.squared_translation, 1, "m^2") +
         row("rotation^2", error.squared_rotation, kDegrees * kDegrees, "deg^2") + share;
}

std::string json(const AbsoluteTrajectoryError& error) {
  const auto& fit = error.paired.reference_from_estimate;
  const auto& p = fit.motion.translation;
  const auto& q = fit.motion.rotation;
  return nlohmann::ordered_json{{"metric", "absolute trajectory error"},
                                {"translation_m", object(error.translation, 1)},
                                {"rotation_deg", object(error.rotation, kDegrees)},
                                {"unpaired", error.paired.unpaired},
                                {"reference_from_estimate",
                                 {{"scale", fit.scale},
                                  {"translation_m", {p.x(), p.y(), p.z()}},
                                  {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}}}}}
             .dump(2) +
         "\n";
}

std::string json(const RelativePoseError& error) {
  return nlohmann::ordered_json{{"metric", "relative pose error"},
                                {"translation_m", object(error.translation, 1)},
                                {"rotation_deg", object(error.rotation, kDegrees)},
                                {"unpaired", error.unpaired}}
             .dump(2) +
         "\n";
}

std::string json(const RelationError& error) {
  return nlohmann::ordered_json{{"metric", "relations"},
                                {"translation_m", object(error.translation, 1)},
                                {"rotation_deg", object(error.rotation, kDegrees)},
                                {"squared_translation_m2", object(error.squared_translation, 1)},
                                {"squared_rotation_deg2", object(error.squared_rotation, kDegrees * kDegrees)},
                                {"share_within_thresholds", error.share_within},
                                {"missed", error.missed}}
             .dump(2) +
         "\n";
}

void saveReport(const std::string& folder, const std::string& title, const AbsoluteTrajectoryError& error,
                const Trajectory& reference) {
  std::vector<base::Stamp> stamps;
  for (const auto& pair : error.paired.pairs) stamps.push_back(pair.stamp);
  saveNumbersAndCurves(folder, title, error, stamps);
  base::writeFile(folder + "/trajectory.svg", [&](std::ostream& out) { plotTrajectory(out, error, reference, title); });
}

void saveReport(const std::string& folder, const std::string& title, const RelativePoseError& error) {
  saveNumbersAndCurves(folder, title, error, error.stamps);
}

void saveReport(const std::string& folder, const std::string& title, const RelationError& error) {
  saveNumbersAndCurves(folder, title, error, error.stamps);
}

}  // namespace omnimapper::eval
