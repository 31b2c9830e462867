#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/obs/CObservationDoorSigns.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/source/RawlogWriter.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::bench {

/// A sign that was found in an image, and the true sign that it is.
struct FoundSign {
  Eigen::Vector3d camera, direction;  ///< in the base: position [m], unit vector
  std::optional<std::size_t> sign;    ///< index in SignTruth::names of a sign or poster; none if it is neither
};

/// The truth of a place with door signs by omnimapper-simulate, and which of these signs a perceived log has found.
class SignTruth {
 public:
  using FoundSigns = std::map<base::Stamp, std::vector<FoundSign>>;

  std::vector<std::string> names;  ///< names of signs, then of posters
  std::size_t signs = 0;           ///< the first `signs` of the names are those of signs
  int repeated = 0;                ///< number of signs whose text another sign has too
  eval::Trajectory trajectory;     ///< of the base in the world
  FoundSigns found;
  std::size_t of_signs = 0, of_posters = 0, elsewhere = 0;  ///< number of detections of each
  base::Stamp first, last;                                  ///< of the perceived log

  /// Writes a copy of the perceived log to `labelled`, in which the text of each detection is the number of the true
  /// sign; detections that are no sign are left out. If `min_confidence` is not 0, it has only the signs with a line of
  /// at least that confidence, and also what was read on posters, under numbers of their own.
  SignTruth(const std::string& folder, const std::string& perceived, const std::string& labelled,
            double min_confidence) {
    readPlace(folder);
    readQuads(folder + "/signs_seen.csv");
    trajectory = eval::readTum(folder + "/truth.tum");
    source::RawlogSource log(perceived);
    source::writeRawlog(labelled, [&](source::RawlogWriter& out) {
      while (const auto observation = log.next()) {
        const auto* signs = dynamic_cast<const obs::CObservationDoorSigns*>(observation.get());
        if (!signs) continue;
        if (found.empty()) first = signs->timestamp;
        last = signs->timestamp;
        out.add(label(*signs, min_confidence));
      }
    });
  }

  /// The true sign or poster that was detected in that direction at that stamp; none if it was neither.
  std::optional<std::size_t> signOf(base::Stamp stamp, const Eigen::Vector3d& direction_in_base) const {
    const auto at = found.find(stamp);
    if (at == found.end()) return std::nullopt;
    for (const auto& each : at->second)
      if ((each.direction - direction_in_base).norm() < 1e-9) return each.sign;
    return std::nullopt;
  }

 private:
  using Quad = std::vector<cv::Point2f>;

  void readPlace(const std::string& folder) {
    std::ifstream in(folder + "/landmarks.json");
    if (!in) throw base::Error(base::ExitCode::unreadable_input, folder + ": no landmarks.json of a simulated place");
    std::map<std::string, int> texts;
    const auto place = nlohmann::json::parse(in);
    for (const auto& sign : place["signs"]) {
      names.push_back(sign["name"].get<std::string>());
      ++texts[sign["text"].dump()];
    }
    for (const auto& [text, count] : texts) repeated += count > 1 ? count : 0;
    signs = names.size();
    for (const auto& surface : place["surfaces"]) {
      if (surface["kind"] != "poster" || !surface.contains("outline")) continue;
      names.push_back(surface["name"].get<std::string>());
      std::vector<Eigen::Vector3d> outline;
      for (const auto& at : surface["outline"])
        outline.emplace_back(at[0].get<double>(), at[1].get<double>(), at[2].get<double>());
      posters_.push_back({outline.at(0), outline.at(1) - outline.at(0), outline.at(3) - outline.at(0)});
    }
  }

  // A rectangle on a wall.
  struct Poster {
    Eigen::Vector3d corner, along, up;

    // Distance [m] along the ray at which it hits the poster; none if it does not.
    std::optional<double> hitBy(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
      constexpr double kBeside = 0.05;  // tolerance in parts of its size
      const Eigen::Vector3d normal = along.cross(up);
      const double range = normal.dot(corner - origin) / normal.dot(direction);
      if (!(range > 0)) return std::nullopt;
      const Eigen::Vector3d on = origin + range * direction - corner;
      for (const double share : {on.dot(along) / along.squaredNorm(), on.dot(up) / up.squaredNorm()})
        if (!(share > -kBeside && share < 1 + kBeside)) return std::nullopt;
      return range;
    }
  };

  // The nearest poster on the true ray. Occlusion by walls is not checked, since a hidden poster would not have been
  // detected.
  std::optional<std::size_t> posterIn(base::Stamp stamp, const FoundSign& sign) const {
    const auto base = eval::interpolatedPose(trajectory, stamp, base::durationFromSeconds(1));
    if (!base) return std::nullopt;
    std::optional<std::size_t> nearest;
    double least = 0;
    for (std::size_t i = 0; i < posters_.size(); ++i) {
      const auto range = posters_[i].hitBy(*base * sign.camera, base->rotation * sign.direction);
      if (!range || (nearest && *range > least)) continue;
      least = *range;
      nearest = signs + i;
    }
    return nearest;
  }

  // Columns: stamp, sensor, measurement, sign, text (which may have commas), x1 ... y4, then six numbers.
  void readQuads(const std::string& file) {
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
      std::vector<std::string> fields;
      std::stringstream words(line);
      for (std::string field; std::getline(words, field, ',');) fields.push_back(field);
      const std::size_t n = fields.size();
      if (n < 19) continue;
      const auto name = std::find(names.begin(), names.end(), fields[3]);
      constexpr double kLeastVisible = 0.05;
      if (name == names.end() || std::stod(fields[n - 2]) < kLeastVisible) continue;
      Quad quad;
      for (std::size_t i = 0; i < 4; ++i)
        quad.emplace_back(std::stof(fields[n - 14 + 2 * i]), std::stof(fields[n - 13 + 2 * i]));
      quads_[base::parseUnix(fields[0])].emplace_back(static_cast<std::size_t>(name - names.begin()), quad);
    }
  }

  static double share(const Quad& of, const Quad& in) {
    std::vector<cv::Point2f> both;
    const double area = cv::contourArea(of);
    return area > 0 ? cv::intersectConvexConvex(of, in, both) / area : 0;
  }

  // The true sign in the image with which the detection overlaps most: it covers at least half of the detection, or the
  // detection covers at least half of it.
  std::optional<std::size_t> signIn(base::Stamp stamp, const obs::ObservedDoorSign& sign) const {
    const auto at = quads_.find(stamp);
    if (at == quads_.end()) return std::nullopt;
    Quad corners;
    for (const auto& corner : sign.corners_px) corners.emplace_back(corner.x(), corner.y());
    cv::convexHull(Quad(corners), corners);
    std::optional<std::size_t> best;
    double most = 0;
    for (const auto& [number, quad] : at->second) {
      const double of_found = share(corners, quad), of_true = share(quad, corners);
      if (of_found < 0.5 && (of_true < 0.5 || of_found < 0.1)) continue;
      if (of_found + of_true <= most) continue;
      most = of_found + of_true;
      best = number;
    }
    return best;
  }

  obs::CObservationDoorSigns label(const obs::CObservationDoorSigns& read, double min_confidence) {
    obs::CObservationDoorSigns labelled = read;
    labelled.signs.clear();
    auto& all = found[read.timestamp];
    const auto base_from_camera = geometry::fromMrpt(read.sensorPose);
    std::map<std::size_t, obs::ObservedDoorSign> of_sign;  // the detection of each sign that has the best score
    for (const auto& each : read.signs) {
      const auto number = signIn(read.timestamp, each);
      all.push_back({base_from_camera.translation, (base_from_camera.rotation * each.ray).normalized(), number});
      if (!number) all.back().sign = posterIn(read.timestamp, all.back());
      ++(number ? of_signs : all.back().sign ? of_posters : elsewhere);
      const bool is_read = min_confidence <= 0 || std::any_of(each.texts.begin(), each.texts.end(), [&](const auto& t) {
                             return t.confidence >= min_confidence && !t.text.empty();
                           });
      if (!number && all.back().sign && min_confidence > 0 && is_read) {
        labelled.signs.push_back(each);
        labelled.signs.back().texts = {{ofPoster(*all.back().sign, each, min_confidence), 1}};
      }
      if (!number || !is_read) continue;
      const auto [at, is_first] = of_sign.emplace(*number, each);
      if (!is_first && at->second.score < each.score) at->second = each;
    }
    for (auto& [number, sign] : of_sign) {
      sign.texts = {{std::to_string(1000 + number), 1}};
      labelled.signs.push_back(sign);
    }
    return labelled;
  }

  // A poster has several texts at different places. The result is its number with a text: the first line that has a
  // digit, else the first line in alphabetical order.
  static std::string ofPoster(std::size_t poster, const obs::ObservedDoorSign& sign, double min_confidence) {
    std::string best;
    for (const auto& line : sign.texts) {
      const bool has_digit =
          std::any_of(line.text.begin(), line.text.end(), [](char c) { return c >= '0' && c <= '9'; });
      if (line.confidence < min_confidence || line.text.empty()) continue;
      if (has_digit) return std::to_string(2000 + poster) + "-" + line.text;
      if (best.empty() || line.text < best) best = line.text;
    }
    return std::to_string(2000 + poster) + "-" + best;
  }

  std::map<base::Stamp, std::vector<std::pair<std::size_t, Quad>>> quads_;
  std::vector<Poster> posters_;
};

}  // namespace omnimapper::bench
