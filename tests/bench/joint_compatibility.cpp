// Joint compatibility branch and bound and nearest neighbour, our implementation and MRPT's, on the same random scenes
// of points: right, wrong and missed matches, the number of scenes whose matches do not pass the joint gate together,
// and processor time. All get the same measurements, predictions and joint covariance. Prints a Markdown table.
//
// MRPT's search has no limit on its nodes, so each of its calls runs in a separate process, which is ended after
// --limit seconds. Such a scene only counts as unfinished.
//
// Example: bench-joint_compatibility --seeds 100 --limit 1
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>

#include "PointAssociation.h"

namespace {

using namespace omnimapper;
using bench::Answer;
using bench::PointScene;

/// Runs `associate` in a child process. None if that takes more than `seconds` of processor time.
std::optional<Answer> within(int seconds, std::size_t measurements, const std::function<Answer()>& associate) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
  std::vector<double> numbers(measurements + 1);
  const auto bytes = static_cast<::ssize_t>(numbers.size() * sizeof(double));
  const ::pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    const ::rlimit limit{static_cast<::rlim_t>(seconds), static_cast<::rlim_t>(seconds)};
    if (::setrlimit(RLIMIT_CPU, &limit) != 0) ::_exit(1);
    const Answer answer = associate();
    for (std::size_t m = 0; m < measurements; ++m)
      numbers[m] = answer.landmark_of[m] ? static_cast<double>(*answer.landmark_of[m]) : -1;
    numbers.back() = answer.milliseconds;
    ::_exit(::write(ends[1], numbers.data(), static_cast<std::size_t>(bytes)) == bytes ? 0 : 1);
  }
  ::close(ends[1]);
  const bool done = ::read(ends[0], numbers.data(), static_cast<std::size_t>(bytes)) == bytes;
  ::close(ends[0]);
  ::waitpid(child, nullptr, 0);
  if (!done) return std::nullopt;
  Answer answer;
  for (std::size_t m = 0; m < measurements; ++m)
    answer.landmark_of.push_back(numbers[m] < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(numbers[m])));
  answer.milliseconds = numbers.back();
  return answer;
}

struct Contender {
  std::string name;
  std::function<std::optional<Answer>(const PointScene&)> associate;
};

struct Statistics {
  std::size_t right = 0, wrong = 0, missed = 0, of_landmarks = 0, measurements = 0;
  int unfinished = 0, torn = 0;  // torn: scenes whose matches do not pass the joint gate
  std::vector<double> times;

  void add(const PointScene& scene, const std::optional<Answer>& answer) {
    unfinished += !answer || !answer->complete;
    if (!answer) return;
    torn += !bench::passTogether(scene, *answer);
    times.push_back(answer->milliseconds);
    for (std::size_t m = 0; m < scene.truth.size(); ++m) {
      const auto& found = answer->landmark_of[m];
      ++measurements;
      of_landmarks += scene.truth[m].has_value();
      right += found && found == scene.truth[m];
      wrong += found && found != scene.truth[m];
      missed += !found && scene.truth[m];
    }
  }
  std::string text() const {
    if (times.empty()) return "- | - | - | - | - | - | " + std::to_string(unfinished);
    const auto percent = [](std::size_t part, std::size_t whole) {
      return 100 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(1, whole));
    };
    char row[160];
    std::snprintf(row, sizeof row, "%.1f %% | %.1f %% | %.1f %% | %d | %.3f | %.3f | %d", percent(right, of_landmarks),
                  percent(missed, of_landmarks), percent(wrong, measurements), torn, bench::quantile(times, 0.5),
                  bench::quantile(times, 0.95), unfinished);
    return row;
  }
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares joint compatibility and nearest neighbour, our implementation and MRPT's.");
  unsigned seeds = 100;
  int limit = 1, max_nodes = 20000;
  std::vector<std::size_t> landmarks = {10, 20, 40, 80}, measurements = {5, 10, 15, 20};
  bench::SceneNoise noise;
  std::vector<double> sigmas = {0.05, 0.3};
  app.add_option("--seeds", seeds, "scenes per row; default 100");
  app.add_option("--limit", limit, "processor time of MRPT's search for one scene [s]; default 1");
  app.add_option("--landmarks", landmarks, "number of landmarks for each size of scene; default 10 20 40 80");
  app.add_option("--measurements", measurements, "number of measurements for each size of scene; default 5 10 15 20");
  app.add_option("--landmark_sigma_m", sigmas, "standard deviations of landmarks in the map; default 0.05 0.3");
  app.add_option("--clutter", noise.clutter, "share of measurements of no landmark; default 0.2");
  app.add_option("--max_nodes", max_nodes, "largest number of nodes of our search; default 20000, as in the plugins");
  CLI11_PARSE(app, argc, argv);
  if (landmarks.size() != measurements.size()) {
    std::fprintf(stderr, "--measurements needs as many values as --landmarks\n");
    return 1;
  }
  using namespace mrpt::slam;
  const auto peer = [&](TDataAssociationMethod method, TDataAssociationMetric metric) {
    return [=](const PointScene& scene) -> std::optional<Answer> {
      if (method == assocNN) return bench::mrpts(scene, method, metric);
      return within(limit, scene.truth.size(), [&] {
        bench::mrpts(scene, assocNN, metric);  // warm-up: one-time work of a new process is not timed
        return bench::mrpts(scene, method, metric);
      });
    };
  };
  const auto own = [&](double ratio) {
    return [&noise, ratio, max_nodes](const PointScene& scene) {
      return std::optional(bench::ours(scene, noise.measurement, ratio, max_nodes));
    };
  };
  const std::vector<Contender> contenders = {{"ours, joint", own(20)},
                                             {"ours, joint, the best is taken", own(1)},
                                             {"MRPT, JCBB, Mahalanobis", peer(assocJCBB, metricMaha)},
                                             {"MRPT, JCBB, likelihood", peer(assocJCBB, metricML)},
                                             {"ours, nearest", own(0)},
                                             {"MRPT, NN, Mahalanobis", peer(assocNN, metricMaha)},
                                             {"MRPT, NN, likelihood", peer(assocNN, metricML)}};
  std::printf(
      "| known to | landmarks, measured | | right | missed | wrong | joint gate | median [ms] | 95 %% [ms] | "
      "unfinished |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  for (const double sigma : sigmas) {
    noise.landmark = sigma;
    for (std::size_t size = 0; size < landmarks.size(); ++size) {
      for (const auto& [name, associate] : contenders) {
        Statistics statistics;
        for (unsigned seed = 1; seed <= seeds; ++seed) {
          const PointScene scene(landmarks[size], measurements[size], noise, seed);
          statistics.add(scene, associate(scene));
        }
        std::printf("| %.2f m | %zu, %zu | %s | %s |\n", sigma, landmarks[size], measurements[size], name.c_str(),
                    statistics.text().c_str());
        std::fflush(stdout);
      }
    }
  }
}
