// Bodies of normal/profile_check.hpp. Internal.
#pragma once

#include "../profile_check.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include <Eigen/Core>

#include "../../detail/require.hpp"
#include "../detail/profile_direction.hpp"

namespace rollbem::detail {

/// The fault of a profile as a wheel, with its quantity and value; "" if there is none. `tape` is y of the tape circle,
/// 70 mm from the flange's back.
inline std::string fault_of_wheel(const Eigen::ArrayXd& y, const Eigen::ArrayXd& z, double tape) {
    const auto text = [](const char* quantity, double value, const char* rule) {
        return std::string(quantity) + " = " + to_text(std::round(1e6 * value) / 1e6) + " m must " + rule;
    };
    const double width = y.maxCoeff() - y.minCoeff();
    if (width < 0.09 || width > 0.18) return text("width of the wheel", width, "lie in 0.09 to 0.18 m");
    if (flange_points_up(y, z)) return text("z of the flange", z.minCoeff(), "be positive");
    Eigen::Index crown = 0;
    z.maxCoeff(&crown);
    if (z[crown] < 10e-3) return text("z of the flange's crown (largest z)", z[crown], "be at least 0.01 m");
    if (y[crown] < tape - 65e-3 || y[crown] > tape - 25e-3) {
        return text("y of the flange's crown (largest z)", y[crown],
                    ("lie in " + to_text(tape - 65e-3) + " to " + to_text(tape - 25e-3) + " m").c_str());
    }
    // the height where the curve passes the tape circle, nearest to z = 0
    std::optional<double> height;
    for (Eigen::Index i = 1; i < y.size(); ++i) {
        const double from = y[i - 1] - tape, to = y[i] - tape;
        if (from * to > 0 || from == to) continue;
        const double here = z[i - 1] + (z[i] - z[i - 1]) * from / (from - to);
        if (!height || std::abs(here) < std::abs(*height)) height = here;
    }
    if (!height) return text("y of the tape circle", tape, "lie on the wheel");
    if (std::abs(*height) >= 2e-3) return text("z on the tape circle", *height, "lie within 0.002 m of 0");
    return "";
}

/// The fault of a profile as a rail; "" if there is none.
inline std::string fault_of_rail(const Eigen::ArrayXd& y, const Eigen::ArrayXd& z) {
    const auto text = [](const char* quantity, double value, const char* rule) {
        return std::string(quantity) + " = " + to_text(std::round(1e6 * value) / 1e6) + " m must " + rule;
    };
    const double width = y.maxCoeff() - y.minCoeff();
    if (width < 0.03 || width > 0.2) return text("width of the rail", width, "lie in 0.03 to 0.2 m");
    Eigen::Index top = 0;
    const double least = z.minCoeff(&top);
    if (std::abs(least) > 10e-3) return text("z of the rail's top (least z)", least, "lie within 0.01 m of 0");
    if (top == 0 || top == z.size() - 1 || sides_point_up(y, z)) {
        return text("y of the rail's top (least z)", y[top], "lie between its sides");
    }
    return "";
}

/// The remedy where another unit of length would make a width right, or "".
inline std::string look_of_unit(double width, double least, double most) {
    const auto fits = [&](double factor) { return width * factor >= least && width * factor <= most; };
    if (fits(1000)) return "these look like metres read as millimetres: --length-unit m";
    if (fits(1e-3)) return "these look like millimetres read as metres: --length-unit mm";
    if (fits(25.4)) return "these look like inches read as millimetres: convert the file";
    return "";
}

/// The presumed cause, and the options that correct it.
inline std::string wheel_remedy(bool mirror_y, bool mirror_z, std::optional<double> offset) {
    std::string seems, options;
    const auto add = [&](const char* what, const std::string& option) {
        seems += (seems.empty() ? "" : ", and ") + std::string(what);
        options += ' ' + option;
    };
    if (offset) {
        add(*offset == 0 ? "y seems to begin at the flange's back" : "y seems to begin at the tape circle",
            "--tape-offset " + to_text(*offset));
    }
    if (mirror_z) add("z seems to point up", mirror_y ? "--wheel-mirror yz" : "--wheel-mirror z");
    if (mirror_y) add("this seems to be a left wheel", mirror_z ? "" : "--wheel-mirror y");
    while (options.back() == ' ') options.pop_back();
    return seems + ":" + options;
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL void require_wheel(const Profile& wheel, double tape_offset) {
    if (wheel.is_piece()) return;
    const Eigen::ArrayXd &y = wheel.y(), &z = wheel.z();
    const std::string fault = detail::fault_of_wheel(y, z, 0.07 - tape_offset);
    if (fault.empty()) return;
    std::string remedy = detail::look_of_unit(y.maxCoeff() - y.minCoeff(), 0.09, 0.18);
    for (const double offset : {tape_offset, 0.0, 0.07}) {
        for (const bool mirror_z : {false, true}) {
            for (const bool mirror_y : {false, true}) {
                const double sign_y = mirror_y ? -1 : 1, sign_z = mirror_z ? -1 : 1;
                if (!remedy.empty() || !detail::fault_of_wheel(sign_y * y, sign_z * z, 0.07 - offset).empty()) continue;
                remedy = detail::wheel_remedy(mirror_y, mirror_z,
                                              offset == tape_offset ? std::nullopt : std::optional(offset));
            }
        }
    }
    if (remedy.empty()) remedy = "move or cut its points";
    throw std::invalid_argument("wheel: " + fault + ": " + remedy +
                                ", or --any-shape (Profile::Use::piece) for a piece");
}

ROLLBEM_DECL void require_rail(const Profile& rail) {
    if (rail.is_piece()) return;
    const std::string fault = detail::fault_of_rail(rail.y(), rail.z());
    if (fault.empty()) return;
    std::string remedy = detail::look_of_unit(rail.y().maxCoeff() - rail.y().minCoeff(), 0.03, 0.2);
    if (remedy.empty() && detail::fault_of_rail(rail.y(), -rail.z()).empty()) {
        remedy = "z seems to point up: --rail-mirror z";
    }
    if (remedy.empty()) remedy = "move or cut its points";
    throw std::invalid_argument("rail: " + fault + ": " + remedy +
                                ", or --any-shape (Profile::Use::piece) for a piece");
}

}  // namespace rollbem
