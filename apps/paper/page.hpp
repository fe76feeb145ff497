// The results of reproduce_paper for a reader: claims.csv as rows, and index.html, one file that shows everything.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "claims.hpp"
#include "results.hpp"
#include "support/csv.hpp"

namespace paper {

struct Judged {
    Claim claim;
    Finding finding;

    bool as_expected() const { return finding.holds == claim.expected; }
    /// The remark, or a note that the finding differs from what is expected.
    std::string reason() const;
};

/// Number of claims of each sort.
struct Tallies {
    std::size_t statements = 0, holding = 0;  ///< of the paper
    std::size_t additions = 0, additions_holding = 0;
    std::size_t unexpected = 0;
};
Tallies tallies(const std::vector<Judged>& claims);

/// "60 statements of the paper: 53 hold, 7 do not hold as printed; 10 additions: all hold"
std::string summary(const Tallies& counted);

inline const study::Row claim_columns{"claim", "figure", "paper", "measured", "holds", "expected", "reason", "kind"};
study::Row claim_row(const Judged& judged);

/// `drawings` holds the SVG of each panel that was drawn; `note` is shown at the top if there is one.
std::string page(const Results& results, const std::vector<Judged>& claims,
                 const std::map<std::string, std::string>& drawings, const std::string& note);

}  // namespace paper
