// What the laws of tests/laws know of a force element: whatever answers inputs with values, their derivatives and a
// status. An element joins with its quantities, a way to draw inputs from its domain, and its symmetries.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <rollbem/status.hpp>

#include "extremes/drawn.hpp"
#include "support/catch.hpp"

namespace laws {

using namespace rollbem;
using drawn::Draw;

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();

/// Numbers of inputs or values, without heap.
using Numbers = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 64, 1>;
using Tangent = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 64, 16>;

struct Answer {
    Numbers values;
    Tangent tangent;  ///< of the first values by the first inputs, a column for each input
    Status status = Status::ok;
    std::size_t branch = 0;    ///< answers of two branches do not have one tangent, such as those of other zones
    bool keeps_target = true;  ///< a refused step leaves the state that it should write as it was
};

/// A typical size, which steps and errors are measured by (0: a choice, which is not varied), and the exponents of the
/// units of length, stress and time.
struct Quantity {
    double size;
    int length = 0, stress = 0, time = 0;
};

/// Inputs and the first values change signs together: '-' or '+' for each.
struct Symmetry {
    std::string name, inputs, values;
};

/// The status where one input is `bad`, the others good.
struct Refusal {
    std::size_t input;
    std::vector<double> bad;
    Status status;
};

/// The status after a change of what the next answer starts from, or writes to.
struct Spoilt {
    std::string what;
    std::function<void()> spoil;
    Status status;
};

/// A force at a place, and a moment besides.
struct Wrench {
    Eigen::Vector3d place, force, moment{0, 0, 0};
};

struct ForceElement {
    std::string name;
    std::vector<Quantity> inputs, values;
    std::function<Numbers(Draw&)> draw;  ///< inputs, and the state that the next answers start from
    std::function<Answer(const Numbers&)> answer;
    std::vector<Symmetry> symmetries{};
    std::vector<Refusal> refusals{};
    std::vector<Spoilt> spoilt{};
    std::size_t motions = 0;         ///< the first inputs are creepages, and the first values the forces against them
    std::function<void()> forget{};  ///< gives the element a new workspace
    /// The forces on the rail, part by part, about the point of the moments; the first values are force and moment.
    std::function<std::vector<Wrench>(const Numbers&)> on_rail{};
    std::function<void(const Numbers&)> distract{};  ///< asks for what is not an answer, such as other kinds of motion
};

/// Calls `function` with an answer's inputs in `count` scenes, the name of which a failure prints.
template <class Function>
void for_each_scene(const ForceElement& of, int count, const Function& function) {
    Draw draw(17);
    for (int scene = 0; scene < count; ++scene) {
        const Numbers x = of.draw(draw);
        INFO(of.name << ", scene " << scene << ", inputs " << x.transpose());
        function(x);
    }
}

inline Numbers sizes(const std::vector<Quantity>& of) {
    Numbers result(static_cast<Eigen::Index>(of.size()));
    for (std::size_t i = 0; i < of.size(); ++i) result[static_cast<Eigen::Index>(i)] = of[i].size;
    return result;
}

}  // namespace laws
