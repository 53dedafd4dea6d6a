/// Shortest curves of a car that drives forward only.
#pragma once

#include "core/curve.hpp"

namespace planformer {

/// The shortest forward curve between two poses whose turning radius [m] is at least the given one:
/// L. E. Dubins, "On curves of minimal length with a constraint on average curvature, and with
/// prescribed initial and terminal positions and tangents", American J. of Mathematics 79, 1957.
///
/// Finite for all finite poses and a finite radius > 0, `Curve::unreachable` otherwise. The curve
/// ends within 1e-7 turning radii and rad of `to`. The distance is discontinuous: where an offset
/// of the goal within rounding would add a whole turn, the shorter curve is taken.
Curve dubins(const Pose& from, const Pose& to, double turning_radius);

/// The length [m] of `dubins(from, to, turning_radius)` without building it; infinite when there is
/// none.
double dubins_length(const Pose& from, const Pose& to, double turning_radius);

}  // namespace planformer
