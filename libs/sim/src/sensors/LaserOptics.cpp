#include <omnimapper/sim/LaserOptics.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace omnimapper::sim {

namespace {

constexpr double kWhite = 0.9;        // reflection of the wall of white_range
constexpr int kMostPanes = 6;         // largest number of panes that a beam passes
constexpr double kPast = 1e-3;        // [m] distance behind a pane from which the beam goes on
constexpr double kSpeckle = 0.15;     // standard deviation of the power's logarithm
constexpr double kGlassIndex = 1.52;  // window glass

// Part of the light a pane reflects (two faces, unpolarized), by Fresnel's law: 0.08 face-on, 0.46 at 75 degrees.
double paneReflection(double cosine) {
  const double sine_inside = std::sqrt(std::max(0.0, 1 - cosine * cosine)) / kGlassIndex;
  const double inside = std::sqrt(1 - sine_inside * sine_inside);
  const double across = (cosine - kGlassIndex * inside) / (cosine + kGlassIndex * inside);
  const double along = (inside - kGlassIndex * cosine) / (inside + kGlassIndex * cosine);
  const double face = 0.5 * (across * across + along * along);
  return 2 * face / (1 + face);
}

// Probability that the echo of a pane itself is measured: a bell curve over the angle of incidence.
double visibilityOfPane(double cosine, double glass_angle) {
  return glass_angle > 0 ? std::exp(-0.5 * std::pow(std::acos(cosine) / glass_angle, 2)) : 0;
}

// Part of the returning light that was mirrored, as opposed to that which came through the pane. Light meets the pane
// twice, going and coming back, hence the squares.
double partMirrored(double reflection, double through) {
  return reflection * reflection / (reflection * reflection + through * through);
}

Eigen::Vector3d perpendicular(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d up = std::abs(direction.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  return direction.cross(up).normalized();
}

/// A ray within the beam, at an offset from its axis in units of the cone's half angle.
Beam within(const Beam& beam, double half_angle, double aside, double up) {
  const Eigen::Vector3d side = perpendicular(beam.direction_in_map), top = side.cross(beam.direction_in_map);
  const double tangent = std::tan(half_angle);
  return {beam.origin_in_map, (beam.direction_in_map + tangent * aside * side + tangent * up * top).normalized()};
}

}  // namespace

/// The surface that a ray met and that scattered it back.
struct LaserOptics::Return {
  double range = std::numeric_limits<double>::infinity();
  int surface = -1;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double cosine = 0;     // of incidence
  double reflected = 0;  // infrared reflection times cosine times the part that panes let through
  bool is_mirrored = false;
  double power() const { return surface < 0 ? 0 : reflected / std::max(0.01, range * range); }
  bool isSameAs(const Return& other) const {
    return surface == other.surface && (surface < 0 || normal.dot(other.normal) > 0.999);
  }
};

/// Random numbers that decide what a beam does at the panes it meets; all of its rays share them.
struct LaserOptics::Fate {
  std::array<double, kMostPanes> at_pane;
};

std::vector<VisiblePoint> seenPoints(const std::vector<Echo>& echoes) {
  std::vector<VisiblePoint> points;
  for (const Echo& echo : echoes) {
    const bool is_plain = echo.is_valid && echo.surface >= 0 && !echo.is_mixed && !echo.is_mirrored;
    if (is_plain && isSeenWell(echo.true_range, echo.cosine))
      points.push_back({echo.surface, echo.in_map.cast<float>()});
  }
  return points;
}

LaserOptics::LaserOptics(const LaserOpticsOptions& options, const Scenes& scenes, int scouts)
    : options_(options), scenes_(scenes), scouts_(options.divergence > 0 ? scouts : 1) {}

std::vector<LaserOptics::Return> LaserOptics::cast(const Scene& scene, const std::vector<Beam>& rays,
                                                   const std::vector<int>& beam_of,
                                                   const std::vector<Fate>& fates) const {
  std::vector<Return> returns(rays.size());
  std::vector<Ray> open;
  std::vector<double> before(rays.size(), 0), let_through(rays.size(), 1);
  std::vector<std::size_t> who;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    open.push_back({rays[i].origin_in_map, rays[i].direction_in_map, 0, options_.max_range * 1.5 + 1});
    who.push_back(i);
  }
  std::vector<Hit> hits;
  for (int pane = 0; pane <= kMostPanes && !open.empty(); ++pane) {
    scene.cast(open, hits);
    std::vector<Ray> next;
    std::vector<std::size_t> next_who;
    for (std::size_t j = 0; j < open.size(); ++j) {
      if (!hits[j].isHit()) continue;
      const std::size_t i = who[j];
      const Ray& ray = open[j];
      const Material& material = scenes_.material(hits[j].surface);
      const double cosine = std::min(1.0, std::abs(hits[j].normal_in_map.dot(ray.direction_in_map)));
      const auto takeEcho = [&](double infrared) {
        returns[i].range = before[i] + hits[j].range;
        returns[i].surface = hits[j].surface;
        returns[i].normal = hits[j].normal_in_map;
        returns[i].cosine = cosine;
        returns[i].reflected = infrared * cosine * let_through[i];
      };
      const auto goOn = [&](const Ray& ray_behind) {
        next.push_back(ray_behind);
        next_who.push_back(i);
      };
      if (material.transmission <= 0 || pane == kMostPanes) {
        takeEcho(static_cast<double>(material.infrared));
        continue;
      }
      const double reflection = paneReflection(cosine);
      const double through = (1 - reflection) * static_cast<double>(material.transmission);
      const double visibility = visibilityOfPane(cosine, options_.glass_angle);
      const double mirrored = partMirrored(reflection, through);
      const double die = fates[beam_of[i]].at_pane[pane];
      if (die < visibility) {
        takeEcho(0.8);
      } else if (options_.glass_angle > 0 && die < visibility + (1 - visibility) * mirrored) {
        const Eigen::Vector3d at = ray.origin_in_map + hits[j].range * ray.direction_in_map;
        const Eigen::Vector3d away =
            ray.direction_in_map - 2 * ray.direction_in_map.dot(hits[j].normal_in_map) * hits[j].normal_in_map;
        before[i] += hits[j].range;
        let_through[i] *= reflection * reflection;
        returns[i].is_mirrored = true;
        goOn({at, away.normalized(), kPast, ray.far});
      } else {
        let_through[i] *= through * through;
        goOn({ray.origin_in_map, ray.direction_in_map, hits[j].range + kPast, ray.far});
      }
    }
    open.swap(next);
    who.swap(next_who);
  }
  return returns;
}

Echo LaserOptics::noisy(Echo echo, double power, Random& random) const {
  const double gauss = random.gaussian(), speckle = random.gaussian(kSpeckle);
  const bool is_lost = random.chance(options_.lost);
  if (echo.surface < 0) return echo;
  double sigma = options_.noise + options_.noise_per_metre * echo.range;
  bool is_strong = true;
  if (options_.white_range > 0) {
    // The signal is 1 where an echo can only just be measured; noise grows as the signal falls.
    const double signal = power / (kWhite / (options_.white_range * options_.white_range));
    is_strong = signal * std::exp(speckle) >= 1;
    sigma *= std::sqrt(1 + 1 / std::max(signal, 1.0));
  }
  echo.range += sigma * gauss;
  if (options_.step > 0) echo.range = options_.step * std::round(echo.range / options_.step);
  echo.is_valid =
      is_strong && !is_lost && echo.range >= options_.min_range && echo.range < options_.max_range && echo.range > 0;
  return echo;
}

// Collects the surfaces in a beam, each with its power, and then finds the range that the electronics report: that of
// the strongest surface, or a mean of several.
Echo LaserOptics::combine(const std::vector<Return>& returns, Random& random) const {
  struct Part {
    Return first;
    double range, power, share;
  };
  std::vector<Part> parts;
  double power = 0;
  for (const Return& one : returns) {
    const double p = one.power() / static_cast<double>(returns.size());
    power += p;
    if (one.surface < 0) continue;
    const auto same =
        std::find_if(parts.begin(), parts.end(), [&](const Part& part) { return part.first.isSameAs(one); });
    if (same == parts.end()) {
      parts.push_back({one, one.range, p, p * one.range});
    } else {
      same->power += p, same->share += p * one.range;
    }
  }
  const double die = random.uniform();
  if (parts.empty()) return noisy({}, 0, random);
  // The first ray is the beam's axis. The part it lies in has its range, the others have the mean of their rays.
  for (Part& part : parts) {
    const bool has_middle = returns.front().surface >= 0 && part.first.isSameAs(returns.front());
    if (!has_middle && part.power > 0) part.range = part.share / part.power;
  }
  const auto strongest =
      std::max_element(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.power < b.power; });
  Echo echo;
  echo.surface = strongest->first.surface;
  echo.range = echo.true_range = strongest->range;
  echo.reflected = strongest->first.reflected;
  echo.cosine = strongest->first.cosine;
  echo.is_mirrored = strongest->first.is_mirrored;
  if (parts.size() == 1 || die >= options_.mixing) return noisy(echo, strongest->power, random);
  double sum = 0, weight = 0;
  for (const Part& part : parts) {
    if (std::abs(part.range - strongest->range) > options_.mixing_gap) continue;
    sum += part.power * part.range, weight += part.power;
    echo.is_mixed = echo.is_mixed || &part != &*strongest;
  }
  if (weight > 0) echo.range = sum / weight;
  return noisy(echo, echo.is_mixed ? power : strongest->power, random);
}

std::vector<Echo> LaserOptics::measure(const Scene& scene, const std::vector<Beam>& beams,
                                       std::vector<Random> randoms) const {
  const int count = static_cast<int>(beams.size());
  const double half = 0.5 * options_.divergence;
  std::vector<Fate> fates(count);
  for (int i = 0; i < count; ++i) {
    for (double& die : fates[i].at_pane) die = randoms[i].uniform();
  }
  std::vector<Beam> rays;
  std::vector<int> beam_of;
  for (int i = 0; i < count; ++i) {
    for (int scout = 0; scout < scouts_; ++scout) {
      rays.push_back(scout == 0 ? beams[i] : within(beams[i], half, scout == 1 ? -0.95 : 0.95, 0));
      beam_of.push_back(i);
    }
  }
  const std::vector<Return> scouted = cast(scene, rays, beam_of, fates);
  std::vector<std::vector<Return>> returns(count);
  for (std::size_t j = 0; j < rays.size(); ++j) returns[beam_of[j]].push_back(scouted[j]);
  if (half > 0) {
    std::vector<char> is_edge(count, 0);
    for (std::size_t j = 1; j < rays.size(); ++j) {
      // Scout rays are in the order axis, left, right. Each is compared with the one before it, an axis with that of
      // the neighbouring beam.
      const std::size_t other = beam_of[j] == beam_of[j - 1] ? j - 1 : j - scouts_;
      if (!scouted[j].isSameAs(scouted[other])) is_edge[beam_of[j]] = is_edge[beam_of[other]] = 1;
    }
    rays.clear(), beam_of.clear();
    for (int i = 0; i < count; ++i) {
      for (int k = 0; is_edge[i] && k < kFootprint; ++k) {
        // Vogel's spiral fills the disc evenly.
        const double radius = std::sqrt((k + 0.5) / kFootprint), angle = 2.399963229728653 * k;
        rays.push_back(within(beams[i], half, radius * std::cos(angle), radius * std::sin(angle)));
        beam_of.push_back(i);
      }
    }
    const std::vector<Return> more = cast(scene, rays, beam_of, fates);
    for (std::size_t j = 0; j < rays.size(); ++j) returns[beam_of[j]].push_back(more[j]);
  }
  std::vector<Echo> echoes;
  for (int i = 0; i < count; ++i) {
    // Side scouts only look for edges. A beam that casts a filled cone drops them, because they would count the rim
    // twice.
    if (static_cast<int>(returns[i].size()) > scouts_ && scouts_ > 1)
      returns[i].erase(returns[i].begin() + 1, returns[i].begin() + scouts_);
    echoes.push_back(combine(returns[i], randoms[i]));
    echoes.back().in_map = beams[i].origin_in_map + echoes.back().true_range * beams[i].direction_in_map;
  }
  return echoes;
}

}  // namespace omnimapper::sim
