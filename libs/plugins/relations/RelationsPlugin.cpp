#include "RelationsPlugin.h"

#include <algorithm>

#include "RelationFactors.h"
#include "Relations.h"

namespace omnimapper::plugins {

const base::OptionTable<RelationsOptions>& RelationsOptions::table() {
  using Options = RelationsOptions;
  using base::Range;
  static const auto table =
      base::OptionTable<Options>()
          .flag("point_on_wall", &Options::point_on_wall,
                "Relates points to the walls, tables and other surfaces that they lie on.")
          .flag("parallel", &Options::parallel, "Relates walls and planes that are parallel.")
          .flag("perpendicular", &Options::perpendicular, "Relates walls and planes that are at right angles.")
          .flag("aligned", &Options::aligned, "Relates walls that lie on one line and surfaces that lie on one plane.")
          .number("distance_sigma_m", &Options::distance_sigma, Range::positive(),
                  "Standard deviation of the distance of a point from the wall or table that it lies on, and of a wall "
                  "from the line that it shares with another wall.")
          .number("angle_sigma_deg", &Options::angle_sigma, Range::positive(),
                  "Standard deviation of the angle by which related walls deviate from parallel or from a right angle.")
          .number("max_distance_m", &Options::max_distance, Range::positive(),
                  "Largest distance of a point from a surface, or of a wall from the line of another wall, at which a "
                  "relation is considered.")
          .number("max_angle_deg", &Options::max_angle, Range::positive(),
                  "A relation between two walls is considered only if they deviate from parallel or from a right angle "
                  "by at most this.")
          .number("min_likelihood_ratio", &Options::min_likelihood_ratio, Range::positive(),
                  "A relation is proposed only if the estimate is at least this many times likelier if the relation "
                  "holds than if the two landmarks are unrelated.")
          .integer("min_measurements", &Options::min_measurements, Range{1, 1e9},
                   "A relation is considered only if each of its two landmarks has at least this many measurements.");
  return table;
}

RelationsPlugin::RelationsPlugin(const RelationsOptions& options, const mapper::PluginContext& context)
    : options_(options), section_(context.section) {}

RelationsPlugin::~RelationsPlugin() = default;

mapper::FollowUp RelationsPlugin::afterCommit(const map::KeyFrame&, const mapper::View& view) {
  if (view.solves.size() == solves_ || view.map_is_held) return {};
  solves_ = view.solves.size();
  return {propose(view), {}};
}

mapper::Batch RelationsPlugin::atEnd(const mapper::View& view) {
  return view.map_is_held ? mapper::Batch() : propose(view);
}

// The relations that were proposed before are read from the graph, because their landmarks may have been merged since.
mapper::Batch RelationsPlugin::propose(const mapper::View& view) {
  KnownRelations known;
  for (const auto& [id, record] : view.graph.factors()) {
    if (record.tags.owner == section_ && record.variables.size() == 2)
      known[{std::string(record.factor->kind()), std::minmax(record.variables[0], record.variables[1])}] =
          record.weight > 0;
  }
  mapper::Batch batch;
  for (Relation& relation : findRelations(view, options_, known)) {
    mapper::Decision decision(view.map.key_frames.back(), section_, relation.name);
    decision.reason = "waits for the consistency test";
    decision.numbers = {{"landmark variable", relation.record.variables[0].index},
                        {"other", relation.record.variables[1].index},
                        {"chi-square", relation.chi2},
                        {"likelihood ratio", relation.likelihood_ratio}};
    relation.record.tags.owner = section_;
    batch.addGatedHypothesis(std::move(relation.record), std::move(decision));
  }
  return batch;
}

void RelationsPlugin::registerKinds(mapper::Kinds& kinds) {
  addRelationsTo(kinds.factors);
}

}  // namespace omnimapper::plugins
