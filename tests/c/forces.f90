! Creep forces from Fortran: forces TABLE [A] prints the forces of a contact of half-length A, and the derivative of F_x
! by the creepage, a patch of a wheel, and the forces of a wheel by the contact table beside TABLE.
program forces
    use, intrinsic :: iso_c_binding
    use, intrinsic :: iso_fortran_env, only: error_unit
    implicit none
    integer(c_int), parameter :: rollbem_ok = 0, rollbem_off_table = 3
    type, bind(c) :: wheel_options  ! rollbem_wheel_options
        integer(c_size_t) :: size
        integer(c_int) :: wheel_mirror, rail_mirror, any_shape, by_origin, interaction
        real(c_double) :: per_metre, smooth, cant, gauge, gauge_depth, flange_back, tape_offset, radius
        real(c_double) :: rail_origin(2), roller_radius, shear_modulus, poisson_ratio
    end type
    interface
        function wheel_defaults(options, size) bind(c, name="rollbem_wheel_defaults") result(code)
            import :: wheel_options, c_size_t, c_int
            type(wheel_options), intent(out) :: options
            integer(c_size_t), value :: size
            integer(c_int) :: code
        end function
        function wheel_open(wheel_path, rail_path, options) bind(c, name="rollbem_wheel_open") result(wheel)
            import :: c_ptr, c_char, wheel_options
            character(kind=c_char), intent(in) :: wheel_path(*), rail_path(*)
            type(wheel_options), intent(in) :: options
            type(c_ptr) :: wheel
        end function
        function wheel_for_load(wheel, position, load, most, patches, count) &
            bind(c, name="rollbem_wheel_solve_for_load") result(code)
            import :: c_ptr, c_size_t, c_double, c_int
            type(c_ptr), value :: wheel
            real(c_double), intent(in) :: position(6)
            real(c_double), value :: load
            integer(c_size_t), value :: most
            real(c_double), intent(out) :: patches(*)
            integer(c_size_t), intent(out) :: count
            integer(c_int) :: code
        end function
        subroutine wheel_free(wheel) bind(c, name="rollbem_wheel_free")
            import :: c_ptr
            type(c_ptr), value :: wheel
        end subroutine
        function table_open(path) bind(c, name="rollbem_table_open") result(table)
            import :: c_ptr, c_char
            character(kind=c_char), intent(in) :: path(*)
            type(c_ptr) :: table
        end function
        function table_forces(table, count, contacts, forces, tangents) &
            bind(c, name="rollbem_table_forces") result(code)
            import :: c_ptr, c_size_t, c_double, c_int
            type(c_ptr), value :: table
            integer(c_size_t), value :: count
            real(c_double), intent(in) :: contacts(*)
            real(c_double), intent(out) :: forces(*), tangents(*)
            integer(c_int) :: code
        end function
        subroutine table_close(table) bind(c, name="rollbem_table_close")
            import :: c_ptr
            type(c_ptr), value :: table
        end subroutine
        function contacts_open(path) bind(c, name="rollbem_contact_table_open") result(contacts)
            import :: c_ptr, c_char
            character(kind=c_char), intent(in) :: path(*)
            type(c_ptr) :: contacts
        end function
        function contacts_on_rails(contacts, shift, yaw, loads, height, roll) &
            bind(c, name="rollbem_contact_table_on_rails") result(code)
            import :: c_ptr, c_double, c_int
            type(c_ptr), value :: contacts
            real(c_double), value :: shift, yaw
            real(c_double), intent(in) :: loads(2)
            real(c_double), intent(out) :: height(5), roll(5)
            integer(c_int) :: code
        end function
        function contacts_look_up(contacts, creep, side, inputs, wrench, tangent, points, heat) &
            bind(c, name="rollbem_contact_table_look_up") result(code)
            import :: c_ptr, c_double, c_int
            type(c_ptr), value :: contacts, creep
            integer(c_int), value :: side
            real(c_double), intent(in) :: inputs(11)
            real(c_double), intent(out) :: wrench(6), tangent(6, 11), points(10, 4), heat
            integer(c_int) :: code
        end function
        subroutine contacts_close(contacts) bind(c, name="rollbem_contact_table_close")
            import :: c_ptr
            type(c_ptr), value :: contacts
        end subroutine
    end interface
    character(len=1024) :: path, a
    integer(c_int) :: code
    integer(c_int), parameter :: rollbem_right = 1
    type(c_ptr) :: table, wheel, contacts
    type(wheel_options) :: options
    integer(c_size_t) :: count
    real(c_double) :: contact(9), force(3), tangent(3, 7), position(6), patch(12, 1)
    real(c_double) :: height(5), roll(5), inputs(11), wrench(6), by_inputs(6, 11), points(10, 4), heat

    call get_command_argument(1, path)
    table = table_open(trim(path)//c_null_char)
    if (.not. c_associated(table)) stop 1
    ! a, b, G, nu, mu, N, creepages
    contact = [6d-3, 4d-3, 8.2d10, 0.28d0, 0.3d0, 8d4, 1d-3, 5d-4, 0.1d0]
    call get_command_argument(2, a)
    if (a /= '') read (a, *) contact(1)
    code = table_forces(table, 1_c_size_t, contact, force, tangent)
    if (code == rollbem_off_table) write (error_unit, '(a)') 'a/b lies beyond the table'
    if (code /= rollbem_ok .and. code /= rollbem_off_table) stop 2
    print '(3es25.16)', force
    print '(es25.16)', tangent(1, 1)

    if (wheel_defaults(options, c_sizeof(options)) /= rollbem_ok) stop 3
    wheel = wheel_open('s1002'//c_null_char, '60e1'//c_null_char, options)
    if (.not. c_associated(wheel)) stop 4
    ! lateral, height, roll, yaw, x along the track, pitch
    position = [1d-3, 0d0, 0d0, 0d0, 0d0, 0d0]
    if (wheel_for_load(wheel, position, 1d5, 1_c_size_t, patch, count) /= rollbem_ok) stop 5
    print '(a, 12es25.16)', 'wheel ', patch
    call wheel_free(wheel)

    contacts = contacts_open(path(:index(path, '/', back=.true.))//'s1002_60e1.contact'//c_null_char)
    if (.not. c_associated(contacts)) stop 6
    if (contacts_on_rails(contacts, 2d-3, 1d-3, [8d4, 9d4], height, roll) /= rollbem_ok) stop 7
    ! shift, yaw, forward speed, pitch rate, lateral and vertical speed, roll rate, yaw rate, load, mu, roll
    inputs = [2d-3, 1d-3, 2d1, -43.5d0, 0.01d0, 0d0, 0d0, 0.02d0, 8d4, 0.3d0, roll(1)]
    if (contacts_look_up(contacts, table, rollbem_right, inputs, wrench, by_inputs, points, heat) /= rollbem_ok) stop 8
    print '(a, 7es25.16)', 'rolls ', wrench, height(1)
    call contacts_close(contacts)
    call table_close(table)
end program
