#pragma once

#include <omnimapper/signs/SignDetector.h>

namespace omnimapper::signs {

struct SaliencyOptions {
  int working_width = 256;     ///< [px] width of the largest picture in which saliency is computed
  int scales = 3;              ///< number of picture sizes; each has half the width of the one before
  double min_saliency = 2;     ///< lowest threshold, as a multiple of the mean saliency of the picture
  int levels = 3;              ///< number of thresholds; each is twice the one before
  int min_width = 20;          ///< [px] smallest width of a region
  int min_height = 14;         ///< [px] smallest height of a region
  double max_share = 0.6;      ///< largest width or height of a region, as a share of the picture's
  double surroundings = 0.35;  ///< margin around a component that is searched for the plate, relative to its size
  bool fit_plates = true;      ///< false: regions are the boxes of components, as in the thesis
};

/// Proposes regions of a picture that stand out from the rest of it (thesis 3.5.1.1). OpenCV's module saliency computes
/// the spectral residual (Hou and Zhang: Saliency detection: a spectral residual approach, 2007); connected components
/// of the salient pixels are the regions, and regions of unsuitable size are left out.
///
/// It goes beyond the thesis in two respects. First, saliency is computed at several sizes of the picture and compared
/// with several thresholds, because in a picture of the usual 64 pixels of width a sign is only a few pixels wide.
/// Second, since a component covers a sign's text rather than its plate, the plate around it replaces the component.
/// The plate is the connected region whose colour differs from the rim of the component's surroundings; its four
/// corners are the outermost points of its convex hull. Pure and thread-safe.
class SaliencyProposer {
 public:
  explicit SaliencyProposer(const SaliencyOptions& options) : options_(options) {}

  /// Of several regions that overlap by at least 0.9 (intersection over union), only the first is returned. Throws as
  /// SignDetector::detect().
  std::vector<Corners> propose(const camera::ColourImage& picture) const;

 private:
  SaliencyOptions options_;
};

}  // namespace omnimapper::signs
