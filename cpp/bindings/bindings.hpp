#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <vector>

#include "core/free_space.hpp"

namespace planformer {

namespace nb = nanobind;

/// A robot-inflated map: (H, W), true where blocked.
using BlockedArray = nb::ndarray<const bool, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

inline FreeSpace free_space_of(const BlockedArray& blocked, double resolution) {
    static_assert(sizeof(bool) == sizeof(std::uint8_t));
    return {static_cast<int>(blocked.shape(0)), static_cast<int>(blocked.shape(1)), resolution,
            reinterpret_cast<const std::uint8_t*>(blocked.data())};
}

/// An (N, columns) NumPy array that owns its rows.
template <typename T>
nb::ndarray<nb::numpy, T> to_numpy(std::vector<T> values, std::size_t columns) {
    auto* owned = new std::vector<T>(std::move(values));
    const nb::capsule owner(owned, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
    const std::size_t shape[2] = {owned->size() / columns, columns};
    return nb::ndarray<nb::numpy, T>(owned->data(), 2, shape, owner);
}

void register_curves(nb::module_& m);
void register_grid_search(nb::module_& m);
void register_planning(nb::module_& m);

}  // namespace planformer
