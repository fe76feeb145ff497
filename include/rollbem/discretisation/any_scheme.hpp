// AnyScheme: a scheme chosen at run time, so that templates that take a scheme are compiled once.
#pragma once

#include <concepts>
#include <functional>
#include <type_traits>
#include <utility>
#include <variant>

#include "../detail/require.hpp"
#include "scheme.hpp"

namespace rollbem {

/// Any RollingScheme, itself a scheme: AnyScheme scheme = Galerkin{}. A user's own scheme has rows in double only; rows
/// in other scalars throw std::invalid_argument.
class AnyScheme {
public:
    AnyScheme() = default;  ///< Collocation{}

    template <class Scheme>
    requires(!std::same_as<Scheme, AnyScheme> && RollingScheme<Scheme>) AnyScheme(Scheme scheme) {  // NOLINT: implicit
        if constexpr (std::is_constructible_v<Kind, std::in_place_type_t<Scheme>, Scheme>) {
            kind_ = std::move(scheme);
        } else {
            kind_ = Own{[own = std::move(scheme)](Quantity quantity, const Mesh<double>& mesh) {
                return own.rows(quantity, mesh);
            }};
        }
    }

    /// The scheme if it is one of the library's and of this type, else null.
    template <class Scheme>
    const Scheme* get_if() const {
        return std::get_if<Scheme>(&kind_);
    }

    template <class Scalar>
    SchemeRows<Scalar> rows(Quantity quantity, const Mesh<Scalar>& mesh) const {
        return std::visit([&](const auto& scheme) { return scheme.rows(quantity, mesh); }, kind_);
    }

private:
    struct Own {
        std::function<SchemeRows<double>(Quantity, const Mesh<double>&)> in_double;

        template <class Scalar>
        SchemeRows<Scalar> rows(Quantity quantity, const Mesh<Scalar>& mesh) const {
            if constexpr (std::same_as<Scalar, double>) return in_double(quantity, mesh);
            detail::require(false, "AnyScheme", "size of the scalar", sizeof(Scalar),
                            "be the size of double for a scheme of the user's own");
            return {};
        }
    };
    using Kind = std::variant<Collocation, Galerkin, KnotheBoundary, NodeDifference, Own>;

    Kind kind_;
};

}  // namespace rollbem
