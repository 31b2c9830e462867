#pragma once

#include <omnimapper/interaction/PointingModel.h>

namespace omnimapper::interaction {

enum class SkeletonSoftware { ms_sdk, openni };

/// A column of Tables 12 and 13 of the thesis: targets 1 to 7, right arms of six users two metres from the sensor. The
/// thesis states no directions of the targets. Target 0 is the column of all targets, whose values follow from the
/// others. Three standard deviations of target 7 are printed with a minus sign there. Throws std::out_of_range for
/// other targets.
PointingRow thesisRow(SkeletonSoftware software, int target);

/// The model of these tables, with the rows of targets 1 to 7.
PointingModel thesisModel(SkeletonSoftware software);

}  // namespace omnimapper::interaction
