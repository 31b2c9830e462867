#pragma once

#include <cstdint>
#include <initializer_list>

namespace omnimapper::sim {

/// A stream of random numbers that depends only on the seed and on its names, such as the numbers of a sensor and a
/// measurement. Code that draws from separate streams therefore gets the same numbers on any number of threads and in
/// any order. Generator: splitmix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, OOPSLA 2014).
class Random {
 public:
  Random(std::uint64_t seed, std::initializer_list<std::uint64_t> names);

  std::uint64_t bits();
  /// In [0, 1).
  double uniform();
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// In [low, high], both included.
  int integer(int low, int high);
  bool chance(double probability) { return uniform() < probability; }
  /// Mean 0, standard deviation 1.
  double gaussian();
  double gaussian(double sigma) { return sigma * gaussian(); }

 private:
  std::uint64_t state_;
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace omnimapper::sim
