# Writes version.hpp into the build tree at every build, so that the git hash is that of the commit that is built.
set(VITRUM_GENERATED_DIR "${PROJECT_BINARY_DIR}/generated")
add_custom_target(vitrum_version
  COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DOUTPUT=${VITRUM_GENERATED_DIR}/vitrum_version.hpp
          -DVERSION=${PROJECT_VERSION} -DCOMPILER=${CMAKE_CXX_COMPILER_ID}\ ${CMAKE_CXX_COMPILER_VERSION}
          -DBUILD_TYPE=${CMAKE_BUILD_TYPE} -DNATIVE=${VITRUM_NATIVE}
          -P ${PROJECT_SOURCE_DIR}/cmake/WriteVersion.cmake
  BYPRODUCTS ${VITRUM_GENERATED_DIR}/vitrum_version.hpp
  VERBATIM)
