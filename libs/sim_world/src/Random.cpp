#include <omnimapper/sim_world/Random.h>

#include <cmath>

namespace omnimapper::sim {

namespace {

constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15ULL;

std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

}  // namespace

Random::Random(std::uint64_t seed, std::initializer_list<std::uint64_t> names) : state_(mixed(seed + kStep)) {
  for (const std::uint64_t name : names) state_ = mixed(state_ + kStep * (name + 1));
}

std::uint64_t Random::bits() {
  state_ += kStep;
  return mixed(state_);
}

double Random::uniform() {
  return static_cast<double>(bits() >> 11) * 0x1p-53;
}

int Random::integer(int low, int high) {
  return low + static_cast<int>(uniform() * (high - low + 1.0));
}

double Random::gaussian() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  // Box and Muller; 1 - uniform() is never zero.
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform())), angle = 2.0 * M_PI * uniform();
  spare_ = radius * std::sin(angle);
  has_spare_ = true;
  return radius * std::cos(angle);
}

}  // namespace omnimapper::sim
