// Status: the verdict that every numerical result carries.
// A broken precondition throws; a computation that went wrong says so here.
#pragma once

namespace rollbem {

/// Whether a number that was computed can be used.
enum class Status {
    ok,
    ill_conditioned,  ///< the matrix is singular to working precision, or the residual is far above rounding
    not_finite,       ///< an input or a result is not a number or infinite
};

}  // namespace rollbem
