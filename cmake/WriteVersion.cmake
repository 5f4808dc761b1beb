execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty OUTPUT_VARIABLE HASH
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE STATUS)
if(NOT STATUS EQUAL 0)
  set(HASH "unknown")
endif()
if(NATIVE)
  string(APPEND BUILD_TYPE ", native")
endif()
set(TEXT "#pragma once
#define VITRUM_VERSION \"${VERSION}\"
#define VITRUM_GIT \"${HASH}\"
#define VITRUM_COMPILER \"${COMPILER} (${BUILD_TYPE})\"
")
set(OLD "")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" OLD)
endif()
if(NOT OLD STREQUAL TEXT)  # leave the time stamp alone when nothing changed
  file(WRITE "${OUTPUT}" "${TEXT}")
endif()
