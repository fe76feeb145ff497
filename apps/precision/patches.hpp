// Creep coefficients and forces with friction of contact patches as precision_study compares them: error against time
// over n and strips.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <rollbem/scene/patch_contact.hpp>

#include "front.hpp"
#include "scene.hpp"
#include "support/options.hpp"
#include "support/table.hpp"

namespace precision {

/// patch_c11, patch_c22, patch_c23, patch_c33, patch_force.
const std::vector<std::string>& patch_quantity_names();

const std::vector<std::string>& patch_scheme_names();

struct PatchTask {
    std::string scheme;
    long n, strips;
};

/// Those that --quantity gives, in the order of the rows; none if it gives none. Throws BadInput if there are others.
std::vector<Quantity> chosen_patch_quantities(const study::Options& options);

/// columns(), a_over_b, strips.
std::vector<std::string> patch_columns();

/// All patches, and their rows. References, times, and errors for on_front are found before the first row is written.
class PatchComputation {
public:
    /// Throws BadInput.
    PatchComputation(const study::Options& options, const std::vector<Quantity>& quantities);

    std::vector<std::size_t> rows_of_task() const;
    void prepare(const std::vector<std::size_t>& wanted, const std::function<void(double part)>& done);
    void emit_rows(std::size_t task, study::RowRange range, const study::Emit& emit) const;

    /// All rows; none where on_front is not known.
    const std::vector<Point>& points() const { return points_; }

private:
    std::vector<Point> points_of(const PatchTask& task) const;

    rollbem::PatchContact<double> contact_;
    std::vector<Quantity> quantities_;
    std::set<Problem> problems_;
    std::vector<PatchTask> tasks_;
    bool with_times_, partial_, by_strips_;
    std::map<Problem, std::vector<double>> references_;
    std::vector<Point> points_;
};

}  // namespace precision
