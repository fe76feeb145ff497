// apps/support/named_scheme.hpp
#include <string>
#include <vector>

#include <rollbem/discretisation/scheme.hpp>

#include "support/catch.hpp"
#include "support/named_scheme.hpp"
#include "support/refusal.hpp"

namespace named_scheme_tests {
namespace {

using rollbem::Derivative;

std::string said(const std::string& word, bool of_patch = false) {
    return refusal([&] { study::scheme_named(word, of_patch); });
}

TEST_CASE("The word of a scheme is read as the same scheme", "[scheme]") {
    const std::string word =
        GENERATE("uniform:collocation:0/0.63", "cosine:collocation:0.5/0.5:analytic:lambda-0.5", "cosine:nodes",
                 "cosine:nodes-chebyshev", "uniform:collocation:0/0.63:fd4", "cosine:knothe-bc:fd4",
                 "uniform:galerkin:0/0.75:q7", "uniform:galerkin:0/0.75:q7:analytic", "cosine:galerkin:0.5/0.5",
                 "cosine:galerkin:0.5/0.5:fd", "knothe-0.3:knothe-bc", "modified-knothe-0.3:knothe-bc:analytic",
                 "geometric-1.89:collocation:-1/2", "chebyshev", "polynomial", "closed-form", "richardson:cosine:nodes",
                 "richardson:uniform:collocation:0.5/0.5");
    CAPTURE(word);
    CHECK(study::scheme_named(word).word() == word);
}

TEST_CASE("A word has the parameters that it says, and the options' parameters where it says none", "[scheme]") {
    const auto galerkin = study::scheme_named("knothe-0.4:galerkin:0.1/0.7:lambda-0.25:q9:analytic");
    CHECK(galerkin.word() == "knothe-0.4:galerkin:0.1/0.7:q9:analytic:lambda-0.25");
    CHECK(galerkin.graded_by("epsilon"));
    CHECK(*galerkin.grading == 0.4);
    const auto own = galerkin.equations();
    const auto* const equations = own.get_if<rollbem::Galerkin>();
    REQUIRE(equations != nullptr);
    CHECK(equations->alpha_L == 0.1);
    CHECK(equations->alpha_T == 0.7);
    CHECK(equations->lambda == 0.25);
    CHECK(equations->quadrature == 9);
    CHECK(equations->derivative == Derivative::analytic);
    CHECK(study::scheme_named("uniform:galerkin:0/1:exact").word() == "uniform:galerkin:0/1");
    CHECK(study::scheme_named("uniform:galerkin:0/1").derivative == "analytic");
    CHECK(study::scheme_named("uniform:galerkin:0/1:q7").derivative == "fd");
    const auto nodes = study::scheme_named("cosine:nodes-chebyshev").equations();
    CHECK(nodes.get_if<rollbem::NodeDifference>()->nodes == rollbem::Nodes::chebyshev);
    CHECK(study::scheme_named("richardson:cosine:nodes").order() == 2);
    CHECK(study::scheme_named("richardson:uniform:nodes").order() == 1);
}

TEST_CASE("Schemes of patches have strips", "[scheme]") {
    CHECK(study::scheme_named("cosine:nodes", true).word() == "cosine:nodes:cosine-strips");
    CHECK(study::scheme_named("richardson:cosine:nodes-chebyshev:uniform-strips", true).strips == "uniform");
    CHECK(said("uniform:nodes", true).find(": uniform:nodes must be cosine:nodes") < 100);
    CHECK(said("cosine:collocation:0/1", true).find("must be cosine:nodes") < 100);
    CHECK(said("cosine:nodes:square", true).find(": square must be one of cosine-strips, uniform-strips") < 100);
    CHECK(said("chebyshev", true).find(": chebyshev must be a mesh") < 100);
}

TEST_CASE("The part of a word that is to blame is named with what it may be", "[scheme]") {
    const auto& [word, blame] = GENERATE(table<std::string, std::string>({
        {"", ": '' must be a mesh, one of uniform, cosine, geometric-RATIO"},
        {"uniform", ": '' must be a method, one of collocation"},
        {"sine:nodes", ": sine must be a mesh"},
        {"knothe:nodes", ": knothe must be a mesh"},
        {"knothe-0:nodes", ": knothe-0 must have a number from 1e-12"},
        {"cosine-2:nodes", ": cosine-2 must be a mesh"},
        {"richardson", ": '' must be a mesh"},
        {"richardson:richardson:cosine:nodes", ": richardson must be a mesh"},
        {"uniform:spectral", ": spectral must be a method"},
        {"uniform:nodes-chebyshev", ": nodes-chebyshev must be on the mesh cosine"},
        {"uniform:collocation", ": '' must be ALPHA_L/ALPHA_T"},
        {"uniform:collocation:0/3", ": 0/3 must be ALPHA_L/ALPHA_T, both in [-2, 2]"},
        {"uniform:collocation:0/1:q7", ": q7 must be one of fd, fd4, analytic, lambda-L"},
        {"uniform:collocation:0/1:lambda-2", ": lambda-2 must be one of"},
        {"uniform:galerkin:0/1:q0", ": q0 must be one of exact, qN with N from 1 to 1000, fd, analytic"},
        {"uniform:galerkin:0/1:", ": '' must be one of"},
        {"uniform:nodes:fd", ": fd must not follow nodes"},
        {"cosine:nodes:uniform-strips", ": uniform-strips must not follow nodes"},
        {"uniform:knothe-bc:0/1", ": 0/1 must be one of fd, fd4, analytic, once"},
    }));
    CAPTURE(word);
    CHECK(said(word).find("--scheme = " + word + blame) == 0);
}

TEST_CASE("A scheme is taken once", "[scheme]") {
    const std::vector<std::string> words{"uniform:galerkin:0/1", "uniform:galerkin:0/1:exact"};
    CHECK(refusal([&] { study::named_schemes(words); }) ==
          "--scheme = uniform:galerkin:0/1:exact must not be given twice");
}

}  // namespace
}  // namespace named_scheme_tests
