#pragma once

namespace planformer {

/// Names a member of one of OMPL's classes that is not public, which only an explicit instantiation
/// may do ([temp.explicit] in the C++ standard):
///
///     struct Tag {
///         friend constexpr auto exposed(Tag);
///     };
///     template struct Expose<Tag, &Class::member>;
///     object.*exposed(Tag{})
///
/// Tags lie in this namespace itself, where the two declarations of `exposed` meet.
template <typename Tag, auto Member>
struct Expose {
    friend constexpr auto exposed(Tag) { return Member; }
};

}  // namespace planformer
