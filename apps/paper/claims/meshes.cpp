// Section 5.3, mesh topologies in steady rolling: Figs. 14 to 17, and the conclusions on steady rolling.
#include <algorithm>

#include "paper/claims.hpp"

namespace paper {

namespace {

const std::string leading_fixed = ":collocation:0/0.63", equal = ":collocation:0.5/0.5";  // on a mesh

/// Largest range of c11*/c11 over the grading in the curves of a panel.
double influence(const Results& r, const std::string& panel) {
    double largest = 0;
    for (const Points& curve : curves_of(r, panel)) largest = std::max(largest, spread(curve));
    return largest;
}

}  // namespace

Claims gradings(const Results& r) {
    // the grading at which each of the three curves of a panel is nearest to 1
    const auto best_grading = [&](const std::string& panel, double claimed, const std::string& scheme, Range search) {
        return optimum(curves_of(r, panel), fine, claimed, scheme, Vary::grading, search);
    };
    const std::string geometric = "geometric-1", knothe = "knothe-1", modified_knothe = "modified-knothe-1";
    double low = 4, high = 1;
    const std::string ratios = for_each_n(fine, [&](std::size_t k) {
        const double found = optimum_of(geometric + equal, fine[k], Vary::grading, {1, 4});
        low = std::min(low, found);
        high = std::max(high, found);
        return number(found, 4);
    });
    const double first = influence(r, "15a"), second = influence(r, "15b");
    std::size_t zeros = 0;
    for (const Points& curve : curves_of(r, "16b")) zeros += crossings(curve).size();
    return {
        {"14A", "the best results for a uniform mesh", "Geometric mesh, 0/0.63: best with dx_T/dx_L = 1", "",
         best_grading("14a", 1, geometric + leading_fixed, {0.5, 2})},
        {"14B", "leading element size to the trailing element size, of 0.5",
         "Geometric mesh, 0.5/0.5: best with dx_T/dx_L = 2", "dx_T/dx_L is the inverse of the ratio in words",
         best_grading("14b", 2, geometric + equal, {1, 4})},
        {"14", "almost independent of the mesh density", "The best size ratio hardly depends on n (0.5/0.5)",
         "hardly: within 10 % from n = 40 to 80", judged(high / low < 1.1, "true optimum {}", ratios)},
        {"15A", "epsilon = 1 (uniform element size)", "Knothe and Gross-Thebing's mesh, 0/0.63: best with epsilon = 1",
         "", best_grading("15a", 1, knothe + leading_fixed, {0.1, 1.5})},
        {"15B", "when epsilon = 0.4", "Knothe and Gross-Thebing's mesh, 0.5/0.5: best with epsilon = 0.4", "",
         best_grading("15b", 0.4, knothe + equal, {0.1, 1})},
        {"15", "nevertheless small in both plots", "The influence of epsilon is small", "small: below 1 % of c11",
         judged(std::max(first, second) < 0.01, "c11*/c11 varies by {%} (0/0.63) and {%} (0.5/0.5) at most", first,
                second)},
        {"16A", "an optimum when epsilon is close to 1", "Modified Knothe mesh, 0/0.63: best with epsilon close to 1",
         "", best_grading("16a", 1, modified_knothe + leading_fixed, {0.1, 1.5})},
        {"16A", "alpha_L = 0.63 and alpha_T = 0", "The scheme of the caption is optimal at epsilon = 1",
         "the indices are swapped: the text says alpha_L = 0",
         errs_least_at(1, fractions(1, 10, 10),
                       [](Eigen::Index n, double x) {
                           return ratio_at({"modified-knothe-1:collocation:0.63/0", n}, Vary::grading, x);
                       }),
         false},
        {"16B", "does not present any result without error",
         "Modified Knothe mesh, 0.5/0.5: the error has no zero over epsilon", "",
         judged(zeros == 0, "{} zeros of the error; least error {}", zeros,
                for_each_n(fine, [&](std::size_t k) { return percent(least_error(r.curve("16b", k))); }))},
        {"16B", "best results are obtained for epsilon = 1", "Modified Knothe mesh, 0.5/0.5: best with epsilon = 1",
         "within epsilon <= 1", best_grading("16b", 1, modified_knothe + equal, {0.1, 1})},
        {"16B", "but its influence is small", "The influence of epsilon is small, 0.5/0.5", "small: below 1 % of c11",
         below(0.01, influence(r, "16b"), "c11*/c11 varies by {%} at most")},
    };
}

namespace {

/// p/Carter - 1 and |p - Carter| at the centre of an element.
double excess(const Tractions& t, Eigen::Index i) { return t.value[i] / t.carter[i] - 1; }
double error(const Tractions& t, Eigen::Index i) { return std::abs(t.value[i] - t.carter[i]); }

constexpr Eigen::Index trailing_element = 0, leading_element = 39;

/// Whether Knothe and Gross-Thebing's mesh, whose leading element lies nearest to the edge, has a larger error there
/// than the uniform one and overestimates Carter, as the paper says of the same curves.
bool farthest_is_best() {
    for (const std::string& alphas : {equal, leading_fixed}) {
        const double uniform = error(tractions("uniform" + alphas), leading_element);
        for (const double epsilon : fractions(1, 9, 10)) {
            const Tractions knothe = tractions(at("knothe-1" + alphas, Vary::grading, epsilon));
            if (error(knothe, leading_element) > uniform && excess(knothe, leading_element) > 0) return true;
        }
    }
    return false;
}

}  // namespace

Claims tractions_on_meshes(const Results&) {
    // the cases of Fig. 17
    const Tractions uniform = tractions("uniform" + equal), knothe = tractions("knothe-0.4" + equal);
    const Tractions modified = tractions("modified-knothe-0.4" + equal);
    double visible = 0, local = 0;
    for (const Tractions* each : {&uniform, &knothe, &modified}) {
        const Difference difference = from_carter(*each, -0.8, 0.8);
        visible = std::max(visible, difference.visible);
        local = std::max(local, difference.local);
    }
    const double apart = (knothe.value.head(5) / modified.value.head(5) - 1).abs().maxCoeff();
    const auto against_mean = [](const Tractions& t) {
        return t.value[trailing_element] / t.carter_mean[trailing_element] - 1;
    };
    const double share = error(uniform, leading_element) / uniform.value.abs().mean();
    const double ahead = excess(uniform, leading_element), modified_ahead = excess(modified, leading_element);
    const Tractions best_uniform = tractions({}), best_knothe = tractions("knothe-0.4" + leading_fixed);
    return {
        {"17", "very coincident with Carter", "Away from the edges the three meshes give Carter's traction",
         "away: |x| < 0.8 a; coincide: as in Fig. 10, within 1 % of the largest traction and 5 % of the local one",
         judged(visible < 0.01 && local < 0.05, "at most {%} of the largest traction, {%} of the local one", visible,
                local)},
        {"17A", "provide very similar traction distributions",
         "At the trailing edge Knothe and Gross-Thebing's and the modified mesh agree",
         "agree: within 2 %, trailing five elements", below(0.02, apart, "within {%}")},
        {"17A", "overestimate the tractions calculated by Carter", "There both lie above Carter",
         "at the centre of the trailing element, whose mean of Carter's traction is larger than his value there",
         judged(excess(knothe, trailing_element) > 0 && excess(modified, trailing_element) > 0,
                "{%} and {%} (against his mean: {%} and {%})", excess(knothe, trailing_element),
                excess(modified, trailing_element), against_mean(knothe), against_mean(modified))},
        {"17A", "most closely matches the Carter traction", "At the trailing edge the uniform mesh errs least", "",
         judged(error(uniform, trailing_element) <
                    std::min(error(knothe, trailing_element), error(modified, trailing_element)),
                "|p - Carter|/(G xi) on the trailing element: uniform {}, Knothe {}, modified {}",
                error(uniform, trailing_element), error(knothe, trailing_element), error(modified, trailing_element))},
        {"17B", "although slightly higher",
         "At the leading edge the modified and the uniform mesh agree, slightly above Carter",
         "agree: within 2 %; slightly: on the leading element, by less than 5 % of the mean traction",
         judged(std::min(ahead, modified_ahead) > 0 && std::abs(ahead - modified_ahead) < 0.02 && share < 0.05,
                "above Carter by {%} (uniform) and {%} (modified), {%} of the mean traction", ahead, modified_ahead,
                share)},
        {"17B", "once again overestimates Carter", "So does Knothe and Gross-Thebing's mesh", "",
         judged(excess(knothe, leading_element) > 0, "above Carter by {%}", excess(knothe, leading_element))},
        {"17B", "in the points furthest from the edge",
         "At the leading edge, too, the mesh whose elements lie farthest from it errs least",
         "the paper does not give alphas and epsilon; for neither 0.5/0.5 nor 0/0.63, with no epsilon of 0.1 ... 0.9, "
         "does Knothe and Gross-Thebing's mesh both overestimate Carter and err more than the uniform one",
         judged(farthest_is_best(),
                "|p - Carter|/(G xi) on the leading element: uniform {}, Knothe {}; with 0/0.63 {} and {}, but there "
                "Knothe underestimates by {%}",
                error(uniform, leading_element), error(knothe, leading_element), error(best_uniform, leading_element),
                error(best_knothe, leading_element), -excess(best_knothe, leading_element)),
         false},
    };
}

namespace {

/// The mesh and alphas of the grids with the smallest error at n = 40.
Case best_case() {
    Case found;
    double least = std::abs(c11_ratio(found) - 1);
    const auto visit = [&](const std::string& mesh, const std::vector<double>& gradings) {
        for (const double grading : gradings) {
            for (const double alpha : paper_alphas()) {
                for (const Vary vary : {Vary::both_alphas, Vary::alpha_T}) {
                    const Case c = at(at(mesh + "-1" + leading_fixed, vary, alpha), Vary::grading, grading);
                    const double error = std::abs(c11_ratio(c) - 1);
                    if (!(error < least)) continue;
                    least = error;
                    found = c;
                }
            }
        }
    };
    visit("geometric", {0.125, 0.25, 0.5, 2, 4, 8});
    visit("knothe", fractions(1, 9, 10));
    visit("modified-knothe", fractions(1, 9, 10));
    return found;
}

}  // namespace

Claims conclusions_on_steady_rolling(const Results& r) {
    const Case found = best_case();
    const double least = std::abs(c11_ratio(found) - 1), uniform = std::abs(c11_ratio({}) - 1);
    const Points fd = r.curve("05a", 0), closed = r.curve("07a", 0);
    const double fd_jump = largest_jump(within(fd, 0.3, 0.7)), closed_jump = largest_jump(within(closed, 0.3, 0.7));
    int better = 0;
    for (const double alpha : fractions(1, 20, 20)) {
        better += std::abs(error_at(fd, alpha)) < std::abs(error_at(closed, alpha));
    }
    return {
        {"Sec. 7", "can provide even better results", "Another mesh with other alphas beats the uniform 0/0.63",
         "n = 40, all meshes and alphas of the grids",
         judged(least < uniform, "{%} ({} {}, alpha {}/{}) against {%} (uniform 0/0.63)", least, found.mesh_name,
                found.grading.value_or(1), *found.alpha_L, *found.alpha_T, uniform)},
        {"Sec. 7", "in general, more robust", "Finite differences are more robust than the analytic derivative",
         "judged by the largest jump of c11*/c11 from one alpha to the next (0.005) in [0.3, 0.7], alpha_L = alpha_T",
         judged(fd_jump < closed_jump, "{%} against {%}; more accurate at {} of 20 equal alphas of the grid", fd_jump,
                closed_jump, better)},
    };
}

}  // namespace paper
