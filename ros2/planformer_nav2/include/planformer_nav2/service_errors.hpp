#pragma once

#include <cstdint>
#include <string>

namespace planformer_nav2 {

/// Throws Nav2's exception for an error code of ProposeRegion; an unknown code is no special one.
[[noreturn]] void throw_service_error(std::uint16_t code, const std::string& message);

}  // namespace planformer_nav2
