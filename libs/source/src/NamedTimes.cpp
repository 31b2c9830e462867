#include <omnimapper/source/NamedTimes.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>

namespace omnimapper::source {

namespace {

// Unix time that the file is named by [s]; none if the name is no such number, or a time before 1973 or after 2286.
std::optional<double> timeOf(const std::filesystem::path& file) {
  constexpr double kFirst = 1e8, kLast = 1e10, kNanosecond = 1e-9;
  const std::string stem = file.stem().string();
  const bool is_number = !stem.empty() && stem.size() < 24 && std::count(stem.begin(), stem.end(), '.') <= 1 &&
                         stem.find_first_not_of("0123456789.") == std::string::npos && stem != ".";
  if (!is_number) return std::nullopt;
  const double value = std::strtod(stem.c_str(), nullptr);
  for (const double seconds : {value, kNanosecond * value}) {
    if (seconds >= kFirst && seconds < kLast) return seconds;
  }
  return std::nullopt;
}

}  // namespace

std::vector<double> timesOfNames(const std::vector<std::string>& files) {
  std::vector<double> times;
  for (const auto& file : files) {
    const auto time = timeOf(file);
    if (!time || (!times.empty() && *time <= times.back())) return {};
    times.push_back(*time);
  }
  return times;
}

}  // namespace omnimapper::source
