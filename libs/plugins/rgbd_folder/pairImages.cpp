#include "pairImages.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace omnimapper::source {

namespace fs = std::filesystem;

std::vector<RgbdPair> pairImages(const fs::path& folder, const std::vector<StampedImage>& depths,
                                 const std::vector<StampedImage>& colours, double largest_difference) {
  struct Candidate {
    double difference;
    std::size_t depth, colour;
  };
  std::vector<Candidate> candidates;
  for (std::size_t d = 0; d < depths.size(); ++d) {
    for (std::size_t c = 0; c < colours.size(); ++c) {
      const double difference = std::abs(base::secondsBetween(depths[d].first, colours[c].first));
      if (difference <= largest_difference) candidates.push_back({difference, d, c});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.difference < b.difference; });
  std::vector<bool> colour_taken(colours.size(), false);
  std::vector<std::string> colour_of(depths.size());
  for (const Candidate& candidate : candidates) {
    if (colour_taken[candidate.colour] || !colour_of[candidate.depth].empty()) continue;
    colour_taken[candidate.colour] = true;
    colour_of[candidate.depth] = (folder / colours[candidate.colour].second).string();
  }
  std::vector<RgbdPair> pairs;
  for (std::size_t d = 0; d < depths.size(); ++d)
    pairs.push_back({depths[d].first, (folder / depths[d].second).string(), colour_of[d]});
  return pairs;
}

bool ByNumber::operator()(const std::string& a, const std::string& b) const {
  const auto isNumber = [](const std::string& name) {
    return std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c); });
  };
  const bool a_is_number = isNumber(a), b_is_number = isNumber(b);
  if (a_is_number != b_is_number) return a_is_number;
  const auto digits = [](const std::string& name) {
    return name.substr(std::min(name.find_first_not_of('0'), name.size()));
  };
  const std::string a_digits = digits(a), b_digits = digits(b);
  if (!a_is_number || a_digits == b_digits) return a < b;
  return a_digits.size() != b_digits.size() ? a_digits.size() < b_digits.size() : a_digits < b_digits;
}

bool endsAsOneOf(const fs::path& file, const std::string& endings) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return !ending.empty() && (' ' + endings + ' ').find(' ' + ending + ' ') != std::string::npos;
}

FilesByStem filesByStem(const fs::path& folder, const std::string& endings) {
  FilesByStem files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (endsAsOneOf(entry.path(), endings) && entry.is_regular_file())
      files[entry.path().stem().string()] = entry.path().string();
  }
  return files;
}

base::Stamp stampOfImage(std::size_t index, const RgbdFolderOptions& options) {
  constexpr double kFirst = 1e9;  // [s] an arbitrary time, as the images have none
  return base::stampFromUnix(kFirst) + base::durationFromSeconds(static_cast<double>(index) / options.rate);
}

}  // namespace omnimapper::source
