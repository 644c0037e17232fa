# SPDX-License-Identifier: MIT
# Compiles the lines of SOURCE between "#ifdef USE" and "#endif  // USE" twice. The head of
# rejected.cpp says what is expected.
set(compile ${COMPILER} -std=c++20 -fsyntax-only -I${INCLUDE} -isystem ${EIGEN} -D${USE})
file(READ ${SOURCE} text)
string(REGEX MATCH "\n#ifdef ${USE}\n.*\n#endif  // ${USE}\n" text "${text}")

execute_process(COMMAND ${compile} -DMOREAU_CORRECTED ${SOURCE}
                RESULT_VARIABLE result ERROR_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the corrected variant does not compile:\n${output}")
endif()

execute_process(COMMAND ${compile} ${SOURCE} RESULT_VARIABLE result ERROR_VARIABLE output)
if(result EQUAL 0)
  message(FATAL_ERROR "compiles, but should be rejected")
endif()

string(REGEX MATCHALL "\n// expect: [^\n]+" lines "${text}")
if(NOT lines)
  message(FATAL_ERROR "names no message to expect")
endif()
foreach(line IN LISTS lines)
  string(REPLACE "\n// expect: " "" pattern "${line}")
  if(NOT output MATCHES "${pattern}")
    message(FATAL_ERROR "is rejected, but without '${pattern}':\n${output}")
  endif()
endforeach()

string(FIND "${text}" "\n// and no other error\n" alone)
string(REGEX MATCHALL "[^a-z]error: " errors "${output}")
list(LENGTH errors count)
if(NOT alone EQUAL -1 AND NOT count EQUAL 1)
  message(FATAL_ERROR "is rejected with ${count} errors:\n${output}")
endif()
