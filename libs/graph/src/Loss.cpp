#include "omnimapper/graph/Loss.h"

#include <omnimapper/base/Error.h>

#include <cmath>
#include <string>

namespace omnimapper::graph {

Loss::Loss(Kind kind, double scale_sigmas) : kind_(kind), scale_(kind == Kind::none ? 1 : scale_sigmas) {
  if (kind > Kind::tukey)
    throw base::Error(base::ExitCode::internal,
                      "loss: there is no kind with number " + std::to_string(static_cast<int>(kind)));
  if (!(scale_ > 0) || !std::isfinite(scale_))
    throw base::Error(base::ExitCode::internal,
                      "loss: scale " + std::to_string(scale_sigmas) + " must be a positive number of sigmas");
}

Loss::Value Loss::evaluate(double s) const {
  const double c2 = scale_ * scale_;
  switch (kind_) {
    case Kind::huber: {
      if (s <= c2) return {s, 1, 0};
      const double norm = std::sqrt(s);
      return {2 * scale_ * norm - c2, scale_ / norm, -scale_ / (2 * norm * s)};
    }
    case Kind::cauchy: {
      const double inverse = 1 / (1 + s / c2);
      return {c2 * std::log1p(s / c2), inverse, -inverse * inverse / c2};
    }
    case Kind::tukey: {
      if (s >= c2) return {c2 / 3, 0, 0};
      const double rest = 1 - s / c2;
      return {c2 / 3 * (1 - rest * rest * rest), rest * rest, -2 * rest / c2};
    }
    case Kind::none:
      break;
  }
  return {s, 1, 0};
}

}  // namespace omnimapper::graph
