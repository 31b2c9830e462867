#include <omnimapper/base/Numbers.h>
#include <omnimapper/building/RoomKinds.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::building {

namespace {

constexpr std::size_t kClasses = 7;  // the first features are numbers of surfaces of a class

std::size_t binOf(double value, const std::vector<double>& limits) {
  return static_cast<std::size_t>(std::upper_bound(limits.begin(), limits.end(), value) - limits.begin());
}

double squaresIn(const Room& room) {
  const double side = 2 * room.clearance;
  return side > 0 ? room.area / (side * side) : 1;
}

std::string contentsText(const RoomContents& contents, const Room& room, std::size_t doors, bool sees_things) {
  std::string text;
  for (std::size_t i = 0; sees_things && i < kClasses; ++i) {
    const auto& name = kindFeatures()[i].name;
    if (const auto found = contents.find(name); found != contents.end() && found->second > 0)
      text += std::to_string(found->second) + " " + name + ", ";
  }
  return text + base::fixed(room.area, 1) + " m2, " + base::counted(doors, "door");
}

}  // namespace

const std::vector<KindFeature>& kindFeatures() {
  static const std::vector<KindFeature> features{{"bed", 3},     {"appliance", 3}, {"seat", 3},    {"table", 3},
                                                 {"counter", 3}, {"shelf", 3},     {"cabinet", 3}, {"area", 6},
                                                 {"squares", 4}, {"doors", 4}};
  return features;
}

std::vector<std::size_t> kindBins(const Room& room, std::size_t doors, const RoomContents& contents) {
  std::vector<std::size_t> bins;
  for (std::size_t i = 0; i < kClasses; ++i) {
    const auto found = contents.find(kindFeatures()[i].name);
    bins.push_back(binOf(found == contents.end() ? 0 : found->second, {1, 3}));
  }
  bins.push_back(binOf(room.area, {4, 8, 14, 25, 60}));
  bins.push_back(binOf(squaresIn(room), {1.35, 2, 3.5}));
  bins.push_back(binOf(static_cast<double>(doors), {2, 3, 5}));
  return bins;
}

std::vector<std::pair<std::string, double>> likelyKinds(const KindModel& model, const std::vector<std::size_t>& bins,
                                                        bool sees_things) {
  std::vector<double> logarithms;
  for (const auto& of_kind : model.log_likelihood) {
    double sum = 0;
    for (std::size_t i = sees_things ? 0 : kClasses; i < bins.size(); ++i) sum += of_kind[i][bins[i]];
    logarithms.push_back(model.tempering * sum);
  }
  std::vector<std::pair<std::string, double>> kinds;
  if (logarithms.empty()) return kinds;
  const double most = *std::max_element(logarithms.begin(), logarithms.end());
  double sum = 0;
  for (const double each : logarithms) sum += std::exp(each - most);
  for (std::size_t i = 0; i < logarithms.size(); ++i)
    kinds.emplace_back(model.kinds[i], std::exp(logarithms[i] - most) / sum);
  std::stable_sort(kinds.begin(), kinds.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  return kinds;
}

void nameByContents(Storey& storey, const std::map<int, RoomContents>& contents, bool sees_things) {
  const auto isOfContents = [](const NameEvidence& each) { return each.source == NameEvidence::Source::contents; };
  for (Room& room : storey.rooms) {
    room.why.erase(std::remove_if(room.why.begin(), room.why.end(), isOfContents), room.why.end());
    const auto found = contents.find(room.id);
    const RoomContents& within = found == contents.end() ? RoomContents() : found->second;
    const auto doors =
        static_cast<std::size_t>(std::count_if(storey.doors.begin(), storey.doors.end(), [&](const Door& door) {
          return door.rooms[0] == room.id || door.rooms[1] == room.id;
        }));
    const auto kinds = likelyKinds(learnedKinds(), kindBins(room, doors, within), sees_things);
    if (kinds.empty()) continue;
    room.kind = kinds.front().first;
    room.kind_confidence = kinds.front().second;
    room.why.push_back({NameEvidence::Source::contents,
                        room.kind + " by " + contentsText(within, room, doors, sees_things), room.kind_confidence});
  }
}

}  // namespace omnimapper::building
