#pragma once

#include <omnimapper/plugin/View.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace omnimapper::plugins {

/// The point landmarks with which a measurement may be associated.
class PointLandmarkIndex {
 public:
  /// `owner`: INI section.
  explicit PointLandmarkIndex(std::string owner) : owner_(std::move(owner)) {}

  void restore(const mapper::State& state);
  void add(base::LandmarkId id) { variables_[id]; }
  /// Removes landmarks that were retired or merged, and takes over those that were added.
  void update(const mapper::State& state);

  /// The landmark of that number; none for -1.
  std::optional<base::LandmarkId> ofNumber(std::int32_t number) const;
  base::VariableId variableOf(base::LandmarkId id) const { return variables_.at(id); }
  const std::map<base::LandmarkId, base::VariableId>& all() const { return variables_; }

 private:
  std::string owner_;
  std::map<base::LandmarkId, base::VariableId> variables_;
  std::map<std::int32_t, base::LandmarkId> of_numbers_;
};

}  // namespace omnimapper::plugins
