#include <ompl/util/Console.h>

#include "bindings/bindings.hpp"

NB_MODULE(_core, m) {
    m.doc() = "Compiled core of planformer: OMPL planning, car curves and grid search.";
    // Outcomes are returned; a library does not print.
    ompl::msg::noOutputHandler();
    planformer::register_curves(m);
    planformer::register_grid_search(m);
    planformer::register_planning(m);
}
