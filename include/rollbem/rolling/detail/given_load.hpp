// The load of a step, or none.
#pragma once

#include "../../detail/language.hpp"

namespace rollbem::detail {

/// The load of a step, or none: the state's load then remains.
template <class Load_>
class GivenLoad {
public:
    using Load = Load_;

    GivenLoad() = default;
    GivenLoad(const Load& load) : load_(&load) {}  // NOLINT: implicit on purpose
    GivenLoad(const Load&&) = delete;

    explicit operator bool() const { return load_ != nullptr; }
    const Load& operator*() const { return *load_; }
    const Load* operator->() const { return load_; }

private:
    const Load* load_ = nullptr;
};

}  // namespace rollbem::detail
