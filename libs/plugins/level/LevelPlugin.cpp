#include "LevelPlugin.h"

#include <utility>

namespace omnimapper::plugins {

mapper::Batch LevelPlugin::atEnd(const mapper::View& view) {
  mapper::Batch batch;
  if (view.map_is_held) return batch;
  auto judged = estimateLevel(view, evidence_, motion_, options_);
  warnings_ = std::move(judged.warnings);
  batch.setLayer(std::move(judged.level));
  return batch;
}

}  // namespace omnimapper::plugins
