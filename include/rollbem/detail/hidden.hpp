// Hidden: a member whose type only the bodies know.
#pragma once

#include "language.hpp"

#include <memory>
#include <utility>

namespace rollbem::detail {

/// Owner of an object whose type the header only declares. made() in the bodies makes the object on first use, and
/// allocates only then. A copy has a copy of the object; a source that was moved from has none.
template <class Type>
class Hidden {
public:
    Hidden() = default;
    Hidden(const Hidden& other)
        : copy_(other.copy_),
          object_(other.object_ ? other.copy_(*other.object_) : nullptr, other.object_.get_deleter()) {}
    Hidden(Hidden&& other) noexcept = default;
    Hidden& operator=(Hidden other) noexcept {
        std::swap(copy_, other.copy_);
        std::swap(object_, other.object_);
        return *this;
    }
    ~Hidden() = default;

    /// Owns this object from the start.
    explicit Hidden(Type&& object)
        : copy_([](const Type& own) { return new Type(own); }),
          object_(new Type(std::move(object)), [](Type* own) { delete own; }) {}

    Type& made() {
        if (!object_) {
            object_ = {new Type, [](Type* object) { delete object; }};
            copy_ = [](const Type& object) { return new Type(object); };
        }
        return *object_;
    }
    Type* find() const noexcept { return object_.get(); }  ///< null if there is none
    /// The object, which must have been made.
    const Type& get() const { return *object_; }

private:
    Type* (*copy_)(const Type&) = nullptr;
    std::unique_ptr<Type, void (*)(Type*)> object_{nullptr, [](Type*) {}};
};

}  // namespace rollbem::detail
