// Stand-in for the tests, see README.md in test/interfaces.
#pragma once

namespace tf2_ros {

class Buffer {};

}  // namespace tf2_ros
