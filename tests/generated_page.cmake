# A committed page that a program prints must be what it prints now. ARGUMENTS: of PROGRAM.
separate_arguments(LIST UNIX_COMMAND "${ARGUMENTS}")
execute_process(COMMAND ${PROGRAM} ${LIST} OUTPUT_VARIABLE NOW COMMAND_ERROR_IS_FATAL ANY)
file(READ ${PAGE} COMMITTED)
if(NOT NOW STREQUAL COMMITTED)
  message(FATAL_ERROR "${PAGE} is not what '${PROGRAM} ${ARGUMENTS}' prints: write it anew")
endif()
