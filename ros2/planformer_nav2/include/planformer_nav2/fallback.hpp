#pragma once

#include <exception>
#include <stdexcept>
#include <utility>

namespace planformer_nav2 {

/// Planning in a region failed, but the whole map may still hold a path. Nests the reason.
class GuidanceFailed : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

template <typename... Types>
bool is_one_of(const std::exception& error) {
    return (... || (dynamic_cast<const Types*>(&error) != nullptr));
}

/// Returns what the step returns. Errors of the types `Final` pass, others become GuidanceFailed.
template <typename... Final, typename Step>
auto recoverable(Step&& step) {
    try {
        return step();
    } catch (const std::exception& error) {
        if (is_one_of<Final...>(error)) throw;
        std::throw_with_nested(GuidanceFailed(error.what()));
    }
}

/// Returns what `guided` returns, or what `unguided` does if the former throws GuidanceFailed.
///
/// `report` is told why. Without a fallback the reason itself is thrown instead.
template <typename Guided, typename Unguided, typename Report>
auto with_fallback(bool fallback, Guided&& guided, Unguided&& unguided, Report&& report) {
    try {
        return guided();
    } catch (const GuidanceFailed& failure) {
        if (!fallback) {
            std::rethrow_if_nested(failure);
            throw;
        }
        report(failure.what());
    }
    // Not inside the handler: the failed attempt's exception is gone by now.
    return unguided();
}

}  // namespace planformer_nav2
