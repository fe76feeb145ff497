// The function by which the linker refuses units of another version or alignment, see decl.hpp.
#include <rollbem/detail/decl.hpp>

template <int largest, int largest_static>
int rollbem::rollbem_compiled_0_4_is_missing_or_has_another_eigen_alignment_use_the_same_m_flags() {
    return largest;
}
template int rollbem::rollbem_compiled_0_4_is_missing_or_has_another_eigen_alignment_use_the_same_m_flags<
    EIGEN_MAX_ALIGN_BYTES, EIGEN_MAX_STATIC_ALIGN_BYTES>();
