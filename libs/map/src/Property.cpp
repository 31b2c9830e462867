#include <omnimapper/base/Numbers.h>
#include <omnimapper/map/Property.h>

namespace omnimapper::map {

namespace {

struct Text {
  std::string operator()(const std::string& text) const { return text; }
  std::string operator()(std::uint64_t count) const { return std::to_string(count); }
  std::string operator()(const Measure& measure) const { return base::fixed(measure.value, 3); }
  std::string operator()(bool flag) const { return flag ? "yes" : "no"; }
  std::string operator()(base::Stamp stamp) const { return base::formatUnix(stamp); }
};

}  // namespace

std::string keyOf(const Property& property) {
  const auto* measure = std::get_if<Measure>(&property.value);
  return measure && !measure->unit.empty() ? property.name + "_" + measure->unit : property.name;
}

std::string textOf(const Property& property) {
  return std::visit(Text(), property.value);
}

}  // namespace omnimapper::map
