#include "patches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <rollbem/accuracy/richardson.hpp>
#include <rollbem/adhesion/patch_stability.hpp>
#include <rollbem/compiled/patch.hpp>
#include <rollbem/compiled/stability.hpp>

#include "support/csv.hpp"
#include "support/errors.hpp"
#include "support/timing.hpp"
#include "tables.hpp"

namespace precision {

namespace {

constexpr rollbem::NodeDifference scheme{rollbem::Nodes::chebyshev};
constexpr long reference_n = 48;                                   // and half of it
constexpr std::ptrdiff_t most_elements = 4096, most_judged = 256;  // eigenvalues cost much more than the coefficients
const std::string direct = "nodes-chebyshev", extrapolated = "richardson-nodes";

using Contact = rollbem::PatchContact<double>;

struct Coefficients {
    std::array<double, 4> values;
    rollbem::Status status;
};

Coefficients solve(const Contact& contact, long n, long strips) {
    const auto steady = rollbem::solve_steady(contact, rollbem::patch_mesh(contact, n, strips), scheme);
    return {{steady.c11, steady.c22, steady.c23, steady.c33}, steady.status};
}

/// Of n and strips, and half as many of both.
Coefficients extrapolate(const Contact& contact, long n, long strips) {
    const Coefficients coarse = solve(contact, n / 2, strips / 2);
    Coefficients fine = solve(contact, n, strips);
    for (std::size_t k = 0; k < fine.values.size(); ++k) {
        fine.values[k] = rollbem::richardson(coarse.values[k], fine.values[k], 2.0);
    }
    if (fine.status == rollbem::Status::ok) fine.status = coarse.status;
    return fine;
}

/// Empty if the eigenvalues were not found or are too many.
std::optional<bool> stable(const Contact& contact, long n, long strips) {
    if (n * strips > most_judged) return std::nullopt;
    const rollbem::StabilityVerdict verdict = rollbem::judge_stability(rollbem::patch_parts(
        rollbem::patch_mesh(contact, n, strips), scheme, rollbem::HalfSpace<double>(contact.poisson_ratio())));
    if (verdict.status != rollbem::Status::ok) return std::nullopt;
    return verdict.unstable_count == 0;
}

}  // namespace

const std::vector<std::string>& patch_quantity_names() {
    static const std::vector<std::string> names{"patch_c11", "patch_c22", "patch_c23", "patch_c33"};
    return names;
}

std::vector<Quantity> chosen_patch_quantities(const study::Options& options) {
    std::vector<Quantity> chosen;
    if (options.text("quantity").find("patch_") == std::string::npos) return chosen;
    const std::vector<std::string> asked = options.choices("quantity", patch_quantity_names());
    for (const std::string& name : patch_quantity_names()) {
        if (std::count(asked.begin(), asked.end(), name) > 0) chosen.push_back({name, Problem::steady});
    }
    return chosen;
}

std::vector<std::string> patch_columns() {
    std::vector<std::string> names = columns();
    names.insert(names.end(), {"a_over_b", "strips"});
    return names;
}

PatchComputation::PatchComputation(const study::Options& options, const std::vector<Quantity>& quantities)
    : contact_(Contact::dimensionless(options.number("a-over-b", study::between(1e-3, 1e3)),
                                      options.number("poisson", study::between(0, 0.5)))),
      quantities_(quantities),
      with_times_(study::has_times(options)),
      partial_(options.given("shard") || !with_times_),
      by_strips_(options.given("strips")) {
    for (const char* name : {"kernel", "aspect", "size-ratio", "epsilon", "front"}) {
        options.ignored(name, "with quantities of patches");
    }
    std::vector<std::ptrdiff_t> sizes{4, 6, 8, 12, 16, 24};
    if (options.given("n")) sizes = options.integers("n", 1, most_elements);
    std::vector<std::ptrdiff_t> strips;
    if (by_strips_) strips = options.integers("strips", 1, most_elements);
    const std::vector<std::string> schemes = options.choices("schemes", {direct, extrapolated});
    for (const std::ptrdiff_t n : sizes) {
        for (const std::ptrdiff_t m : by_strips_ ? strips : std::vector{n}) {
            if (n * m > most_elements) {
                throw study::BadInput("--n = " + std::to_string(n) + " times " + std::to_string(m) +
                                      " strips must be at most " + std::to_string(most_elements));
            }
            for (const std::string& name : schemes) {
                if (name == direct || (n % 2 == 0 && m % 2 == 0)) tasks_.push_back({name, n, m});
            }
        }
    }
    if (tasks_.empty()) throw study::BadInput(options.said("n") + " and the strips must be even to extrapolate");
    const Coefficients reference = extrapolate(contact_, reference_n, reference_n);
    reference_.assign(reference.values.begin(), reference.values.end());
}

std::vector<std::size_t> PatchComputation::rows_of_task() const {
    return std::vector<std::size_t>(tasks_.size(), quantities_.size());
}

std::vector<Point> PatchComputation::points_of(const Task& task) const {
    const bool twice = task.scheme == extrapolated;
    const auto compute = [&] { return (twice ? extrapolate : solve)(contact_, task.n, task.strips); };
    const Coefficients found = compute();
    std::optional<double> time;
    if (with_times_) time = study::median_time_us([&] { return compute().values[0]; });
    std::optional<bool> decays = stable(contact_, task.n, task.strips);
    if (twice && decays && *decays) decays = stable(contact_, task.n / 2, task.strips / 2);
    std::vector<Point> points;
    for (const Quantity& quantity : quantities_) {
        const auto& names = patch_quantity_names();
        const auto k = std::size_t(std::find(names.begin(), names.end(), quantity.name) - names.begin());
        Point point{.scheme = task.scheme,
                    .n = task.n,
                    .quantity = quantity.name,
                    .relative_error = std::nullopt,
                    .time_us = time,
                    .stable = decays};
        if (found.status == rollbem::Status::ok) {
            point.relative_error = found.values[k] / reference_[k] - 1;
        } else {
            point.status = name(found.status);
        }
        point.setting = {"half-space",
                         "",
                         study::Cell(contact_.poisson_ratio()).text(),
                         "",
                         "",
                         study::Cell(contact_.a_over_b()).text(),
                         std::to_string(task.strips)};
        points.push_back(std::move(point));
    }
    return points;
}

void PatchComputation::prepare(const std::vector<std::size_t>&, const std::function<void(double part)>& done) {
    if (partial_) return;
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
        for (Point& point : points_of(tasks_[i])) points_.push_back(std::move(point));
        done(static_cast<double>(i + 1) / static_cast<double>(tasks_.size()));
    }
    // a series in n for each number of strips, unless there are as many as elements
    std::vector<Point> series = points_;
    if (by_strips_) {
        for (Point& point : series) point.scheme += " " + point.setting.back();
    }
    mark_front(series);
    for (std::size_t i = 0; i < points_.size(); ++i) points_[i].on_front = series[i].on_front;
}

void PatchComputation::emit_rows(std::size_t task, study::RowRange range, const study::Emit& emit) const {
    const std::vector<Point> own = partial_ ? points_of(tasks_[task]) : std::vector<Point>{};
    for (std::size_t k = range.first; k < range.last; ++k) {
        emit(row(partial_ ? own[k] : points_[task * quantities_.size() + k]));
    }
}

}  // namespace precision
