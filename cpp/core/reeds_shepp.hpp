/// Shortest curves of a car that drives forward and in reverse.
#pragma once

#include "core/curve.hpp"

namespace planformer {

/// The shortest curve between two poses, forward and reverse, whose turning radius [m] is at least
/// the given one: J. A. Reeds and L. A. Shepp, "Optimal paths for a car that goes both forwards and
/// backwards", Pacific Journal of Mathematics 145(2), 1990 (all 48 words).
///
/// Finite for all finite poses and a finite radius > 0, `Curve::unreachable` otherwise. The curve
/// ends within 1e-7 turning radii and rad of `to` and is never longer than a Dubins curve. The
/// curve from `to` to `from` is the same one, driven the other way.
Curve reeds_shepp(const Pose& from, const Pose& to, double turning_radius);

/// The length [m] of `reeds_shepp(from, to, turning_radius)` without building it; infinite when
/// there is none.
double reeds_shepp_length(const Pose& from, const Pose& to, double turning_radius);

}  // namespace planformer
