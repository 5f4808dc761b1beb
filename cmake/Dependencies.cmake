# Every library that vitrum builds with. All are Debian packages (see ./quickstart).
find_package(SUNDIALS REQUIRED COMPONENTS arkode cvode nvecserial sunmatrixdense sunlinsoldense
                                          sunmatrixsparse sunlinsolspgmr)
include(SerialSundials)
find_package(Eigen3 REQUIRED)
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(muparser REQUIRED)
find_package(PNG REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(Threads REQUIRED)

# SuiteSparse ships no CMake configuration in Debian 12: header and library are found by hand.
find_path(KLU_INCLUDE_DIR klu.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(KLU_LIBRARY klu REQUIRED)
find_library(SUITESPARSECONFIG_LIBRARY suitesparseconfig REQUIRED)
add_library(vitrum_klu INTERFACE)
target_include_directories(vitrum_klu SYSTEM INTERFACE "${KLU_INCLUDE_DIR}")
target_link_libraries(vitrum_klu INTERFACE "${KLU_LIBRARY}" "${SUITESPARSECONFIG_LIBRARY}")
