// Full adhesion: frequency response, eigenvalues, state spaces.
#include <rollbem/compiled/adhesion.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/adhesion/impl/balanced_reduction.ipp>
#include <rollbem/adhesion/impl/frequency.ipp>
#include <rollbem/adhesion/impl/stability.ipp>
#include <rollbem/adhesion/impl/stability_count.ipp>
#include <rollbem/adhesion/impl/state_space.ipp>
