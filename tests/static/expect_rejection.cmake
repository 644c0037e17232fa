# SPDX-License-Identifier: MIT
# Compiles SOURCE twice. With MOREAU_CORRECTED defined it has to compile, so that nothing but the
# mistake it is about can be what fails; without, it has to fail, and every pattern on its lines
# "// expect: <regular expression>" has to occur in what the compiler says; with a line "// and no other
# error" that has to be all.
set(compile ${COMPILER} -std=c++20 -fsyntax-only -I${INCLUDE} -isystem ${EIGEN})

execute_process(COMMAND ${compile} -DMOREAU_CORRECTED ${SOURCE}
                RESULT_VARIABLE result ERROR_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the corrected variant does not compile:\n${output}")
endif()

execute_process(COMMAND ${compile} ${SOURCE} RESULT_VARIABLE result ERROR_VARIABLE output)
if(result EQUAL 0)
  message(FATAL_ERROR "compiles, but should be rejected")
endif()

file(STRINGS ${SOURCE} lines REGEX "^// expect: ")
if(NOT lines)
  message(FATAL_ERROR "names no message to expect")
endif()
foreach(line IN LISTS lines)
  string(REPLACE "// expect: " "" pattern "${line}")
  if(NOT output MATCHES "${pattern}")
    message(FATAL_ERROR "is rejected, but without '${pattern}':\n${output}")
  endif()
endforeach()

file(STRINGS ${SOURCE} alone REGEX "^// and no other error$")
string(REGEX MATCHALL "[^a-z]error: " errors "${output}")
list(LENGTH errors count)
if(alone AND NOT count EQUAL 1)
  message(FATAL_ERROR "is rejected with ${count} errors:\n${output}")
endif()
