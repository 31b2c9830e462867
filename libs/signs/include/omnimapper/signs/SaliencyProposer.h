#pragma once

#include <omnimapper/signs/SignDetector.h>

namespace omnimapper::signs {

struct SaliencyOptions {
  int working_width = 256;     ///< of the largest picture in which saliency is computed [px]
  int scales = 3;              ///< each further one has half the width
  double min_saliency = 2;     ///< times the mean saliency of the picture
  int levels = 3;              ///< each further one is twice as high
  int min_width = 20;          ///< of a region [px]
  int min_height = 14;         ///< of a region [px]
  double max_share = 0.6;      ///< of the picture's width or height
  double surroundings = 0.35;  ///< what is searched around a component for the plate, in its longer side
  bool fit_plates = true;      ///< false: boxes of components, as in the thesis
};

/// Regions of a picture that stand out from the rest of it (thesis 3.5.1.1): spectral residual (Hou and Zhang: Saliency
/// detection: a spectral residual approach, 2007) by OpenCV's module saliency, connected components of what is salient,
/// and a filter of sizes.
///
/// Two things are more than the thesis has. Saliency is computed at several sizes of the picture and cut at several
/// heights, for at the usual 64 pixels of width a sign is a few pixels. And a component, which covers a sign's text
/// rather than its plate, is replaced by the plate around it: what differs in colour from the rim of the component's
/// surroundings and is connected; its four corners are those of its convex hull. Pure and thread-safe.
class SaliencyProposer {
 public:
  explicit SaliencyProposer(const SaliencyOptions& options) : options_(options) {}

  /// Each region once: of several that overlap by 0.9 the first. Throws as SignDetector::detect().
  std::vector<Corners> propose(const perception::ColourImage& picture) const;

 private:
  SaliencyOptions options_;
};

}  // namespace omnimapper::signs
