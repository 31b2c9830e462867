#pragma once

#include <omnimapper/surfaces/Classification.h>
#include <omnimapper/surfaces/SurfaceFacts.h>

#include <vector>

namespace omnimapper::surfaces {

/// Corrects judgements, of each surface by its own facts, by what is beside, behind and above the surfaces:
/// - Two faces back to back, as far apart as a door leaf is thick and not wider than one, are a door.
/// - A wall is no narrower than a door, unless it is high, and is no front of a box; what is as
///   narrow as a wall is thick is a door frame.
/// - A seat without a back or arms that is as deep as a coffee table is a table.
/// The reason of a corrected judgement says why.
void judgeInContext(const std::vector<Surface>& surfaces, const std::vector<SurfaceFacts>& facts,
                    std::vector<Judgement>& judgements);

}  // namespace omnimapper::surfaces
