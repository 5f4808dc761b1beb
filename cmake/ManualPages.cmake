# Writes vitrum.1 and a page for each command, vitrum-run.1 and so on, from what --help says (cmake -P; PROGRAM, HELP2MAN, VERSION, FOLDER).
get_filename_component(place "${PROGRAM}" DIRECTORY)
set(ENV{PATH} "${place}:$ENV{PATH}")  # a page says `vitrum`, not where it was built

function(write_page command summary)
  string(REPLACE " " "-" name "${command}")
  execute_process(COMMAND "${HELP2MAN}" --no-info --name "${summary}" --version-string "vitrum ${VERSION}"
                          --output "${FOLDER}/${name}.1" "${command}" COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}")
execute_process(COMMAND vitrum --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "^vitrum: ([^\n]*)\n.*" "\\1" summary "${help}")
write_page(vitrum "${summary}")
string(REGEX REPLACE ".*\nSubcommands:\n" "" commands "${help}")
while(commands MATCHES "^  ([a-z]+)  +([^\n]+)\n")
  string(LENGTH "${CMAKE_MATCH_0}" length)
  string(SUBSTRING "${commands}" ${length} -1 commands)
  write_page("vitrum ${CMAKE_MATCH_1}" "${CMAKE_MATCH_2}")
endwhile()
