// Inputs and states that cannot be meant have the status that the header names and no numbers, and change no state.
#pragma once

#include <limits>
#include <stdexcept>

#include <rollbem/detail/finite.hpp>

#include "laws/force_element.hpp"

namespace laws {

/// Besides what the element lists, no input that is no number is ok, and numbers of any size have finite answers or a
/// status; either may be refused by name instead, where an object is made of it.
inline void refuses(const ForceElement& of, int scenes = 3) {
    REQUIRE(of.refusals.size() + of.spoilt.size() > 0);
    const auto check = [](const Answer& refused, Status status) {
        CAPTURE(name(refused.status), name(status));
        CHECK(refused.status == status);
        for (const double value : refused.values) CHECK(detail::is_nan(value));
        for (const double slope : refused.tangent.reshaped()) CHECK(detail::is_nan(slope));
        CHECK(refused.keeps_target);
    };
    for_each_scene(of, scenes, [&](const Numbers& x) {
        const auto with = [&](Eigen::Index input, double bad) {
            Numbers changed = x;
            changed[input] = bad;
            try {
                return of.answer(changed);
            } catch (const std::invalid_argument&) {
                return Answer{{}, {}, Status::invalid_load};
            }
        };
        for (const Refusal& refusal : of.refusals) {
            for (const double bad : refusal.bad) {
                CAPTURE(refusal.input, bad);
                check(with(static_cast<Eigen::Index>(refusal.input), bad), refusal.status);
            }
        }
        for (Eigen::Index input = 0; input < x.size(); ++input) {
            CAPTURE(input);
            for (const double none : {nan, infinite, -infinite}) CHECK(with(input, none).status != Status::ok);
            for (const double size : {std::numeric_limits<double>::denorm_min(), 1e-310, 1e-305, 1e-160, 1e160, 1e300,
                                      (std::numeric_limits<double>::max)()}) {
                const Answer at = with(input, size);
                CAPTURE(size);
                if (at.status == Status::ok) CHECK((detail::all_finite(at.values) && detail::all_finite(at.tangent)));
            }
        }
    });
    for (const Spoilt& spoilt : of.spoilt) {
        Draw draw(17);
        const Numbers x = of.draw(draw);
        spoilt.spoil();
        INFO(of.name << ": " << spoilt.what);
        check(of.answer(x), spoilt.status);
    }
}

}  // namespace laws
