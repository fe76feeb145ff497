// Answers depend on inputs and state alone, to the last bit: not on what was asked before.
#pragma once

#include "friction/same_bits.hpp"
#include "laws/force_element.hpp"

namespace laws {

inline bool same(const Answer& one, const Answer& other) {
    return same_bits::same(one.values, other.values) && same_bits::same(one.tangent, other.tangent) &&
           one.status == other.status && one.branch == other.branch;
}

/// Asks again after other inputs and with a new workspace.
inline void has_no_past(const ForceElement& of, int scenes = 20) {
    for_each_scene(of, scenes, [&](const Numbers& x) {
        const Answer first = of.answer(x);
        Numbers other = x;
        for (const double factor : {0.5, 1.3, 1.0}) {
            other = x + (factor - 1) * 1e-2 * sizes(of.inputs);
            of.answer(other);
        }
        if (of.distract) of.distract(x);
        CHECK(same(of.answer(x), first));
        if (!of.forget) return;
        of.forget();
        CHECK(same(of.answer(x), first));
    });
}

}  // namespace laws
