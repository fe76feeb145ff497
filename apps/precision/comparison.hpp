// The comparisons of precision_study: schemes at several n, by quantities of a line or of patches.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <rollbem/accuracy/recommendation.hpp>
#include <rollbem/status.hpp>

#include "front.hpp"
#include "places.hpp"
#include "support/csv.hpp"
#include "support/named_scheme.hpp"
#include "support/options.hpp"
#include "support/plot.hpp"
#include "support/table.hpp"

namespace precision {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The relative error of the k-th value, signed, if it is real.
inline auto relative(std::size_t k = 0) {
    return [k](const Values& found, const Values& exact) { return found[k].real() / exact[k].real() - 1; };
}

inline Eigen::ArrayXd real(const Values& of) { return Eigen::ArrayXcd::Map(of.data(), std::ssize(of)).real(); }
inline double largest(const Eigen::ArrayXd& errors) { return errors.abs().maxCoeff<Eigen::PropagateNaN>(); }

inline double largest_difference(const Values& found, const Values& exact) {
    return largest(real(found) - real(exact));
}

/// The values that were computed, at one place of a quantity after the other; not numbers unless the status is ok.
struct Found {
    Values values{}, exact{};  ///< and their exact values, if these differ from the reference
    rollbem::Status status = rollbem::Status::ok;

    /// Appends the values at further places.
    void add(const Found& further) {
        values.insert(values.end(), further.values.begin(), further.values.end());
        exact.insert(exact.end(), further.exact.begin(), further.exact.end());
        if (status == rollbem::Status::ok) status = further.status;
    }
};

/// The values extrapolated with the values on a coarser mesh.
inline Found extrapolate(const Found& coarse, Found fine, double order) {
    for (std::size_t k = 0; k < fine.values.size(); ++k) {
        fine.values[k] = rollbem::richardson(coarse.values[k], fine.values[k], order);
    }
    if (fine.status == rollbem::Status::ok) fine.status = coarse.status;
    return fine;
}

/// One scheme at one n (elements, on the finer mesh where two are extrapolated; Chebyshev states; order of the
/// polynomial; none for the closed form) and the quantities it is measured for.
struct Task {
    Point point;  ///< what the rows of all quantities have in common
    std::vector<Quantity> quantities{};
    std::map<Problem, double> time_us{};   ///< of one run, the mean over the places
    std::map<std::string, Found> found{};  ///< of each quantity whose time was measured
    /// Everything from the mesh to the result, anew for each run.
    std::function<Found(const Quantity&)> compute{};
    /// Exact values that take the place of the reference, found without being timed; empty if none do.
    std::function<Values(const Quantity&)> exact = [](const Quantity&) { return Values{}; };
    /// The reason why there is no error.
    std::function<rollbem::Status(const Found&)> status{};
    /// Whether no mode grows, as computed; empty if that is unknown.
    std::function<std::optional<bool>()> stable{};
};

/// The tasks of a comparison, or its points where they are read, and the reference of its quantities.
struct Comparison {
    std::vector<std::string> columns;
    std::vector<Quantity> quantities;
    std::vector<Task> tasks{};
    std::function<Values(const Quantity&)> reference{};
    std::function<std::optional<double>(const Quantity&)> model_error{};
    bool timed = false;
    bool partial = false;         ///< a shard, or without times: there is no front
    std::vector<Point> points{};  ///< all that are known
};

/// All quantities of a line, in the order of the rows, and of patches, each with the places that the options leave.
std::vector<Quantity> line_quantities(const study::Options& options);
std::vector<Quantity> patch_quantities(const study::Options& options);

/// The defaults of --scheme, of a line and of patches.
inline constexpr const char* line_schemes =
    "uniform:collocation:0.5/0.5,uniform:collocation:0/0.63,geometric-1.89:collocation:0.5/0.5,"
    "knothe-0.37:collocation:0.5/0.5,cosine:collocation:0.5/0.5,uniform:galerkin:0/0.63,uniform:galerkin:0/0.75:q7,"
    "cosine:galerkin:0.5/0.5,cosine:galerkin:0.5/0.5:q7,richardson:uniform:collocation:0.5/0.5,"
    "richardson:cosine:collocation:0.5/0.5,uniform:nodes,cosine:nodes,cosine:nodes-chebyshev,richardson:cosine:nodes,"
    "chebyshev,polynomial,closed-form";
inline constexpr const char* patch_schemes =
    "cosine:nodes-chebyshev:cosine-strips,richardson:cosine:nodes-chebyshev:cosine-strips,"
    "cosine:nodes-chebyshev:uniform-strips";

// --- the options, read at the door. The readers throw BadInput.

/// The schemes of --scheme, and the quantities of `all` that --quantity names.
std::vector<study::NamedScheme> read_schemes(const study::Options& options, bool of_patch);
std::vector<Quantity> read_quantities(const study::Options& options, const std::vector<Quantity>& all);

Comparison read_line_comparison(const study::Options& options);
Comparison read_patch_comparison(const study::Options& options);

inline constexpr std::ptrdiff_t largest_n = 100000;
/// The columns of a point's setting, of a line and of patches, and those of all rows.
const std::vector<std::string>& settings(bool of_patch = false);
std::vector<std::string> columns(bool of_patch = false);
study::Row row(const Point& point);

/// The rows of this program's earlier output for the chosen quantities. Throws BadInput if they are malformed, are
/// judged at other places, or do not have one kernel, aspect and poisson.
std::vector<Point> read_points(const study::Options& options, const std::vector<Quantity>& quantities);

/// The fastest scheme for every quantity and tolerance. Throws WriteError.
void write_cheapest(study::OutputFile& file, const std::vector<Point>& points, const std::vector<Quantity>& quantities);

/// A tolerance for which command lines are recommended, of patches with this a/b.
struct Recommendation {
    double tolerance, a_over_b;
};
Recommendation read_recommendation(const study::Options& options);

/// The recommended command line for each purpose, for the plane kernel or a strip with b/a >= 10.
void print_recommendations(const Recommendation& wanted);

/// Panels for up to three quantities; where there are more, c11, response and friction alone have panels. Each panel
/// shows the error of every scheme over its time, and the front of `points`.
study::Picture pictures(const std::vector<Quantity>& quantities, const std::vector<Point>& points);

}  // namespace precision
