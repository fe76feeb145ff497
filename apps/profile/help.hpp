// What profile_study --help says below the options.
#pragma once

namespace profile {

inline constexpr const char* help =
    R"(Example: contact points over the lateral shift, as every vehicle engineer draws them
  profile_study --shift -0.004,-0.002,0,0.002,0.004,0.006 --side both --output contacts.csv --plot contacts.svg

Track axes: x forward, y to the right, z down, the origin between the rails at the height of their tops. Positions are
--shift, --yaw and a roll; height, the wheelset's, and without --roll the roll follow from the loads. A row for each
position, wheel and patch, patches by decreasing load: x, y, z of the reference point, on the rail; rail_y and wheel_y
of it in the profiles of right wheel and right rail (of a left wheel in their mirror images); angle of the patch's
plane, in which s lies along y turned by it, and n points into the rail; normal force load; approach, from where the
undeformed surfaces would touch; half_length along x and half_width along s, half the extents; iterations of the last
solution for pressures; time_us of the whole position [microseconds], once. Lengths in m, angles in rad, forces in N,
pressures in Pa, all of them SI. status: ok; doubtful_plane, surfaces turn by more than 0.2 rad over the patch;
unbalanced, normal forces and friction did not come to carry the loads to 1e-6; and without numbers: no_contact, end_of_profile, undefined_section, load_not_reached, not_converged, few_cells, not_finite.
--friction: longitudinal_creepage, lateral_creepage and spin [1/m] are numbers as CONTACT's CKSI, CETA and CPHI, those
of the rail on the wheel, over the mean of V and the circumferential speed: a driven wheel has a positive longitudinal
creepage. longitudinal_force, lateral_force (along s) and spin_moment, about n at the reference point, act on the wheel
(CONTACT's FX, FS, MN on the rail are minus these). Slip is that of the three creepages, or of the curved surfaces with
--slip curved. slip_power [W] is what friction turns into heat, minus the power of
forces and moment on the creepages; t_gamma [N] that power per metre rolled, for wear; fatigue_index the force of
friction over the normal force, less --shear-yield over the peak pressure (surface fatigue where positive); elements
those of each patch. --wear FILE has, for right rail and right wheel (of left ones in their mirror images) of each side,
s, the length along the profile, y, z, and work [J/m^2]: frictional work per metre rolled and metre of profile, the mean
over all positions. The loads are vertical: the normal forces are found
together with those of friction. Status may then be that of friction, with the forces empty.
--outline writes files P_SIDE_K.outline.csv and P_SIDE_K.pressure.csv of position P and patch K, e.g. for
  patch_study --n 12 --outline DIR/1_right_1.outline.csv --pressure DIR/1_right_1.pressure.csv --longitudinal 0.1
--positions: a row for each position. --smooth is for worn or measured profiles: the smoothest curve that leaves the
points by that root mean square, in y and z together, which should be the noise of the device: with less, patches break
up (few_cells).
)";

}  // namespace profile
