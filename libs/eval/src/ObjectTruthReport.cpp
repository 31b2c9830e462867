#include <omnimapper/base/Numbers.h>
#include <omnimapper/eval/ObjectTruth.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace omnimapper::eval {

namespace {

std::size_t countSeen(const std::vector<SeenObject>& seen) {
  return static_cast<std::size_t>(
      std::count_if(seen.begin(), seen.end(), [](const SeenObject& object) { return object.is_seen; }));
}

}  // namespace

std::string table(const std::vector<SeenObject>& seen, const std::vector<TrueObject>& objects) {
  std::string text = std::to_string(countSeen(seen)) + " of " + base::counted(seen.size(), "object") +
                     (seen.size() == 1 ? " was" : " were") + " seen often enough\n";
  char row[300];
  const auto add = [&](const std::string& name, const std::string& shape, const std::string& images,
                       const std::string& pixels, const std::string& nearest, const std::string& is_seen) {
    std::snprintf(row, sizeof row, "  %-24s %-8s %7s %12s %10s  %s\n", name.c_str(), shape.c_str(), images.c_str(),
                  pixels.c_str(), nearest.c_str(), is_seen.c_str());
    text += row;
  };
  add("object", "shape", "images", "most pixels", "nearest", "seen");
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const SeenObject& object = seen[i];
    add(object.object, objects[i].shape, std::to_string(object.images), std::to_string(object.most_pixels),
        std::isfinite(object.nearest) ? base::fixed(object.nearest, 2) + " m" : "-", object.is_seen ? "yes" : "no");
  }
  return text;
}

std::string json(const std::vector<SeenObject>& seen, const std::vector<TrueObject>& objects) {
  auto list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const SeenObject& object = seen[i];
    list.push_back({{"object", object.object},
                    {"shape", objects[i].shape},
                    {"images", object.images},
                    {"most_pixels", object.most_pixels},
                    {"nearest_m", std::isfinite(object.nearest) ? nlohmann::ordered_json(object.nearest)
                                                                : nlohmann::ordered_json(nullptr)},
                    {"seen", object.is_seen}});
  }
  const nlohmann::ordered_json all{{"objects", seen.size()}, {"seen", countSeen(seen)}, {"each", list}};
  return all.dump(2) + "\n";
}

}  // namespace omnimapper::eval
