#include "bindings/bindings.hpp"
namespace planformer { void register_curves(nb::module_&) {} }
