// The results of reproduce_paper for a reader: claims.csv as rows, and index.html, which shows everything.
#pragma once

#include <set>
#include <string>

#include "claims.hpp"
#include "results.hpp"
#include "support/csv.hpp"

namespace paper {

/// "60 statements of the paper: 53 hold, 7 do not hold as printed; 10 additions: all hold; 0 differ from what is
/// expected"
std::string summary(const Claims& claims);

/// The remark, or a note that the finding differs from what is expected.
std::string reason(const Claim& claim);

inline const study::Row claim_columns{"claim", "figure", "paper", "measured", "holds", "expected", "reason", "kind"};
study::Row claim_row(const Claim& claim);

/// `drawn` are the panels that have an SVG file beside the page; `note` is shown at the top if there is one.
std::string page(const Results& results, const Claims& claims, const std::set<std::string>& drawn,
                 const std::string& note);

}  // namespace paper
