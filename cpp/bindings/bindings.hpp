/// What the binding files share: array types and their conversion to and from the core's types.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

#include "core/curve.hpp"
#include "core/free_space.hpp"

namespace planformer {

namespace nb = nanobind;

/// A robot-inflated map: (H, W), true where blocked. As for all arrays that come in, one of another
/// element type or layout is converted on the way.
using BlockedArray = nb::ndarray<const bool, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

/// Poses: (N, 3) of x, y [m] and yaw [rad].
using PosesArray = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

/// One pose: x, y [m] and yaw [rad].
using PoseArray = nb::ndarray<const double, nb::shape<3>, nb::c_contig, nb::device::cpu>;

template <typename T>
using NumpyArray = nb::ndarray<nb::numpy, T>;

/// The grid's cells without a copy. Raises ValueError for a size or resolution that none can have.
FreeSpace free_space_of(const BlockedArray& blocked, double resolution);

/// Raises ValueError for a value that is not finite or not > 0.
void require_positive(const char* name, double value);

/// The pose in three consecutive numbers.
inline Pose to_pose(const double* xy_yaw) { return {xy_yaw[0], xy_yaw[1], xy_yaw[2]}; }

/// A NumPy array of the given shape that owns the values.
template <typename T>
NumpyArray<T> to_numpy(std::vector<T> values, std::initializer_list<std::size_t> shape) {
    auto* owned = new std::vector<T>(std::move(values));
    const nb::capsule owner(owned,
                            [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
    return {owned->data(), shape, owner};
}

/// An (N, 3) NumPy array of poses.
NumpyArray<double> to_numpy(const std::vector<Pose>& poses);

void register_curves(nb::module_& m);
void register_grid_search(nb::module_& m);
void register_planning(nb::module_& m);

}  // namespace planformer
