// The panels computed: rows for the CSV file and curves for the plot. All numbers come from evaluate.hpp.
#pragma once

#include <complex>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "figures.hpp"
#include "measures.hpp"
#include "support/csv.hpp"
#include "support/plot.hpp"

namespace paper {

inline constexpr Eigen::Index polynomial_order = 20;  ///< of the reference in Fig. 22

struct CurveResult {
    std::vector<study::Row> rows;
    std::vector<study::Series> series;  ///< what is drawn; claims use the points of the first
};

struct PanelResult {
    Panel panel;
    std::vector<CurveResult> curves;
};

/// All panels, and access to their curves for the claims.
class Results {
public:
    explicit Results(const std::vector<Panel>& panels) {
        for (const Panel& panel : panels) panels_.push_back({panel, std::vector<CurveResult>(panel.curves.size())});
    }

    std::vector<PanelResult>& panels() { return panels_; }
    const std::vector<PanelResult>& panels() const { return panels_; }

    /// Points of curve `index`, counted from 0, of a panel such as "05a".
    const Points& curve(const std::string& figure, std::size_t index) const {
        for (const PanelResult& result : panels_) {
            if (result.panel.figure == figure) return result.curves.at(index).series.at(0).points;
        }
        throw std::logic_error("no panel " + figure);
    }

private:
    std::vector<PanelResult> panels_;
};

/// Labels are ASCII in the CSV files; where they are shown they get Greek letters.
std::string with_greek(std::string text);

/// The polynomial approach with the factor of d(x/a)^l/dx, which Eqs. (24) to (26) lack; z = omega a/V.
std::complex<double> polynomial_c11(double z, Eigen::Index order = polynomial_order);

/// The columns of a panel's CSV file.
std::vector<std::string> columns(Quantity quantity);

CurveResult compute(const Panel& panel, const Curve& curve);

study::Plot plot(const PanelResult& result);

}  // namespace paper
