// Status: the verdict that every numerical result carries.
// A broken precondition throws; a computation that went wrong says so here.
#pragma once

#include "../detail/language.hpp"

namespace rollbem {

/// Whether a number that was computed can be used.
enum class Status {
    ok,
    ill_conditioned,  ///< the matrix is singular to working precision, or the residual is far above rounding
    inconsistent,     ///< solved well, but tractions of steady rolling that push with the creepage show that the scheme
                      ///< does not converge to full adhesion: alpha <= 0, or alpha > 1
    not_finite,       ///< an input or a result is not a number or infinite
};

}  // namespace rollbem
