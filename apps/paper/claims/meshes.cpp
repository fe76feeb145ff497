// Section 5.3, mesh topologies in steady rolling: Figs. 14 to 17, and the conclusions on steady rolling.
#include <algorithm>

#include "lists.hpp"

namespace paper {

namespace {

constexpr Case on(Topology mesh, double alpha_L, double alpha_T) {
    return {.alpha_L = alpha_L, .alpha_T = alpha_T, .mesh = mesh};
}

/// The grading at which each of the three curves of a panel is nearest to 1.
Judge best_grading(const std::string& panel, double claimed, const Case& scheme, Range search) {
    return [=](const Results& r) {
        return optimum({r.curve(panel, 0), r.curve(panel, 1), r.curve(panel, 2)}, fine, claimed, scheme, Vary::grading,
                       search);
    };
}

double influence(const Results& r, const std::string& panel) {
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, spread(r.curve(panel, k)));
    return largest;
}

std::vector<Claim> gradings() {
    const Case geometric = on(Topology::geometric, 0, 0.63), geometric_equal = on(Topology::geometric, 0.5, 0.5);
    const Case knothe = on(Topology::knothe, 0, 0.63), knothe_equal = on(Topology::knothe, 0.5, 0.5);
    const Case modified = on(Topology::modified_knothe, 0, 0.63);
    const Case modified_equal = on(Topology::modified_knothe, 0.5, 0.5);
    return {
        {"14A", "the best results for a uniform mesh", "Geometric mesh, 0/0.63: best with dx_T/dx_L = 1", true, "",
         best_grading("14a", 1, geometric, {0.5, 2})},
        {"14B", "leading element size to the trailing element size, of 0.5",
         "Geometric mesh, 0.5/0.5: best with dx_T/dx_L = 2", true, "dx_T/dx_L is the inverse of the ratio in words",
         best_grading("14b", 2, geometric_equal, {1, 4})},
        {"14", "almost independent of the mesh density", "The best size ratio hardly depends on n (0.5/0.5)", true,
         "hardly: within 10 % from n = 40 to 80",
         [geometric_equal](const Results&) -> Finding {
             std::vector<double> found;
             const std::string text = for_each_n(fine, [&](std::size_t k) {
                 Case c = geometric_equal;
                 c.n = fine[k];
                 found.push_back(true_optimum(ratio_over(c, Vary::grading), 1, 4));
                 return number(found.back(), 4);
             });
             const auto [low, high] = std::minmax_element(found.begin(), found.end());
             return {*high / *low < 1.1, "true optimum " + text};
         }},
        {"15A", "epsilon = 1 (uniform element size)", "Knothe and Gross-Thebing's mesh, 0/0.63: best with epsilon = 1",
         true, "", best_grading("15a", 1, knothe, {0.1, 1.5})},
        {"15B", "when epsilon = 0.4", "Knothe and Gross-Thebing's mesh, 0.5/0.5: best with epsilon = 0.4", true, "",
         best_grading("15b", 0.4, knothe_equal, {0.1, 1})},
        {"15", "nevertheless small in both plots", "The influence of epsilon is small", true, "small: below 1 % of c11",
         [](const Results& r) -> Finding {
             const double first = influence(r, "15a"), second = influence(r, "15b");
             return {std::max(first, second) < 0.01, "c11*/c11 varies by " + percent(first) + " (0/0.63) and " +
                                                         percent(second) + " (0.5/0.5) at most"};
         }},
        {"16A", "an optimum when epsilon is close to 1", "Modified Knothe mesh, 0/0.63: best with epsilon close to 1",
         true, "", best_grading("16a", 1, modified, {0.1, 1.5})},
        {"16B", "does not present any result without error",
         "Modified Knothe mesh, 0.5/0.5: the error has no zero over epsilon", true, "",
         [](const Results& r) -> Finding {
             std::size_t found = 0;
             for (std::size_t k = 0; k < 3; ++k) found += crossings(r.curve("16b", k)).size();
             return {found == 0,
                     std::to_string(found) + " zeros of the error; least error " +
                         for_each_n(fine, [&](std::size_t k) { return percent(least_error(r.curve("16b", k))); })};
         }},
        {"16B", "best results are obtained for epsilon = 1", "Modified Knothe mesh, 0.5/0.5: best with epsilon = 1",
         true, "within epsilon <= 1", best_grading("16b", 1, modified_equal, {0.1, 1})},
        {"16B", "but its influence is small", "The influence of epsilon is small, 0.5/0.5", true,
         "small: below 1 % of c11",
         below(
             0.01, [](const Results& r) { return influence(r, "16b"); },
             [](double largest) { return "c11*/c11 varies by " + percent(largest) + " at most"; })},
    };
}

/// The cases of Fig. 17.
Case traction_case(Topology mesh) { return {.alpha_L = 0.5, .alpha_T = 0.5, .mesh = mesh, .grading = 0.4}; }

/// Relative difference of the leading element's traction from Carter's at its centre.
double leading_excess(const Case& c) {
    const Tractions t = tractions(c);
    return t.value[c.n - 1] / t.carter[c.n - 1] - 1;
}

/// |p - Carter| at the centre of the leading element.
double leading_error(const Case& c) {
    const Tractions t = tractions(c);
    return std::abs(t.value[c.n - 1] - t.carter[c.n - 1]);
}

/// Whether Knothe and Gross-Thebing's mesh, whose leading element lies nearest to the edge, has a larger error there
/// than the uniform one and overestimates Carter, as the paper says of the same curves.
Finding farthest_is_best(const Results&) {
    bool holds = false;
    for (const auto& [alpha_L, alpha_T] : {std::pair{0.5, 0.5}, {0.0, 0.63}}) {
        const double uniform = leading_error(on(Topology::uniform, alpha_L, alpha_T));
        for (const double epsilon : fractions(1, 9, 10)) {
            Case knothe = on(Topology::knothe, alpha_L, alpha_T);
            knothe.grading = epsilon;
            holds = holds || (leading_error(knothe) > uniform && leading_excess(knothe) > 0);
        }
    }
    const Case knothe{.mesh = Topology::knothe, .grading = 0.4};
    return {holds, "|p - Carter|/(G xi) on the leading element: uniform " +
                       number(leading_error(traction_case(Topology::uniform))) + ", Knothe " +
                       number(leading_error(traction_case(Topology::knothe))) + "; with 0/0.63 " +
                       number(leading_error({})) + " and " + number(leading_error(knothe)) +
                       ", but there Knothe underestimates by " + percent(-leading_excess(knothe))};
}

std::vector<Claim> tractions_on_meshes() {
    return {
        {"17", "very coincident with Carter", "Away from the edges the three meshes give Carter's traction", true,
         "away: |x| < 0.8 a; coincide: within 1 % of the largest traction, as in Fig. 10",
         [](const Results&) -> Finding {
             double largest = 0;
             for (const Topology mesh : {Topology::uniform, Topology::knothe, Topology::modified_knothe}) {
                 largest = std::max(largest, visible_difference(tractions(traction_case(mesh)), -0.8, 0.8));
             }
             return {largest < 0.01, "at most " + percent(largest) + " of the largest traction"};
         }},
        {"17A", "provide very similar traction distributions",
         "At the trailing edge Knothe and Gross-Thebing's and the modified mesh agree", true,
         "agree: within 2 %, trailing five elements",
         [](const Results&) -> Finding {
             const Tractions first = tractions(traction_case(Topology::knothe));
             const Tractions second = tractions(traction_case(Topology::modified_knothe));
             const double largest = (first.value.head(5) / second.value.head(5) - 1).abs().maxCoeff();
             return {largest < 0.02, "within " + percent(largest)};
         }},
        {"17A", "overestimate the tractions calculated by Carter", "There both lie above Carter", true,
         "at the centre of the trailing element, whose mean of Carter's traction is larger than his value there",
         [](const Results&) -> Finding {
             const Tractions first = tractions(traction_case(Topology::knothe));
             const Tractions second = tractions(traction_case(Topology::modified_knothe));
             const double own = first.value[0] / first.carter[0] - 1, other = second.value[0] / second.carter[0] - 1;
             return {own > 0 && other > 0, percent(own) + " and " + percent(other) + " (against his mean: " +
                                               percent(first.value[0] / first.carter_mean[0] - 1) + " and " +
                                               percent(second.value[0] / second.carter_mean[0] - 1) + ")"};
         }},
        {"17A", "most closely matches the Carter traction", "At the trailing edge the uniform mesh errs least", true,
         "",
         [](const Results&) -> Finding {
             const auto error = [](Topology mesh) {
                 const Tractions t = tractions(traction_case(mesh));
                 return std::abs(t.value[0] - t.carter[0]);
             };
             const double uniform = error(Topology::uniform), both = error(Topology::knothe);
             const double trailing = error(Topology::modified_knothe);
             return {uniform < both && uniform < trailing, "|p - Carter|/(G xi) on the trailing element: uniform " +
                                                               number(uniform) + ", Knothe " + number(both) +
                                                               ", modified " + number(trailing)};
         }},
        {"17B", "although slightly higher",
         "At the leading edge the modified and the uniform mesh agree, slightly above Carter", true,
         "agree: within 2 %; slightly: on the leading element, by less than 5 % of the mean traction",
         [](const Results&) -> Finding {
             const double uniform = leading_excess(traction_case(Topology::uniform));
             const double modified = leading_excess(traction_case(Topology::modified_knothe));
             const Tractions t = tractions(traction_case(Topology::uniform));
             const double share = std::abs(t.value[39] - t.carter[39]) / t.value.abs().mean();
             return {uniform > 0 && modified > 0 && std::abs(uniform - modified) < 0.02 && share < 0.05,
                     "above Carter by " + percent(uniform) + " (uniform) and " + percent(modified) + " (modified), " +
                         percent(share) + " of the mean traction"};
         }},
        {"17B", "once again overestimates Carter", "So does Knothe and Gross-Thebing's mesh", true, "",
         [](const Results&) -> Finding {
             const double own = leading_excess(traction_case(Topology::knothe));
             return {own > 0, "above Carter by " + percent(own)};
         }},
        {"17B", "in the points furthest from the edge",
         "At the leading edge, too, the mesh whose elements lie farthest from it errs least", false,
         "the paper does not give alphas and epsilon; for neither 0.5/0.5 nor 0/0.63, with no epsilon of 0.1 ... 0.9, "
         "does Knothe and Gross-Thebing's mesh both overestimate Carter and err more than the uniform one",
         farthest_is_best},
    };
}

std::vector<Claim> conclusions() {
    return {
        {"Sec. 7", "can provide even better results", "Another mesh with other alphas beats the uniform 0/0.63", true,
         "n = 40, all meshes and alphas of the grids",
         [](const Results&) -> Finding {
             Case found;
             double least = std::abs(c11_ratio(found) - 1);
             const double uniform = least;
             const auto visit = [&](Topology mesh, const std::vector<double>& gradings) {
                 for (const double grading : gradings) {
                     for (const double alpha : paper_alphas()) {
                         for (const Vary vary : {Vary::both_alphas, Vary::alpha_T}) {
                             const Case c = at({"", {.mesh = mesh, .grading = grading}, vary}, alpha);
                             const double error = std::abs(c11_ratio(c) - 1);
                             if (!(error < least)) continue;
                             least = error;
                             found = c;
                         }
                     }
                 }
             };
             visit(Topology::geometric, {0.125, 0.25, 0.5, 2, 4, 8});
             visit(Topology::knothe, fractions(1, 9, 10));
             visit(Topology::modified_knothe, fractions(1, 9, 10));
             return {least < uniform, percent(least) + " (" + rollbem::name(found.mesh) + " " + number(found.grading) +
                                          ", alpha " + number(found.alpha_L) + "/" + number(found.alpha_T) +
                                          ") against " + percent(uniform) + " (uniform 0/0.63)"};
         }},
        {"Sec. 7", "in general, more robust", "Finite differences are more robust than the analytic derivative", true,
         "judged by the largest jump of c11*/c11 from one alpha to the next (0.005) in [0.3, 0.7], alpha_L = alpha_T",
         [](const Results& r) -> Finding {
             const auto jump = [](const Points& points) {
                 double result = 0;
                 for (std::size_t i = 1; i < points.size(); ++i) {
                     result = std::max(result, std::abs(points[i].second - points[i - 1].second));
                 }
                 return result;
             };
             const double fd = jump(within(r.curve("05a", 0), 0.3, 0.7));
             const double closed = jump(within(r.curve("07a", 0), 0.3, 0.7));
             int better = 0, all = 0;
             for (const double alpha : fractions(1, 20, 20)) {
                 const double own = error_at(r.curve("05a", 0), alpha), other = error_at(r.curve("07a", 0), alpha);
                 ++all;
                 if (std::abs(own) < std::abs(other)) ++better;
             }
             return {fd < closed, percent(fd) + " against " + percent(closed) + "; more accurate at " +
                                      std::to_string(better) + " of " + std::to_string(all) +
                                      " equal alphas of the grid"};
         }},
    };
}

}  // namespace

std::vector<Claim> claims_of_meshes() { return all_of({gradings, tractions_on_meshes, conclusions}); }

}  // namespace paper
