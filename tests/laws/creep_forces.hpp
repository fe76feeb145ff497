// Force elements of tests/laws: creep forces by look-up, FASTSIM and FaStrip.
#pragma once

#include <cmath>
#include <memory>

#include <rollbem/vehicle.hpp>

#include "laws/force_element.hpp"
#include "vehicle/creep_force_scene.hpp"

namespace laws {

namespace creep_forces_detail {

constexpr double a = 5e-3, N = 8e4, G = 8e10, mu = 0.3, unit = mu * N / (4 * G * a * a);
const std::vector<Quantity> inputs{{unit}, {unit}, {unit / a, -1}, {N, 2, 1}, {mu}, {a, 1}, {a, 1}, {G, 0, 1}};
const std::vector<Quantity> values{{mu * N, 2, 1}, {mu * N, 2, 1}, {mu * N * a, 3, 1}};

/// From a tenth of the creepages that saturate to ten times them.
inline Numbers draw_inputs(Draw& draw) {
    const double level = draw.decades(-1, 1), a_over_b = draw.decades(-0.25, 0.25);
    Numbers x(8);
    x << level * unit * draw.normal(), level * unit * draw.normal(), level * unit / a * draw.normal(),
        N * draw.uniform(0.5, 1.5), mu * draw.uniform(0.5, 1.5), a * std::sqrt(a_over_b), a / std::sqrt(a_over_b), G;
    return x;
}
inline Creepage creepage_in(const Numbers& x) { return {x[0], x[1], x[2]}; }
inline PatchContact contact_in(const Numbers& x) { return PatchContact({x[5], x[6], x[7], 0.28}); }

inline Answer answer_of(const CreepForceTable::Force& at) {
    const Eigen::Matrix<double, 3, 8> all = creep_forces::numbers(at).matrix();
    return {all.col(0), all.rightCols<7>(), at.status};
}

inline const std::vector<Symmetry> symmetries{{"across the track", "+--+++++", "+--"},
                                              {"backward motion", "---+++++", "---"}};
inline const std::vector<double> not_a_load{-1, -1e-300, nan, infinite};
inline const std::vector<Refusal> refusals{{0, {nan, infinite}, Status::not_finite},
                                           {1, {nan, -infinite}, Status::not_finite},
                                           {2, {nan, infinite}, Status::not_finite},
                                           {3, not_a_load, Status::invalid_load},
                                           {4, not_a_load, Status::invalid_load}};

}  // namespace creep_forces_detail

/// Creepages and spin, N, mu, a, b, G.
inline ForceElement creep_force_table() {
    using namespace creep_forces_detail;
    const auto table = std::make_shared<const CreepForceTable>(creep_forces::table(6, 5));
    return {
        .name = "a table of creep forces",
        .inputs = inputs,
        .values = values,
        .draw = draw_inputs,
        .answer =
            [table](const Numbers& x) { return answer_of(table->look_up(contact_in(x), x[4], x[3], creepage_in(x))); },
        .symmetries = symmetries,
        .refusals = refusals,
        .motions = 3};
}

/// The same on wet rails; V and its tangent stand in the place of G, and time is counted by the fall of friction.
inline ForceElement reduced_friction() {
    using namespace creep_forces_detail;
    const auto table = std::make_shared<const CreepForceTable>(creep_forces::table(6, 5));
    ForceElement result = creep_force_table();
    result.name = "reduced friction";
    result.inputs[7] = {20, 1, 0, -1};
    result.inputs.push_back({G, 0, 1});
    result.inputs.push_back({0.6, -1, 0, 1});
    result.draw = [](Draw& draw) {
        Numbers x(10);
        x << draw_inputs(draw).head(7), draw.uniform(1, 40), G, 0.6;
        return x;
    };
    result.answer = [table](const Numbers& x) {
        Numbers own = x.head(8);
        own[7] = x[8];
        const ReducedFriction wet({.adhesion_factor = 0.6, .slip_factor = 0.25, .friction_ratio = 0.4, .fall = x[9]});
        const auto at = wet.look_up(*table, contact_in(own), x[4], x[3], x[7], creepage_in(x));
        Answer answer = answer_of(at);
        answer.tangent.conservativeResize(3, 8);
        answer.tangent.col(7) = creep_forces::array(at.tangent_by_speed);
        return answer;
    };
    for (Symmetry& symmetry : result.symmetries) symmetry.inputs += "++";
    result.refusals.push_back({7, {nan, infinite}, Status::not_finite});
    result.refusals.push_back({7, {-1, -1e-300}, Status::invalid_step});
    return result;
}

/// FASTSIM, or FaStrip, with tractions up to mu p; no tangent.
inline ForceElement simplified_theory(bool by_strips) {
    using namespace creep_forces_detail;
    ForceElement result = creep_force_table();
    result.name = by_strips ? "FaStrip" : "FASTSIM";
    result.answer = [by_strips](const Numbers& x) {
        const SimplifiedTheory theory(contact_in(x), {4.8, 4.4, 2.0, -2.0, 0.9}, x[4], x[3]);
        const SimplifiedTheory::Force at = by_strips ? theory.fastrip(creepage_in(x)) : theory.fastsim(creepage_in(x));
        Answer answer{Numbers(3), Tangent(3, 0), at.status};
        answer.values = creep_forces::array(at.force);
        return answer;
    };
    result.refusals.resize(3);
    return result;
}

}  // namespace laws
