# SUNDIALS without MPI, as the target vitrum_serial_sundials.
# A core that was built with MPI (Debian 13) loads it, and what MPI brings along, before main: transports that take over SIGHUP, SIGSEGV
# and SIGFPE and measure the clock. vitrum computes in one process and passes no communicator. So its static libraries are taken
# then, and MPI's names, none of which is ever called, stand for a function that ends the program.
set(parts arkode cvode nvecserial sunnonlinsolfixedpoint sunmatrixdense sunlinsoldense sunmatrixsparse sunlinsolspgmr)
if(TARGET SUNDIALS::core_shared)
  list(APPEND parts core)  # SUNDIALS 7
else()
  list(APPEND parts generic)
endif()

add_library(vitrum_serial_sundials INTERFACE)
set(core_links "")
if(TARGET SUNDIALS::core_shared)
  get_target_property(core_links SUNDIALS::core_shared INTERFACE_LINK_LIBRARIES)
endif()
if(NOT core_links MATCHES "MPI::" OR NOT TARGET SUNDIALS::core_static)
  if(core_links MATCHES "MPI::")
    message(STATUS "SUNDIALS has no static libraries: the program loads MPI, of which it makes no use")
  endif()
  list(TRANSFORM parts PREPEND "SUNDIALS::")
  target_link_libraries(vitrum_serial_sundials INTERFACE ${parts})
  return()
endif()

foreach(part ${parts})
  # The exported static targets name the shared core, so that the files themselves are linked.
  target_link_libraries(vitrum_serial_sundials INTERFACE $<TARGET_FILE:SUNDIALS::${part}_static>)
endforeach()
target_include_directories(vitrum_serial_sundials SYSTEM INTERFACE
  $<TARGET_PROPERTY:SUNDIALS::core_static,INTERFACE_INCLUDE_DIRECTORIES>
  $<TARGET_PROPERTY:MPI::MPI_C,INTERFACE_INCLUDE_DIRECTORIES>)

get_target_property(core SUNDIALS::core_static LOCATION)
execute_process(COMMAND "${CMAKE_NM}" -u "${core}" OUTPUT_VARIABLE undefined COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(MPI|ompi|MPIR)_[A-Za-z_]+" names "${undefined}")
list(REMOVE_DUPLICATES names)
set(text "#include <stdlib.h>\n\nvoid vitrum_without_mpi(void);\nvoid vitrum_without_mpi(void) { abort(); }\n")
foreach(name ${names})
  string(APPEND text "void ${name}(void) __attribute__((alias(\"vitrum_without_mpi\")));\n")
endforeach()
file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/generated/without_mpi.c" CONTENT "${text}" @ONLY)
add_library(vitrum_without_mpi STATIC "${PROJECT_BINARY_DIR}/generated/without_mpi.c")
target_link_libraries(vitrum_serial_sundials INTERFACE vitrum_without_mpi m)
