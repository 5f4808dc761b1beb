# A page of docs/ that the program prints itself must be what it prints now. ARGUMENTS: of `vitrum`.
execute_process(COMMAND ${PROGRAM} ${ARGUMENTS} OUTPUT_VARIABLE NOW COMMAND_ERROR_IS_FATAL ANY)
file(READ ${PAGE} COMMITTED)
if(NOT NOW STREQUAL COMMITTED)
  list(JOIN ARGUMENTS " " COMMAND)
  message(FATAL_ERROR "${PAGE} is not what 'vitrum ${COMMAND}' prints: write it anew")
endif()
