// Force elements of tests/laws: Hertz's contacts, their pressures on meshes, and ellipses along the rolling direction.
#pragma once

#include <memory>

#include <rollbem/patch.hpp>

#include "laws/force_element.hpp"

namespace laws {

namespace hertz_detail {

constexpr double N = 1e5, R = 0.46, E = 2.1e11, a = 5e-3;

inline HertzEllipse ellipse_under(double load, double scale = 1) {
    const ElasticBody steel{E, 0.28};
    return HertzEllipse({.load = load,
                         .radii_1 = {scale * R, infinite},
                         .radii_2 = {infinite, scale * 0.3},
                         .body_1 = steel,
                         .body_2 = steel});
}

}  // namespace hertz_detail

/// Semi-axes, approach and peak pressure by the load; radii of a wheel, a radius and the angle of a rail, E.
inline ForceElement hertz_ellipse() {
    using namespace hertz_detail;
    return {.name = "Hertz's ellipse",
            .inputs = {{N, 2, 1}, {R, 1}, {R, 1}, {0.3, 1}, {0.1}, {E, 0, 1}},
            .values = {{a, 1}, {a, 1}, {1e-4, 1}, {1e9, 0, 1}, {0.1}},
            .draw =
                [](Draw& draw) {
                    Numbers x(6);
                    x << N * draw.decades(-1, 0.3), R * draw.decades(-0.2, 0.2), R * draw.decades(0, 0.5),
                        0.3 * draw.decades(-0.3, 0.3), draw.uniform(-0.3, 0.3), E;
                    return x;
                },
            .answer =
                [](const Numbers& x) {
                    const ElasticBody steel{x[5], 0.28};
                    const HertzEllipse at({.load = x[0],
                                           .radii_1 = {x[1], x[2]},
                                           .radii_2 = {infinite, x[3]},
                                           .angle = x[4],
                                           .body_1 = steel,
                                           .body_2 = steel});
                    Answer answer{Numbers(5), Tangent(3, 1)};
                    answer.values << at.half_length(), at.half_width(), at.approach(), at.peak_pressure(), at.turn();
                    answer.tangent << at.half_length_rate(), at.half_width_rate(), at.approach_rate();
                    return answer;
                },
            .symmetries = {{"across the track", "++++-+", "++++-"}}};
}

/// Semi-axes along the rolling direction, by those of an ellipse and its turn.
inline ForceElement ellipse_along_rolling() {
    using namespace hertz_detail;
    return {.name = "a turned ellipse along the rolling direction",
            .inputs = {{a, 1}, {a, 1}, {1}},
            .values = {{a, 1}, {a, 1}},
            .draw =
                [](Draw& draw) {
                    Numbers x(3);
                    x << a * draw.decades(-0.5, 0.5), a * draw.decades(-0.5, 0.5), draw.uniform(-1.5, 1.5);
                    return x;
                },
            .answer =
                [](const Numbers& x) {
                    const SemiAxes::AlongRolling at = rolling_ellipse({x[0], x[1]}, x[2]);
                    Answer answer{Numbers(2), Tangent(2, 3)};
                    answer.values << at.axes.half_length, at.axes.half_width;
                    answer.tangent << at.by_half_length.half_length, at.by_half_width.half_length,
                        at.by_turn.half_length, at.by_half_length.half_width, at.by_half_width.half_width,
                        at.by_turn.half_width;
                    return answer;
                },
            .symmetries = {{"the other turn", "++-", "++"}}};
}

/// Semi-axes, of about `axis`, and pressures of a mesh by the load, from `least` to 1.4 times N; `beyond` times N is
/// refused.
template <class Load>
ForceElement hertz_load_on(const char* name, const Load& mesh, double axis, double N, double least, double beyond) {
    const auto hertz = std::make_shared<const Load>(mesh);
    const auto load = std::make_shared<NormalLoad>(hertz->at(N));
    const Eigen::Index n = load->normal_pressure.size();
    return {.name = name,
            .inputs = {{N}},
            .values = std::vector<Quantity>(static_cast<std::size_t>(n + 2), {1e9}),
            .draw = [=](Draw& draw) { return Numbers(Numbers::Constant(1, N * draw.uniform(least, 1.4))); },
            .answer =
                [=](const Numbers& x) {
                    Answer answer{Numbers(n + 2), Tangent(n + 2, 1), hertz->set(x[0], *load)};
                    double width_rate = 0;
                    if constexpr (requires { hertz->half_width_rate(N); }) width_rate = hertz->half_width_rate(x[0]);
                    answer.values << 1e9 / axis * load->half_length, 1e9 / axis * load->half_width,
                        load->normal_pressure.matrix();
                    answer.tangent << 1e9 / axis * hertz->half_length_rate(x[0]), 1e9 / axis * width_rate,
                        load->pressure_rate.matrix();
                    if (answer.status == Status::ok) return answer;
                    answer.keeps_target = load->check(n) == Status::invalid_load;  // the load itself stays invalid
                    answer.values.setConstant(nan);
                    answer.tangent.setConstant(nan);
                    return answer;
                },
            .refusals = {{0, {-1, -1e-300, nan, infinite, -infinite, beyond * N}, Status::invalid_load}}};
}

/// Of a line, whose mesh follows the load, or lies on the largest contact.
inline ForceElement hertz_load(bool breathes) {
    using namespace hertz_detail;
    const HertzLine line({.load_per_width = 1e6, .combined_radius = R, .body_1 = {E, 0.28}, .body_2 = {E, 0.28}});
    const Mesh<double> mesh = cosine_mesh(13);
    return hertz_load_on("Hertz's load on a line",
                         breathes ? HertzLine::Load::breathing(line, mesh)
                                  : HertzLine::Load::fixed(line, mesh, 1.25 * line.half_length()),
                         line.half_length(), 1e6, 0.2, breathes ? 0 : 1.6);
}

/// The same of a patch of 6 x 5 elements.
inline ForceElement hertz_patch_load(bool breathes) {
    using namespace hertz_detail;
    const HertzEllipse largest = ellipse_under(1.5 * N);
    const PatchMesh<double> mesh = patch_mesh(largest.contact(), 6, 5);
    return hertz_load_on("Hertz's load on a patch",
                         breathes ? HertzEllipse::Load::breathing(largest, largest.contact(), mesh)
                                  : HertzEllipse::Load::fixed(largest, largest.contact(), mesh),
                         a, N, 0.8, breathes ? 0 : 1.6);
}

}  // namespace laws
