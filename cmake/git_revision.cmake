# cmake -DSOURCE_DIR=... -DOUTPUT=... -P git_revision.cmake: writes the definition of build_info::git_revision.
# The file is written only if the revision has changed. Git takes no locks, so a concurrent commit is not disturbed.
set(revision "unknown")
if(EXISTS "${SOURCE_DIR}/.git")
    execute_process(
        COMMAND git -c "safe.directory=${SOURCE_DIR}" --no-optional-locks
            describe --always --dirty --abbrev=40 --exclude=*
        WORKING_DIRECTORY "${SOURCE_DIR}"
        OUTPUT_VARIABLE described
        RESULT_VARIABLE failed
        ERROR_QUIET
        OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(failed EQUAL 0)
        set(revision "${described}")
    endif()
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [[
#include <build_info.hpp>

const std::string_view build_info::git_revision = "@revision@";
]])
