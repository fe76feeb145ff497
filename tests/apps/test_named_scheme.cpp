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

TEST_CASE("The word of a scheme is read as the same scheme", "[scheme]") {
    const std::string word =
        GENERATE("uniform:collocation:0/0.63", "cosine:collocation:0.5/0.5:analytic:lambda-0.5", "cosine:nodes",
                 "cosine:nodes-chebyshev", "uniform:galerkin:0/0.75:q7", "uniform:galerkin:0/0.75:q7:analytic",
                 "cosine:galerkin:0.5/0.5", "cosine:galerkin:0.5/0.5:fd", "knothe-0.3:knothe-bc",
                 "modified-knothe-0.3:knothe-bc:analytic", "geometric-1.89:collocation:-1/2", "chebyshev", "polynomial",
                 "closed-form", "richardson:cosine:nodes", "richardson:uniform:collocation:0.5/0.5");
    CAPTURE(word);
    const auto scheme = study::scheme_named(word);
    REQUIRE(scheme);
    CHECK(scheme->word() == word);
}

TEST_CASE("A word has the parameters that it says, and those of the options where it says none", "[scheme]") {
    const auto galerkin = *study::scheme_named("knothe-0.4:galerkin:0.1/0.7:lambda-0.25:q9:analytic");
    CHECK(galerkin.word() == "knothe-0.4:galerkin:0.1/0.7:q9:analytic:lambda-0.25");
    CHECK(galerkin.graded_by("epsilon"));
    CHECK(*galerkin.grading == 0.4);
    const auto own = galerkin.equations();
    const auto* equations = own.get_if<rollbem::Galerkin>();
    REQUIRE(equations != nullptr);
    CHECK(equations->alpha_L == 0.1);
    CHECK(equations->alpha_T == 0.7);
    CHECK(equations->lambda == 0.25);
    CHECK(equations->quadrature == 9);
    CHECK(equations->derivative == Derivative::analytic);
    CHECK(study::scheme_named("uniform:galerkin:0/1:exact")->word() == "uniform:galerkin:0/1");
    CHECK(study::scheme_named("uniform:galerkin:0/1")->derivative == "analytic");
    CHECK(study::scheme_named("uniform:galerkin:0/1:q7")->derivative == "fd");
    const auto nodes = study::scheme_named("cosine:nodes-chebyshev")->equations();
    CHECK(nodes.get_if<rollbem::NodeDifference>()->nodes == rollbem::Nodes::chebyshev);
    CHECK(study::scheme_named("richardson:cosine:nodes")->order() == 2);
    CHECK(study::scheme_named("richardson:uniform:nodes")->order() == 1);
}

TEST_CASE("Schemes of patches have strips", "[scheme]") {
    CHECK(study::scheme_named("cosine:nodes", true)->word() == "cosine:nodes:cosine-strips");
    CHECK(study::scheme_named("richardson:cosine:nodes-chebyshev:uniform-strips", true)->strips == "uniform");
    for (const char* const word : {"uniform:nodes", "cosine:collocation:0/1", "chebyshev", "cosine:nodes:square"}) {
        CAPTURE(word);
        CHECK_FALSE(study::scheme_named(word, true));
    }
}

TEST_CASE("What is no scheme is refused with what the words may be", "[scheme]") {
    for (const std::string word : {"",
                                   "uniform",
                                   "cosine:",
                                   ":nodes",
                                   "sine:nodes",
                                   "uniform:spectral",
                                   "uniform:collocation",
                                   "uniform:collocation:0",
                                   "uniform:collocation:0/3",
                                   "uniform:collocation:0/nan",
                                   "uniform:collocation:0/1/2",
                                   "uniform:collocation:0/1:q7",
                                   "uniform:collocation:0/1:lambda-2",
                                   "uniform:galerkin:0/1:q0",
                                   "uniform:galerkin:0/1:7",
                                   "uniform:nodes:fd",
                                   "uniform:nodes-chebyshev",
                                   "knothe:nodes",
                                   "knothe-0:nodes",
                                   "cosine-2:nodes",
                                   "cosine:nodes:uniform-strips",
                                   "richardson",
                                   "richardson:chebyshev",
                                   "richardson:richardson:cosine:nodes",
                                   "chebyshev:8",
                                   "uniform:knothe-bc:0/1"}) {
        CAPTURE(word);
        CHECK_FALSE(study::scheme_named(word));
    }
    const auto said = [](const std::vector<std::string>& words) {
        return refusal([&] { study::named_schemes(words); });
    };
    CHECK(said({"cosine:nodes", "sine:nodes"}).rfind("--scheme = sine:nodes must be MESH:METHOD", 0) == 0);
    CHECK(said({"uniform:galerkin:0/1", "uniform:galerkin:0/1:exact"}).find("must not be given twice") < 100);
}

}  // namespace
}  // namespace named_scheme_tests
