! Creep forces from Fortran: forces TABLE [A] prints the forces of a contact of half-length A, and the derivative of F_x
! by the creepage.
program forces
    use, intrinsic :: iso_c_binding
    use, intrinsic :: iso_fortran_env, only: error_unit
    implicit none
    integer(c_int), parameter :: rollbem_ok = 0, rollbem_off_table = 3
    interface
        function table_open(path) bind(c, name="rollbem_table_open") result(table)
            import :: c_ptr, c_char
            character(kind=c_char), intent(in) :: path(*)
            type(c_ptr) :: table
        end function
        function table_forces(table, count, contacts, forces, tangents) bind(c, name="rollbem_table_forces") result(code)
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
    end interface
    character(len=1024) :: path, a
    integer(c_int) :: code
    type(c_ptr) :: table
    real(c_double) :: contact(9), force(3), tangent(3, 7)

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
    call table_close(table)
end program
