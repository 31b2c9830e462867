// The object separation test of the thesis (6.1.7), simulated: two cans 2 to 30 cm apart on a table, at which people
// point from 0.7 to 1 m with the errors of Table 12's target 2 (OpenNI). For each separation and each way to determine
// the target it counts how often the answer is right, wrong and sure, or asked back, with the means corrected and not,
// for people who miss as the table says, for users of whom each has its own bias and spread, and for rays whose errors
// are correlated. Prints Markdown tables; --svg draws the curves.
//
// Example: bench-pointing --gestures 1000 --svg pointing.svg
#include <omnimapper/interaction/PointingTables.h>
#include <omnimapper/interaction/PointingTarget.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "CurvePlot.h"

namespace {

using namespace omnimapper;
using namespace omnimapper::interaction;
using Eigen::Vector3d;

/// How people miss, as parts of the table's standard deviation.
struct People {
  std::string name;
  double bias_sigma, least_spread, most_spread, correlation;
};

const std::vector<People> kPeople = {{"as the table", 0, 1, 1, 0},
                                     {"each user biased by 0.5 sigma, spread 0.6 to 1.4", 0.5, 0.6, 1.4, 0},
                                     {"both rays correlated by 0.5", 0, 1, 1, 0.5},
                                     {"all 1.3 times as far", 0, 1.3, 1.3, 0}};
const std::vector<int> kSeparations = {2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 20, 25, 30};  // [cm]

class Crowd {
 public:
  Crowd(const People& people, const PointingRow& row, unsigned seed) : people_(people), row_(row), random_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  /// Somebody, who points at this target.
  PointingGesture pointsAt(const Vector3d& target) {
    std::array<double, 4> off;
    for (double& each : off) each = gaussian();
    for (int i = 2; i < 4; ++i)
      off[i] = people_.correlation * off[i - 2] + std::sqrt(1 - people_.correlation * people_.correlation) * off[i];
    for (double& each : off)
      each = people_.bias_sigma * gaussian() + uniform(people_.least_spread, people_.most_spread) * each;
    PointingGesture gesture;
    gesture.hand = {0, 0, 1.1};
    gesture.sensor = {2, 0, 1.2};
    const auto from = [&](const RayErrors& ray, int i, double length) -> Vector3d {
      const PointingError error{ray.theta.mean + ray.theta.sigma * off[i], ray.psi.mean + ray.psi.sigma * off[i + 1]};
      return gesture.hand - length * directionWithError(gesture.hand, target, error);
    };
    gesture.elbow = from(row_.elbow_hand, 0, 0.3);
    gesture.head = from(row_.head_hand, 2, 0.6);
    return gesture;
  }

 private:
  double gaussian() { return std::normal_distribution<double>()(random_); }
  People people_;
  PointingRow row_;
  std::mt19937_64 random_;
};

std::vector<Vector3d> canAt(const Vector3d& middle) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 8; ++i)
    for (int j = -2; j <= 2; ++j)
      points.push_back(middle + Vector3d(0.033 * std::cos(i * M_PI / 4), 0.033 * std::sin(i * M_PI / 4), j * 0.12 / 4));
  return points;
}

PointingModel uncorrected(PointingModel model) {
  for (PointingRow& row : model.rows)
    for (RayErrors* ray : {&row.elbow_hand, &row.head_hand}) ray->theta.mean = ray->psi.mean = 0;
  return model;
}

struct Count {
  int right = 0, wrong = 0, asked = 0, nothing = 0, gestures = 0;
  double distance_meant = 0, distance_other = 0;  // sums of Mahalanobis distances

  void add(const TargetAnswer& answer, std::size_t meant) {
    ++gestures;
    if (answer.verdict == TargetVerdict::nothing) ++nothing;
    if (answer.verdict == TargetVerdict::one_of_these) ++asked;
    if (answer.verdict == TargetVerdict::this_one) ++(answer.candidates[0] == meant ? right : wrong);
  }
  double percent(int count) const { return 100.0 * count / gestures; }
};

struct Bin {
  double stated = 0;
  int right = 0, count = 0;
};

/// A way to determine the target.
struct Way {
  std::string name;
  PointingMethod method;
  bool is_thesis, is_corrected;
};

const std::vector<Way> kWays = {{"ours, both rays", PointingMethod::both, false, true},
                                {"ours, elbow-hand", PointingMethod::elbow_hand, false, true},
                                {"ours, head-hand", PointingMethod::head_hand, false, true},
                                {"ours, both rays, not corrected", PointingMethod::both, false, false},
                                {"thesis, elbow-hand", PointingMethod::elbow_hand, true, true},
                                {"thesis, head-hand", PointingMethod::head_hand, true, true},
                                {"thesis, elbow-hand, not corrected", PointingMethod::elbow_hand, true, false},
                                {"thesis, head-hand, not corrected", PointingMethod::head_hand, true, false}};

using Counts = std::map<std::string, std::map<int, Count>>;  // by way and separation
using Bins = std::map<std::string, std::array<Bin, 10>>;

double leastDistance(const PointingGesture& gesture, const PointedCandidate& can, const PointingModel& model,
                     PointingMethod method) {
  double least = 1e9;
  for (const Vector3d& point : can.points) least = std::min(least, mahalanobis(gesture, point, model, method, false));
  return least;
}

/// Both cans are at the same height before the person and as far to both sides.
void test(const People& people, int gestures, const TargetOptions& asked, Counts& counts, Bins& bins) {
  const PointingRow row = thesisRow(SkeletonSoftware::openni, 2);
  const PointingModel corrected{{row}}, plain = uncorrected(corrected);
  for (const int separation : kSeparations) {
    Crowd crowd(people, row, static_cast<unsigned>(separation));
    for (int k = 0; k < gestures; ++k) {
      const double range = crowd.uniform(0.7, 1.0), height = 0.8, level = std::sqrt(range * range - 0.3 * 0.3);
      std::vector<PointedCandidate> cans;
      std::array<Vector3d, 2> middles;
      for (int i = 0; i < 2; ++i) {
        middles[i] = Vector3d(level, (i == 0 ? -0.005 : 0.005) * separation, height);
        cans.push_back({canAt(middles[i]), {}, true});
      }
      const auto meant = static_cast<std::size_t>(k % 2);
      const PointingGesture gesture = crowd.pointsAt(middles[meant]);
      for (const Way& way : kWays) {
        const PointingModel& model = way.is_corrected ? corrected : plain;
        TargetOptions options = asked;
        options.method = way.method;
        const auto answer = way.is_thesis ? determineTargetAsThesis(gesture, cans, model, way.method)
                                          : determineTarget(gesture, cans, model, options);
        Count& count = counts[way.name][separation];
        count.add(answer, meant);
        if (way.is_thesis) {
          count.distance_meant += leastDistance(gesture, cans[meant], model, way.method);
          count.distance_other += leastDistance(gesture, cans[1 - meant], model, way.method);
          continue;
        }
        for (std::size_t i = 0; i < 2; ++i) {
          Bin& bin = bins[way.name][static_cast<std::size_t>(std::min(9.0, 10 * answer.probabilities[i]))];
          bin.stated += answer.probabilities[i], bin.right += i == meant, ++bin.count;
        }
      }
    }
  }
}

double largestGap(const std::array<Bin, 10>& bins, int least) {
  double largest = 0;
  for (const Bin& bin : bins)
    if (bin.count >= least) largest = std::max(largest, std::abs(bin.stated - bin.right) / bin.count);
  return largest;
}

void print(const People& people, const Counts& counts, const Bins& bins, int gestures) {
  std::printf(
      "\n%s:\n\n| | decided right at 2 | 5 | 10 | 20 | 30 cm | wrong and sure, at most | at | stated and found "
      "differ by at most |\n|---|---|---|---|---|---|---|---|---|\n",
      people.name.c_str());
  for (const Way& way : kWays) {
    const auto& by_separation = counts.at(way.name);
    std::printf("| %s |", way.name.c_str());
    for (const int separation : {2, 5, 10, 20, 30}) {
      const Count& count = by_separation.at(separation);
      std::printf(" %.1f %% |", count.percent(count.right));
    }
    const auto worst = std::max_element(by_separation.begin(), by_separation.end(),
                                        [](const auto& a, const auto& b) { return a.second.wrong < b.second.wrong; });
    std::printf(" %.1f %% | %d cm |", worst->second.percent(worst->second.wrong), worst->first);
    if (way.is_thesis)
      std::printf(" - |\n");
    else
      std::printf(" %.1f %% |\n", 100 * largestGap(bins.at(way.name), gestures / 2));
  }
}

void printDistances(const Counts& counts) {
  std::printf(
      "\nMean Mahalanobis distance by the rule of the thesis (Figure 94), to the can that is meant and to the "
      "other:\n\n|");
  for (const Way& way : kWays)
    if (way.is_thesis) std::printf(" | %s", way.name.c_str());
  std::printf(" |\n|---|---|---|---|---|\n");
  for (const int separation : kSeparations) {
    std::printf("| %d cm", separation);
    for (const Way& way : kWays) {
      if (!way.is_thesis) continue;
      const Count& count = counts.at(way.name).at(separation);
      std::printf(" | %.1f, %.1f", count.distance_meant / count.gestures, count.distance_other / count.gestures);
    }
    std::printf(" |\n");
  }
}

void drawCurves(const std::string& path, const Counts& counts) {
  std::vector<bench::PlottedCurve> curves;
  const auto add = [&](const std::string& way, const std::string& what, const std::string& colour, int Count::*part) {
    bench::PlottedCurve curve{way + ": " + what, colour, {}};
    for (const int separation : kSeparations) {
      const Count& count = counts.at(way).at(separation);
      curve.points.emplace_back(separation, count.percent(count.*part));
    }
    curves.push_back(curve);
  };
  add("ours, both rays", "right", "#1b7837", &Count::right);
  add("ours, both rays", "wrong", "#d73027", &Count::wrong);
  add("ours, elbow-hand", "right", "#7fbf7b", &Count::right);
  add("thesis, elbow-hand", "right", "#2166ac", &Count::right);
  add("thesis, elbow-hand", "wrong", "#762a83", &Count::wrong);
  bench::plotCurves(path, "Two cans: answers that are sure", "separation [cm]", "gestures [%]", curves);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Tells two cans apart at which people point, by our probabilities and by the thesis's rule.");
  int gestures = 1000;
  std::string svg;
  TargetOptions options;
  app.add_option("--gestures", gestures, "gestures for each separation; default 1000")->check(CLI::Range(10, 1000000));
  app.add_option("--svg", svg, "draw the curves of people who miss as the table into this file");
  app.add_option("--sure", options.sure, "probability from which on an answer is sure; default 0.95");
  app.add_option("--freedom", options.freedom, "degrees of freedom of the errors; default 20");
  app.add_option("--nothing", options.nothing_prior, "probability of nothing; default 0.02");
  CLI11_PARSE(app, argc, argv);
  for (const People& people : kPeople) {
    Counts counts;
    Bins bins;
    test(people, gestures, options, counts, bins);
    print(people, counts, bins, gestures);
    if (people.name != kPeople.front().name) continue;
    printDistances(counts);
    if (!svg.empty()) drawCurves(svg, counts);
  }
}
